"""What a finished run gives: files, a table of figures with their limits, an exit code."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from railgrip.app.files import folder_of_results
from railgrip.app.screen import print_table
from railgrip.core.status import ENDED_WELL

if TYPE_CHECKING:
    from railgrip.engine.result import Result
    from railgrip.report.limits import Verdict

DONE, MISSED = 0, 1


def verdicts(result: Result) -> list[Verdict]:
    """Return each limit of the scenario with what the run made of it."""
    from railgrip.report.limits import check_limits

    return check_limits(result, result.scenario.limits.model_dump(exclude_none=True))


def ended_well(result: Result) -> bool:
    """Whether the train did what was asked: it stopped, arrived, or ran for its time."""
    return result.status in ENDED_WELL


def exit_code(result: Result) -> int:
    """Return 0, or 1 when the run did not end well or a limit was missed."""
    return DONE if ended_well(result) and all(one.passed for one in verdicts(result)) else MISSED


def as_json(result: Result, files: list[Path]) -> dict[str, Any]:
    """Return what `--json` prints of one run."""
    from railgrip.report.metrics import metrics

    return {
        "title": result.scenario.title,
        "status": result.status.name,
        "sentence": result.sentence,
        "metrics": {m.name: {"value": m.value, "unit": m.unit} for m in metrics(result)},
        "limits": [verdict._asdict() for verdict in verdicts(result)],
        "files": [str(path) for path in files],
        "exit_code": exit_code(result),
    }


def show(result: Result, name: str) -> None:
    """Print the figures of one run with their limits."""
    from railgrip.report.metrics import metrics

    rows = [[metric.label, metric.text] for metric in metrics(result)]
    print_table(result.scenario.title or name, ["", "result"], rows)
    for verdict in verdicts(result):
        print(verdict.text)
    print(result.sentence)


def write(
    result: Result,
    folder: Path,
    formats: Sequence[str] = (),
    pages: Mapping[str, str] | None = None,
    **report: Any,
) -> list[Path]:
    """Write report, data and curves into a folder, all or nothing; return their paths.

    Parameters
    ----------
    result : Result
        What the engine gave, with traces.
    folder : Path
        Made if it is not there.
    formats : sequence of str
        ``png``, ``svg``, ``pdf``: figures for documents, which take longer than the simulation.
    pages : mapping, optional
        File name → text, in place of the report about the one run.
    **report
        ``ghost`` and ``measured`` of `railgrip.report.html.write_report`.
    """
    from railgrip.io.csv_file import write_csv
    from railgrip.io.netcdf import save
    from railgrip.report.html import write_report

    with folder_of_results(folder) as aside:
        if pages is None:
            write_report(result, aside / "report.html", **report)
        for name, text in (pages or {}).items():
            (aside / name).write_text(text, encoding="utf-8")
        save(result, aside / "result.nc")
        write_csv(result, aside / "traces.csv")
        if formats:
            from railgrip.report.plots import save_figures

            save_figures(result, aside, formats)
        names = sorted(path.name for path in aside.iterdir())
    names.sort(key=lambda name: name != "report.html")
    return [folder / name for name in names]


def show_missed(result: Result, name: str) -> None:
    """Print what a run among others missed, nothing if all is well."""
    if not ended_well(result):
        print(f"{name}: {result.sentence}")
    for verdict in verdicts(result):
        if not verdict.passed:
            print(f"{name}: {verdict.text}")


def name_files(files: list[Path]) -> None:
    """Say where the report is, and what else was written."""
    if files:
        others = ", ".join(path.name for path in files[1:])
        print(f"Report: {files[0]}\nBeside it: {others}")
