"""What a finished run gives: files, a table of figures with their limits, an exit code."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from railgrip.app.files import folder_of_results
from railgrip.app.screen import print_table
from railgrip.core.status import RunStatus

if TYPE_CHECKING:
    from railgrip.engine import Result
    from railgrip.report.limits import Verdict

DONE, MISSED = 0, 1


def verdicts(result: Result) -> list[Verdict]:
    """Return each limit of the scenario with what the run made of it."""
    from railgrip.report.limits import check_limits

    return check_limits(result, result.scenario.limits.model_dump(exclude_none=True))


def stopped(result: Result) -> bool:
    """Whether the train came to a stand."""
    return int(result.data["status"][0]) == RunStatus.STOPPED


def exit_code(result: Result) -> int:
    """Return 0, or 1 when the train did not stop or a limit was missed."""
    return DONE if stopped(result) and all(one.passed for one in verdicts(result)) else MISSED


def as_json(result: Result, files: list[Path]) -> dict[str, Any]:
    """Return what `--json` prints of one run."""
    from railgrip.report.metrics import metrics, status_sentence

    return {
        "title": result.scenario.title,
        "status": RunStatus(int(result.data["status"][0])).name,
        "sentence": status_sentence(result),
        "metrics": {m.name: {"value": m.value, "unit": m.unit} for m in metrics(result)},
        "limits": [
            {"name": v.name, "value": v.value, "limit": v.limit, "unit": v.unit, "passed": v.passed}
            for v in verdicts(result)
        ],
        "files": [str(path) for path in files],
        "exit_code": exit_code(result),
    }


def show(result: Result, name: str) -> None:
    """Print the figures of one run with their limits."""
    from railgrip.report.metrics import metrics, status_sentence

    held = {verdict.name: verdict for verdict in verdicts(result)}
    rows = []
    for metric in metrics(result):
        verdict = held.get(metric.name)
        limit = f"{verdict.limit:g} {verdict.unit}".strip() if verdict else ""
        word = ("kept" if verdict.passed else "MISSED") if verdict else ""
        rows.append([metric.label, metric.text, limit, word])
    print_table(result.scenario.title or name, ["", "result", "limit", ""], rows)
    print(status_sentence(result))


def write(result: Result, folder: Path, **report: Any) -> list[Path]:
    """Write report, data, curves and figures into a folder, all or nothing; return their paths."""
    # Each of these is heavy, so they are imported when they are needed.
    csv_file, netcdf, html, plots = (
        importlib.import_module(f"railgrip.{name}")
        for name in ("io.csv_file", "io.netcdf", "report.html", "report.plots")
    )
    with folder_of_results(folder) as aside:
        html.write_report(result, aside / "report.html", **report)
        netcdf.save(result, aside / "result.nc")
        csv_file.write_csv(result, aside / "traces.csv")
        plots.save_figures(result, aside)
        names = sorted(path.name for path in aside.iterdir())
    names.sort(key=lambda name: name != "report.html")
    return [folder / name for name in names]


def name_files(files: list[Path]) -> None:
    """Say where the report is, and what else was written."""
    if files:
        others = ", ".join(path.name for path in files[1:])
        print(f"Report: {files[0]}\nBeside it: {others}")
