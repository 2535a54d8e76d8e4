"""`railgrip demo`: the main job on a real line, with and without wheel-slide protection."""

from __future__ import annotations

from pathlib import Path

from railgrip.app import results
from railgrip.app.commands.compare import as_json_of, show
from railgrip.app.inputs import read_scenario
from railgrip.app.options import Json
from railgrip.app.runs import simulate_all, variants
from railgrip.app.screen import print_json, working


def demo(
    *,
    out: Path | None = None,
    no_report: bool = False,
    as_json: Json = False,
) -> int:
    """Brake a train on a slippery real line, with and without wheel-slide protection.

    Parameters
    ----------
    out
        Folder for report, data, curves and figures; ./out/demo if not given.
    no_report
        Print the figures, write no files.
    as_json
        Print one JSON object instead of the table.
    """
    with working("reading the scenario"):
        named = variants([read_scenario("demo")], ["conventional", "none"])
    runs = simulate_all(named)
    protected, locked = runs.values()
    files = []
    if not no_report:
        with working("writing the report"):
            folder = out or Path("out") / "demo"
            files = results.write(protected, folder, ("png",), ghost={"without protection": locked})
    if as_json:
        print_json(as_json_of(runs, None, files, results.exit_code(protected)))
    else:
        show(runs, title=protected.scenario.title)
        results.name_files(files)
    return results.exit_code(protected)
