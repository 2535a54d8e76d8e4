"""`railgrip compare`: several runs side by side, or a simulated stop over a measured one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from railgrip.app import results
from railgrip.app.inputs import Named, changes_from, read_scenario
from railgrip.app.screen import print_json, print_table, working
from railgrip.core.errors import Problem, RailgripError

if TYPE_CHECKING:
    from railgrip.engine import Result


def compare(
    *files: str,
    controllers: str = "",
    measured: Path | None = None,
    channels: Annotated[Path | None, Parameter(name="--map")] = None,
    out: Path | None = None,
    changes: Annotated[list[str] | None, Parameter(name="--set", consume_multiple=True)] = None,
    report: Annotated[bool, Parameter(name="--report", negative="--no-report")] = True,
    as_json: Annotated[bool, Parameter(name="--json", negative="")] = False,
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
        Folder for the report; ./out/<first scenario>_compared if not given.
    changes
        Changes to every scenario, key=value.
    report
        Write files, or only print the figures.
    as_json
        Print one JSON object instead of the tables.
    """
    wanted = changes_from(changes or [])
    with working("reading the scenarios"):
        named = variants(files, wanted, [one for one in controllers.split(",") if one.strip()])
        record = _record(measured, channels)
    if len(named) == 1 and record is None:
        what = "there is nothing to compare the run with"
        cure = "a second scenario, --controllers a,b or --measured stop.csv"
        raise RailgripError(Problem("compare", what, cure=cure))
    runs = simulate_all(named)
    first_name, first = next(iter(runs.items()))
    overlay = None if record is None else record.over(first)
    files_written: list[Path] = []
    if report:
        ghost = {name: result for name, result in runs.items() if name != first_name}
        folder = out or Path("out") / f"{Path(files[0]).stem}_compared"
        with working("writing the report"):
            files_written = results.write(first, folder, ghost=ghost, measured=overlay)
    code = max(results.exit_code(result) for result in runs.values())
    if as_json:
        print_json(_as_json(runs, overlay, files_written, code))
        return code
    if len(runs) > 1:
        show(runs)
    if overlay is not None:
        show_measured(overlay)
    for name, result in runs.items():
        results.show_missed(result, name)
    results.name_files(files_written)
    return code


def simulate_all(named: list[Named]) -> dict[str, Result]:
    """Run every scenario; return the results by name, in order."""
    import railgrip

    runs: dict[str, Result] = {}
    for number, (name, scenario) in enumerate(named, 1):
        with working(f"braking {number} of {len(named)}: {name}"):
            label = name if name not in runs else f"{name} ({number})"
            runs[label] = railgrip.simulate(scenario)
    return runs


def variants(
    files: tuple[str, ...], changes: dict[str, Any], controllers: list[str]
) -> list[Named]:
    """Return each scenario, once for every controller if there are any."""
    if not files:
        cure = "railgrip compare dry.toml leaves.toml"
        raise RailgripError(Problem("compare", "no scenario is given", cure=cure))
    named = [read_scenario(file, changes) for file in files]
    if not controllers:
        return named
    found = []
    for name, scenario in named:
        for word in map(str.strip, controllers):
            label = Path(word).stem if len(named) == 1 else f"{name}, {Path(word).stem}"
            place = str(Path(word).resolve()) if word.endswith(".py") else word
            found.append(Named(label, scenario.with_({"wsp.controller": place})))
    return found


def _record(measured: Path | None, channels: Path | None) -> Any:
    if measured is None:
        if channels is not None:
            cure = "--measured stop.csv"
            raise RailgripError(Problem("--map", "needs a recorded stop", cure=cure))
        return None
    raise NotImplementedError
