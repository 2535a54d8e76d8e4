"""When an axle asks for sand."""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import SAND_ABOVE, SAND_AFTER, SAND_TIME
from railgrip.control.conventional_state import REFERENCE, SAND_CLOCK, SLIDES


def request_sand(parameters: FloatArray, state: FloatArray, base: int, dt: float) -> float:
    """Return 1 while the axle wants sand, else 0.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract. The clock in the state counts down from zero while the axle
        slides without sand, and down from `sand_time` while sand is asked for.
    base : int
        Where the axle's block begins in the state.
    dt : float
        Period, [s].
    """
    clock = state[base + SAND_CLOCK]
    if state[base + SLIDES] > 0.0 and state[REFERENCE] > parameters[SAND_ABOVE]:
        is_due = clock > 0.0 or clock <= -parameters[SAND_AFTER]
        clock = parameters[SAND_TIME] if is_due else clock - dt
    else:
        clock = max(0.0, clock - dt)
    state[base + SAND_CLOCK] = clock
    return 1.0 if clock > 0.0 else 0.0
