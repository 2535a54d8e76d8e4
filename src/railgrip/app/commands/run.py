"""`railgrip run`: one scenario, from file to report."""

from __future__ import annotations

from pathlib import Path

from railgrip.app import results
from railgrip.app.inputs import changes_from, formats_from, read_scenario
from railgrip.app.options import Changes, Json
from railgrip.app.screen import print_json, working


def run(
    file: str,
    /,
    *,
    out: Path | None = None,
    trace: str | None = None,
    changes: Changes = None,
    figures: str = "",
    no_report: bool = False,
    as_json: Json = False,
) -> int:
    """Brake the train of a scenario; print the figures and write the report.

    Ends with 1 when a limit was missed or the train did not stop, 2 on bad input.

    Parameters
    ----------
    file
        A scenario file, or a shipped scenario by name.
    out
        Folder for report, data and curves; ./out/SCENARIO if not given.
    trace
        Time between two points of the curves, e.g. "20 ms".
    changes
        Changes to the scenario, key=value, e.g. --set run.speed=120km/h wsp.controller=none.
    figures
        Also write figures for documents, in these formats: png,svg,pdf.
    no_report
        Print the figures, write no files.
    as_json
        Print one JSON object instead of the table.
    """
    wanted = changes_from(changes or [])
    if trace is not None:
        wanted["run.trace"] = trace
    formats = formats_from(figures)
    with working("reading the scenario"):
        name, scenario = read_scenario(file, wanted)
    with working("braking (the first run compiles the engine)"):
        import railgrip

        result = railgrip.simulate(scenario)
    files = []
    if not no_report:
        with working("writing the report"):
            files = results.write(result, out or Path("out") / name, formats)
    if as_json:
        print_json(results.as_json(result, files))
    else:
        results.show(result, name)
        results.name_files(files)
    return results.exit_code(result)
