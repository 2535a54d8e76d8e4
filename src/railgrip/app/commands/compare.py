"""`railgrip compare`: several runs side by side, or a simulated stop over a measured one."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from railgrip.app import results
from railgrip.app.files import folder_of_results
from railgrip.app.inputs import Named, changes_from, formats_from, read_scenario
from railgrip.app.options import Changes, Json
from railgrip.app.runs import simulate_all, variants
from railgrip.app.screen import as_plain, print_json, print_table, working
from railgrip.core.errors import Problem, RailgripError

if TYPE_CHECKING:
    from railgrip.engine.result import Result
    from railgrip.io.measured import MeasuredComparison


def compare(
    *files: str,
    controllers: str = "",
    measured: Path | None = None,
    channels: Annotated[Path | None, Parameter(name="--map")] = None,
    out: Path | None = None,
    seed: int | None = None,
    changes: Changes = None,
    figures: str = "",
    no_report: bool = False,
    as_json: Json = False,
) -> int:
    """Put runs side by side; the first is what the others are compared with.

    Ends with 1 when a limit was missed or a train did not stop, 2 on bad input.

    Parameters
    ----------
    files
        Scenario files, or shipped scenarios by name.
    controllers
        Run each scenario with each of these, e.g. conventional,my_wsp.py,none.
    measured
        A recorded stop, CSV; it is laid over the first run.
    channels
        Channel map of the recorded stop, TOML.
    out
        Folder for the report, or a page NAME.html; ./out/SCENARIO_compared if not given.
    seed
        Of the random rail and of noise, the same for all; that of each scenario if not given.
    changes
        Changes to every scenario, key=value.
    figures
        Also write figures for documents, in these formats: png,svg,pdf.
    no_report
        Print the figures, write no files.
    as_json
        Print one JSON object instead of the tables.
    """
    words = [word.strip() for word in controllers.split(",") if word.strip()]
    _refuse_nothing_to_compare(files, words, measured, channels)
    _refuse_a_crowd(len(files) * max(len(words), 1), no_report, measured, out)
    wanted, formats = changes_from(changes or []), formats_from(figures)
    with working("reading the scenarios"):
        read = [_with_seed(read_scenario(file, wanted), seed) for file in files]
        named = variants(read, words)
    runs = simulate_all(named)
    first, *others = runs
    overlay = _laid_over(runs[first], measured, channels)
    written: list[Path] = []
    code = max(map(results.exit_code, runs.values()))
    if not no_report:
        target = out or Path("out") / f"{Path(files[0]).stem}_compared"
        with working("writing the report"):
            written = _write(runs, target, formats, overlay, code)
    if as_json:
        print_json(as_json_of(runs, overlay, written, code))
        return code
    if others:
        show(runs)
        show_differences(runs)
    if overlay is not None:
        show_measured(overlay)
    for name, result in runs.items():
        results.show_missed(result, name)
    results.name_files(written)
    return code


def _refuse_nothing_to_compare(
    files: tuple[str, ...], controllers: list[str], measured: Path | None, channels: Path | None
) -> None:
    if not files:
        cure = "railgrip compare dry.toml leaves.toml"
        raise RailgripError(Problem("compare", "no scenario is given", cure=cure))
    if len(files) * max(len(controllers), 1) == 1 and measured is None:
        what = "there is nothing to compare the run with"
        cure = "a second scenario, --controllers a,b or --measured stop.csv"
        raise RailgripError(Problem("compare", what, cure=cure))
    if (measured is None) != (channels is None):
        what = "--measured and --map belong together"
        cure = "--measured stop.csv --map channels.toml"
        raise RailgripError(Problem("compare", what, cure=cure))


def _with_seed(named: Named, seed: int | None) -> Named:
    """Return the scenario with another seed; a random field with a seed of its own gets it too."""
    if seed is None:
        return named
    field = named.scenario.rail.random
    changes = {"run.seed": seed}
    if field is not None and field.seed is not None:
        changes["rail.random.seed"] = seed
    return Named(named.name, named.scenario.with_(changes))


def _refuse_a_crowd(runs: int, no_report: bool, measured: Path | None, out: Path | None) -> None:
    """Refuse before the first run what the report could not hold."""
    from railgrip.report.comparison_page import MOST

    if runs > MOST and not no_report:
        what, cure = "too many runs for one page", "--no-report, or fewer of them"
        got, allowed = f"{runs}", f"2 to {MOST}"
        raise RailgripError(Problem("compare", what, got=got, allowed=allowed, cure=cure))
    if measured is not None and out is not None and out.suffix == ".html":
        what, cure = "is a folder where a stop is measured", f"--out {out.with_suffix('')}"
        raise RailgripError(Problem("--out", what, got=str(out), cure=cure))


def _write(
    runs: dict[str, Result],
    target: Path,
    formats: list[str],
    overlay: MeasuredComparison | None,
    code: int,
) -> list[Path]:
    """Write page and tables; a folder also gets the data of the first run."""
    from railgrip.report.comparison_page import comparison_csv, comparison_html

    first, *others = runs
    if overlay is not None:  # a measured stop lies over one run
        ghost = {name: runs[name] for name in others}
        return results.write(runs[first], target, formats, ghost=ghost, measured=overlay)
    said = json.dumps(as_plain(as_json_of(runs, None, [], code)), indent=2, ensure_ascii=False)
    if target.suffix != ".html":
        pages = {
            "report.html": comparison_html(runs),
            "comparison.csv": comparison_csv(runs),
            "comparison.json": said,
        }
        return results.write(runs[first], target, formats, pages=pages)
    with folder_of_results(target.parent) as aside:
        pages = {".html": comparison_html(runs), ".csv": comparison_csv(runs), ".json": said}
        for suffix, text in pages.items():
            (aside / target.with_suffix(suffix).name).write_text(text, encoding="utf-8")
    return [target.with_suffix(suffix) for suffix in pages]


def _laid_over(
    result: Result, measured: Path | None, channels: Path | None
) -> MeasuredComparison | None:
    if measured is None or channels is None:
        return None
    from railgrip.io.measured import compare_measured, read_measured

    return compare_measured(result, read_measured(measured, channels))


def show(runs: dict[str, Result], title: str = "") -> None:
    """Print the figures of all runs, with the difference to the first."""
    from railgrip.report.metrics import metrics

    figures = [{metric.name: metric for metric in metrics(result)} for result in runs.values()]
    first, *others = figures
    rows = [
        [metric.label, metric.text, *(_against(metric, other.get(name)) for other in others)]
        for name, metric in first.items()
    ]
    print_table(title or "Compared", ["", *runs], rows)


def show_differences(runs: dict[str, Result]) -> None:
    """Say in a sentence each how the other runs differ from the first."""
    from railgrip.report.differences import differences
    from railgrip.report.metrics import metrics

    first = next(iter(runs))
    for told in differences({name: metrics(result) for name, result in runs.items()}, first):
        print(told)


def _against(base: Any, other: Any) -> str:
    if other is None:
        return "–"
    change = (other.value - base.value) / abs(base.value) if base.value else math.nan
    # Beyond twice as much, and for an error of rounding, a percentage tells nothing.
    if not 0 < abs(change) <= 2 or base.name == "energy_balance":
        return str(other.text)
    return f"{other.text}  ({change:+.1%})"


def show_measured(overlay: MeasuredComparison) -> None:
    """Print what differs between the simulated and the measured stop."""
    rows = [
        [
            row.label,
            _number(row.simulated),
            _number(row.measured),
            _number(row.difference, "+"),
            row.unit,
        ]
        for row in overlay.rows
    ]
    heads = ["", "simulated", "measured", "difference", "unit"]
    print_table(f"Simulated and measured: {overlay.title}", heads, rows)


def _number(value: float, sign: str = "") -> str:
    return f"{value:{sign}.4g}" if value == value else "–"


def as_json_of(
    runs: dict[str, Result], overlay: MeasuredComparison | None, files: list[Path], code: int
) -> dict[str, Any]:
    """Return what `--json` prints of several runs."""
    found: dict[str, Any] = {
        "runs": {name: results.as_json(result, []) for name, result in runs.items()}
    }
    if overlay is not None:
        found["measured"] = {row.name: row._asdict() for row in overlay.rows}
    return {**found, "files": [str(path) for path in files], "exit_code": code}
