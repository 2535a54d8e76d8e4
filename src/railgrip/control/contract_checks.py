"""The contract tests of a controller that need no train: shapes, faults, and the safe side.

Each check takes a way to make a fresh controller and returns the sentence of success, or raises
`ContractError` with the sentence of failure.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from railgrip.control.contract import FILL, VENT, Controller
from railgrip.control.contract_signals import (
    ContractError,
    Driven,
    bench_setup,
    drive,
    dry_stop,
    faults,
    locking,
)

Make = Callable[[], Controller]

LEAST_PERIOD: Final = 1.0e-3  # s
GREATEST_PERIOD: Final = 0.5  # s
DRAG: Final = 0.2  # brake demand that holds the speed on a falling gradient
ANSWER_TIME: Final = 0.5  # s: a locking axle must be released within it
LONGEST_RELEASE: Final = 20.0  # s: twice the usual safety timer
STAND_TIME: Final = 0.5  # s: time to find out that the train stands


def check_shape(make: Make) -> str:
    """The class has a period, ``reset`` and ``step``, and commands trains of any length."""
    controller = make()
    period = getattr(controller, "period", None)
    if not isinstance(period, int | float) or not LEAST_PERIOD <= period <= GREATEST_PERIOD:
        raise ContractError(f"period: got {period!r}, allowed 0.001 to 0.5 s")
    for n_axles in (1, 4, 33):
        controller = make()
        speeds = dry_stop(n_axles, controller.period, speed=6.0)
        driven = drive(controller, speeds)
        if n_axles > 1 and not np.isfinite(driven.reference_speed).all():
            raise ContractError("reference_speed: became no number")
    return "commands trains of 1, 4 and 33 axles with values that are allowed"


def check_determinism(make: Make) -> str:
    """The same signals give the same commands."""
    first = make()
    speeds = locking(4, first.period, 6.0)
    refuse_difference(drive(first, speeds), drive(make(), speeds), "the same signals")
    return "the same signals give the same commands"


def check_states_apart(make: Make) -> str:
    """Two states of one controller share nothing, and ``step`` keeps nothing in the class."""
    controller = make()
    speeds = locking(4, controller.period, 6.0)
    alone = drive(controller, speeds)
    setup = bench_setup(4, controller.period)
    one, other = controller.reset(setup), controller.reset(setup)
    drive(controller, dry_stop(4, controller.period), state=one)
    refuse_difference(alone, drive(controller, speeds, state=other), "a state beside another one")
    return "two states share nothing"


def check_faults(make: Make) -> str:
    """Signals that are no numbers, zero, negative or far too fast do no harm."""
    for n_axles in (1, 4):
        controller = make()
        drive(controller, faults(n_axles, controller.period))
    return "survives signals that are NaN, zero, negative or far too fast"


def check_standstill(make: Make) -> str:
    """At a stand every brake fills."""
    controller = make()
    driven = drive(controller, np.zeros((round(2.0 / controller.period), 4)))
    late = driven.dump_valve[round(STAND_TIME / controller.period) :]
    if not (late == FILL).all():
        raise ContractError(f"at a stand a dump valve was {_word(late)}, allowed FILL")
    return "at a stand every brake fills"


def check_dry_stop(make: Make) -> str:
    """Where nothing slides nothing is released."""
    controller = make()
    driven = drive(controller, dry_stop(4, controller.period))
    if (driven.dump_valve == VENT).any():
        tick = int(np.argmax((driven.dump_valve == VENT).any(axis=1)))
        raise ContractError(
            f"a dump valve was VENT {tick * controller.period:.2f} s into a stop without slides; "
            "try a higher slip threshold"
        )
    held = float((driven.dump_valve != FILL).mean())
    if held > 0.02:
        raise ContractError(f"valves did not fill for {held:.0%} of a stop without slides")
    if (driven.dynamic_share < 1.0).any():
        raise ContractError("the dynamic brake was reduced in a stop without slides")
    return "nothing is released in a stop without slides"


def check_locking(make: Make) -> str:
    """A locking axle is released in time, and the others are left alone."""
    controller = make()
    driven = drive(controller, locking(4, controller.period, 4.0), demand=DRAG)
    begin = round(2.0 / controller.period)
    vents = (driven.dump_valve == VENT)[begin:]
    if not vents[:, 1].any():
        raise ContractError("a locking axle was never released; try a lower slip threshold")
    answer = float(np.argmax(vents[:, 1])) * controller.period
    if answer > ANSWER_TIME:
        raise ContractError(
            f"a locking axle was released after {answer:.2f} s, allowed {ANSWER_TIME:g} s"
        )
    if vents[:, [0, 2, 3]].any():
        raise ContractError("axles that did not slide were released beside a locking one")
    return f"a locking axle is released after {answer:.2f} s"


def check_safety_timer(make: Make) -> str:
    """An axle whose signal stays at zero is not released for ever."""
    controller = make()
    driven = drive(controller, locking(4, controller.period, 4.0 + LONGEST_RELEASE), demand=DRAG)
    fills = driven.dump_valve[:, 1] == FILL
    begin = round(4.0 / controller.period)
    if not fills[begin:].any():
        raise ContractError(
            f"an axle was kept from filling for more than {LONGEST_RELEASE:g} s; "
            "try a safety timer, usually 10 s"
        )
    longest = float(np.argmax(fills[begin:])) * controller.period + 2.0
    return f"a released axle fills again after {longest:.1f} s at the latest"


CONTRACT_CHECKS: Final[dict[str, Callable[[Make], str]]] = {
    "shape": check_shape,
    "determinism": check_determinism,
    "states apart": check_states_apart,
    "faulty sensors": check_faults,
    "standstill": check_standstill,
    "stop without slides": check_dry_stop,
    "locking axle": check_locking,
    "safety timer": check_safety_timer,
}
"""Name of a check → the check; `railgrip check` and CI run all of them."""


def refuse_difference(one: Driven, other: Driven, what: str) -> None:
    """Refuse when two runs on the bench differ in any command."""
    for name, left, right in zip(Driven._fields, one, other, strict=True):
        if not np.array_equal(left, right):
            rows = np.flatnonzero((left != right).reshape(len(left), -1).any(axis=1))
            raise ContractError(f"{what} gave another {name} from step {rows[0]} on")


def _word(valves: np.ndarray) -> str:
    return "VENT" if (valves == VENT).any() else "HOLD"
