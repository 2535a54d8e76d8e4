"""Does a controller keep its contract? What ``railgrip check my_wsp.py`` and CI both ask.

First on the bench, with given signals (`railgrip.control.contract_checks`); then, if it passes
there, in the train: a stop on dry rail, on leaves, and on water and detergent.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from railgrip.control.contract import Command, Controller, Measured, Setup
from railgrip.control.contract_checks import CONTRACT_CHECKS
from railgrip.control.contract_signals import ContractError
from railgrip.control.controller_file import describe_error, load_controller_class
from railgrip.control.no_protection import NoProtection
from railgrip.core.errors import RailgripError
from railgrip.core.status import RunStatus

DRY_TOLERANCE: Final = 0.02  # a controller may lengthen a dry stop by so much
LOCK_SPEED: Final = 30.0 / 3.6  # m/s: above it locks are counted
LONGEST_LOCK: Final = 2.0  # s: generous; good protections keep 0.4 s


class CheckResult(NamedTuple):
    """One check: its name, whether it was passed, and one sentence."""

    name: str
    passed: bool
    sentence: str


class PlainForm:
    """A controller without its compiled form, so that the engine steps it from Python."""

    def __init__(self, controller: Controller) -> None:
        self._controller = controller
        self.period = controller.period

    def reset(self, setup: Setup) -> Any:
        """Return a new state of the controller."""
        return self._controller.reset(setup)

    def step(self, state: Any, measured: Measured, dt: float) -> Command:
        """Return the controller's command."""
        return self._controller.step(state, measured, dt)


def check_controller(source: str | Path | Callable[[], Controller]) -> list[CheckResult]:
    """Return what each contract test says about a controller.

    Parameters
    ----------
    source : path or class
        A Python file with one controller class, or the class itself (anything that makes a
        controller when called without arguments).

    Returns
    -------
    list of CheckResult
        In the order in which they ran. Nothing is raised for a bad controller: each failure is a
        sentence. The stops in the train are left out if a test on the bench failed.

    Examples
    --------
    >>> check_controller("nowhere/my_wsp.py")[0].sentence
    'nowhere/my_wsp.py: no such file; try: give the path of a .py controller'
    """
    results = check_on_the_bench(source)
    if all(result.passed for result in results):
        path, make = _maker(source)
        results += [_checked(name, check, make, path) for name, check in TRAIN_CHECKS.items()]
    return results


def check_on_the_bench(source: str | Path | Callable[[], Controller]) -> list[CheckResult]:
    """Check a controller against the contract alone; arguments and returns as `check_controller`.

    Examples
    --------
    >>> check_on_the_bench("nowhere/my_wsp.py")[0].passed
    False
    """
    try:
        path, make = _maker(source)
    except RailgripError as error:
        return [CheckResult("file", False, str(error))]
    return [_checked(name, check, make, path) for name, check in CONTRACT_CHECKS.items()]


def _maker(source: str | Path | Callable[[], Controller]) -> tuple[Path | None, Any]:
    path = Path(source) if isinstance(source, str | Path) else None
    return path, load_controller_class(path) if path is not None else source


def _checked(name: str, check: Callable[[Any], str], make: Any, path: Path | None) -> CheckResult:
    """Run one check; whatever the controller does becomes a sentence."""
    try:
        return CheckResult(name, True, check(make))
    except (ContractError, RailgripError) as error:
        return CheckResult(name, False, str(error))
    except Exception as error:
        return CheckResult(name, False, f"the controller raised {describe_error(error, path)}")


def check_dry_train(make: Callable[[], Controller]) -> str:
    """A stop on dry rail is as short as without protection."""
    without = _stop("dry_emergency", NoProtection())
    with_it = _stop("dry_emergency", make())
    longer = float(with_it["stopping_distance"][0]) / float(without["stopping_distance"][0]) - 1.0
    if longer > DRY_TOLERANCE:
        raise ContractError(f"a stop on dry rail became {longer:.1%} longer, allowed 2 %")
    return f"a stop on dry rail is {longer:+.1%} longer than without protection"


def check_low_adhesion(make: Callable[[], Controller], scenario: str) -> str:
    """The train stops and no wheel locks for long."""
    data = _stop(scenario, make())
    distance = float(data["stopping_distance"][0])
    locked = longest_lock(data)
    if locked > LONGEST_LOCK:
        raise ContractError(
            f"{scenario}: a wheel was locked for {locked:.1f} s above 30 km/h, "
            f"allowed {LONGEST_LOCK:g} s"
        )
    return f"{scenario}: stops after {distance:.0f} m, longest lock {locked:.2f} s"


def check_compiled_form(make: Callable[[], Controller]) -> str:
    """The compiled form, if there is one, gives the same bits as the plain form."""
    controller = make()
    if not hasattr(controller, "kernel"):
        return "has no compiled form; it runs all the same, slower"
    compiled = _stop("coach_leaves", controller)
    plain = _stop("coach_leaves", PlainForm(make()))
    for name in ("stopping_distance", "axle_slid_distance", "axle_valve_cycles"):
        if not np.array_equal(compiled[name], plain[name]):
            raise ContractError(
                f"plain and compiled form differ in {name}; "
                "try the same operations in the same order, without numpy sums"
            )
    return "plain and compiled form give the same bits"


def longest_lock(data: Any) -> float:
    """Return the longest time for which a wheel was locked above 30 km/h, [s].

    Parameters
    ----------
    data : xarray.Dataset
        Of one run, with traces.
    """
    train = data["train_speed"].values[0]
    wheels = data["wheel_speed"].values[0]
    is_locked = (wheels < 0.05 * train) & (train > LOCK_SPEED)
    interval = float(data["time"][1] - data["time"][0])
    longest = 0
    for row in is_locked:
        ends = np.flatnonzero(np.diff(np.concatenate(([0], row.astype(int), [0]))))
        longest = max(longest, int((ends[1::2] - ends[::2]).max(initial=0)))
    return longest * interval


def _stop(name: str, controller: Any) -> Any:
    """Return the dataset of a shipped scenario under a controller; refuse a train that goes on."""
    import railgrip

    result = railgrip.simulate(railgrip.load(name), controller=controller)
    if result.status != RunStatus.STOPPED:
        raise ContractError(f"{name}: {result.sentence}")
    return result.data


TRAIN_CHECKS: Final[dict[str, Callable[[Any], str]]] = {
    "dry rail": check_dry_train,
    "leaves": functools.partial(check_low_adhesion, scenario="leaves_160"),
    "water and detergent": functools.partial(check_low_adhesion, scenario="detergent_160"),
    "compiled form": check_compiled_form,
}
"""Name of a check in the train → the check."""
