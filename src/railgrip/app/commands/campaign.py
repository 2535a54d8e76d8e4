"""`railgrip campaign`: many runs, drawn at random, streamed to disk, resumed at any time."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cyclopts import App

from railgrip.app.options import Json
from railgrip.app.screen import print_json, print_table, working

if TYPE_CHECKING:
    from railgrip.campaign.running import Progress
    from railgrip.campaign.store import Store

campaign = App(name="campaign", help="Many runs with quantities drawn at random.")


@campaign.command
def run(
    file: str,
    /,
    *,
    out: Path | None = None,
    runs: int | None = None,
    until: float | None = None,
    time: str | None = None,
    threads: int = 1,
    cluster: str | None = None,
    device: str = "cpu",
    no_report: bool = False,
    as_json: Json = False,
) -> int:
    """Run a campaign, or go on with it where it was interrupted.

    Parameters
    ----------
    file
        A campaign file (TOML), or a shipped campaign by name.
    out
        Folder of the campaign; ./out/FILE_campaign if not given.
    runs
        How many runs at most, instead of the file's number.
    until
        End when half the confidence interval is no wider, SI, instead of the file's width.
    time
        Begin no further chunk after this time, e.g. "90 s", "2 h".
    threads
        Chunks worked on at once; results do not depend on it.
    cluster
        Address of a Dask scheduler whose workers make the runs, e.g. tcp://host:8786.
    device
        What makes the runs: cpu, the only one in this version.
    no_report
        Write no page.
    as_json
        Print one JSON object instead of the table.
    """
    _refuse_device(device)
    with working("reading the campaign"):
        from railgrip.campaign.campaign_file import read_campaign_file
        from railgrip.campaign.designs import cells, compare
        from railgrip.campaign.reporting import write_comparison
        from railgrip.campaign.running import run_campaign

        asked = _changed(read_campaign_file(file), runs, until)
    folder = out or Path("out") / f"{Path(file).stem}_campaign"
    done = []
    for cell in cells(asked, folder):
        name = f"{cell.condition}, {cell.design}: " if cell.design else ""
        with _Bar(name) as bar:
            store = run_campaign(
                cell.campaign, cell.folder, threads=threads, seconds=_seconds(time),
                address=cluster, progress=bar.show,
            )  # fmt: skip
        done.append((cell, store))
    figure = _judged(asked)
    for _, store in done:
        _show(store, figure, no_report, as_json)
    if len(done) > 1 and all(store.chunks_done() for _, store in done):
        rows = compare(done, figure)
        path = write_comparison(rows, figure, asked.title, folder)
        if not as_json:
            _show_comparison(rows, figure, asked.title)
            print(f"Comparison: {path}")
    return 0


def _refuse_device(device: str) -> None:
    from railgrip.core.errors import Problem, RailgripError, unknown_name

    if device == "cuda":
        what = "this version of railgrip has no GPU backend"
        cure = "--threads, or --cluster for many machines"
        raise RailgripError(Problem("--device", what, "'cuda'", "cpu", cure=cure))
    if device != "cpu":
        raise RailgripError(unknown_name("--device", "device", device, ("cpu",)))


def _changed(asked: Any, runs: int | None, until: float | None) -> Any:
    from railgrip.campaign.campaign_file import CampaignFile, campaign_from
    from railgrip.campaign.campaign_parts import Until

    table = asked.model_dump(mode="json", by_alias=True)
    if runs is not None:
        table["runs"] = runs
    if until is not None:
        before = table["until"] or Until(width=1.0, figure=_judged(asked)).model_dump()
        table["until"] = {**before, "width": until}
    changed: CampaignFile = campaign_from(table, Path())
    return changed


def _judged(asked: Any) -> str:
    figure: str = asked.until.figure if asked.until is not None else asked.keep[0]
    return figure


def _seconds(time: str | None) -> float | None:
    if time is None:
        return None
    from railgrip.core.errors import Problem, RailgripError
    from railgrip.scenario.conversion import si_value

    found = si_value(time)
    if found is None or not found > 0.0:
        raise RailgripError(Problem("--time", "is no time", got=f"'{time}'", cure="'90 s'"))
    return found


class _Bar:
    """Progress on the standard error: a bar on a terminal, else a line now and then."""

    def __init__(self, name: str) -> None:
        self.name, self.said = name, -1
        self.bar: Any = None

    def __enter__(self) -> _Bar:
        if sys.stderr.isatty():
            from rich.console import Console
            from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

            self.bar = Progress(
                TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[told]}"),
                TimeRemainingColumn(), console=Console(stderr=True),
            )  # fmt: skip
            self.bar.start()
            self.task = self.bar.add_task(f"{self.name}running", total=None, told="")
        return self

    def __exit__(self, *_: object) -> None:
        if self.bar is not None:
            self.bar.stop()

    def show(self, now: Progress) -> None:
        """Show where the campaign is."""
        left = (now.of - now.runs) / max(now.rate, 1e-9)
        told = f"{now.runs} of {now.of} runs, {now.rate:.0f} a second"
        if now.estimate is not None:
            told += f", now {now.estimate.value:.6g} ± {now.estimate.width:.3g}"
        if self.bar is not None:
            self.bar.update(self.task, total=now.of, completed=now.runs, told=told)
        elif 10 * now.runs // now.of > self.said:
            self.said = 10 * now.runs // now.of
            print(f"{self.name}{told}, {left:.0f} s left", file=sys.stderr, flush=True)


def _show(store: Store, figure: str, no_report: bool, as_json: bool) -> None:
    from railgrip.campaign.reporting import COLUMNS, summary, write_page

    if not store.chunks_done():
        print(f"{store.folder}: no chunk was begun yet; run it again to go on", file=sys.stderr)
        return
    ended, rows = summary(store)
    pages = []
    if not no_report:
        with working("writing the report"):
            pages = [write_page(store, figure)]
    if as_json:
        print_json(
            {
                "folder": str(store.folder), "runs": ended, "ended": store.ended(),
                "columns": list(COLUMNS), "figures": rows,
                "files": [str(page) for page in pages], "exit_code": 0,
            }
        )  # fmt: skip
        return
    print_table(store.campaign.title or store.folder.name, list(COLUMNS), _narrow(rows))
    print(f"Runs: {ended}")
    for page in pages:
        print(f"Report: {page}")


def _narrow(rows: list[list[str]]) -> list[list[str]]:
    """Return cells with the interval under the number, so that all columns fit a terminal."""
    return [[cell.replace(" [", "\n[") for cell in row] for row in rows]


def _show_comparison(rows: Any, figure: str, title: str) -> None:
    from railgrip.campaign.reporting import STUDY_COLUMNS, compared_rows, how_shown

    head = f"{title}: {how_shown(figure)[0]}"
    print_table(head, list(STUDY_COLUMNS), _narrow(compared_rows(rows, figure)))


@campaign.command
def status(folder: Path, /, *, as_json: Json = False) -> int:
    """Tell how far a campaign is.

    Parameters
    ----------
    folder
        Folder of the campaign.
    as_json
        Print one JSON object.
    """
    from railgrip.campaign.manifest import open_campaign
    from railgrip.campaign.reporting import states

    store = open_campaign(folder)
    store.refuse_damaged()
    written = store.read(["run", "status"])["status"] if store.chunks_done() else []
    ended = store.ended()
    told = {
        "title": store.campaign.title, "runs": len(written), "of": store.campaign.runs,
        "seed": store.campaign.sampling.seed, "ended": ended,
        "status": states(written) if len(written) else "", "exit_code": 0,
    }  # fmt: skip
    if as_json:
        print_json(told)
        return 0
    print(f"{told['title'] or folder}: {told['runs']} of {told['of']} runs")
    if told["status"]:
        print(f"Runs: {told['status']}")
    print(f"Ended by {ended['why']}." if ended else "Not ended; run it again to go on.")
    return 0


@campaign.command
def export(folder: Path, to: Path, /) -> int:
    """Write all runs of a campaign into one file.

    Parameters
    ----------
    folder
        Folder of the campaign.
    to
        The file; its ending says how: .csv, .parquet or .nc.
    """
    from railgrip.campaign.exporting import export as write
    from railgrip.campaign.manifest import open_campaign

    print(f"Written: {write(open_campaign(folder), to)}")
    return 0


@campaign.command
def catalogue(folder: Path, /) -> int:
    """Build the DuckDB catalogue of all campaigns below a folder anew.

    Parameters
    ----------
    folder
        Where to look, and where campaigns.duckdb is written.
    """
    from railgrip.campaign.exporting import catalogue as build

    path, stores, left_out = build(folder)
    for problem in left_out:
        print(f"left out: {problem}", file=sys.stderr)
    print(f"{len(stores)} campaigns: {path}")
    return 0


@campaign.command
def sensitivity(file: str, /, *, figure: str = "stopping_distance", runs: int = 256) -> int:
    """Ask which variable matters most: Sobol indices.

    Parameters
    ----------
    file
        A campaign file, or a shipped campaign by name.
    figure
        A figure that the campaign keeps.
    runs
        Base sample, a power of two; (variables + 2) times as many runs are made.
    """
    from railgrip.campaign.batch import Batches
    from railgrip.campaign.campaign_file import read_campaign_file
    from railgrip.campaign.sensitivity import sobol_indices
    from railgrip.core.errors import RailgripError, unknown_name

    asked = read_campaign_file(file)
    if figure not in asked.keep:
        raise RailgripError(unknown_name("--figure", "kept figure", figure, asked.keep))
    with working("running"):
        found = sobol_indices(Batches(asked), figure, runs)
    rows = [
        [one.name, f"{one.first:.3f} [{one.first_low:.3f}, {one.first_high:.3f}]",
         f"{one.total:.3f} [{one.total_low:.3f}, {one.total_high:.3f}]"]
        for one in found
    ]  # fmt: skip
    print_table(f"Shares of the variance of {figure}", ["variable", "alone", "in all"], rows)
    return 0
