"""`railgrip check`: is this scenario, or this controller, in order?"""

from __future__ import annotations

from pathlib import Path

from railgrip.app.options import Json
from railgrip.app.screen import print_json, print_table, working
from railgrip.core.errors import Problem, RailgripError

IN_ORDER, NOT_IN_ORDER = 0, 1


def check(file: str, /, *, as_json: Json = False) -> int:
    """Check a scenario (.toml) without running it, or a controller (.py) on bench and train.

    A scenario: everything that is wrong, at once, with its place (exit code 2). A controller: the
    contract tests that every registered controller passes (exit code 1 if one fails).

    Parameters
    ----------
    file
        A scenario file, a shipped scenario by name, or a controller's Python file.
    as_json
        Print one JSON object.
    """
    if Path(file).suffix == ".py":
        return _check_controller(file, as_json)
    return _check_scenario(file, as_json)


def _check_scenario(file: str, as_json: bool) -> int:
    with working("reading the scenario"):
        import railgrip
        from railgrip.core import registry
        from railgrip.scenario.describe import describe

        scenario = railgrip.load(file)
        law = scenario.run.creep_law
        group = registry.group_of(law, ("railgrip.laws", "railgrip.rolling_laws"))
        registry.resolve(group, law, "run.creep_law")
        for protection in scenario.wsp.unit or [scenario.wsp]:
            _check_protection(protection.controller)
    if as_json:
        print_json({"file": file, "in_order": True, "title": scenario.title, "exit_code": IN_ORDER})
    else:
        print(f"{describe(scenario)}\n{file} is in order.")
    return IN_ORDER


def _check_protection(controller: str) -> None:
    from railgrip.core import registry

    if controller.endswith(".py"):
        if not Path(controller).is_file():
            raise RailgripError(Problem("wsp.controller", "no such file", got=controller))
    elif controller != "none":
        registry.resolve("railgrip.controllers", controller, "wsp.controller")


def _check_controller(file: str, as_json: bool) -> int:
    from railgrip.campaign.controller_check import check_controller
    from railgrip.control.controller_file import load_controller_class

    make = load_controller_class(file)  # what cannot be loaded is bad input, not a bad controller
    with working("checking the controller, on the bench and in a train"):
        found = check_controller(file)
    code = IN_ORDER if all(result.passed for result in found) else NOT_IN_ORDER
    if as_json:
        checks = [result._asdict() for result in found]
        print_json({"file": file, "in_order": not code, "checks": checks, "exit_code": code})
        return code
    rows = [[name, "passed" if passed else "FAILED", sentence] for name, passed, sentence in found]
    print_table(f"{make.__name__} in {file}", ["check", "", ""], rows, to_the_right=False)
    print(f"The controller {'keeps' if code == IN_ORDER else 'breaks'} the contract.")
    return code
