"""Stepped filling: after a slide the brake comes back in pulses, not in one sweep."""

from __future__ import annotations

from railgrip.control.contract import FILL, HOLD, FloatArray
from railgrip.control.conventional_parameters import FILL_HOLD, FILL_PULSE, SETTLE_TIME
from railgrip.control.conventional_state import ADHERED_CLOCK, FILL_CLOCK


def step_filling(
    parameters: FloatArray, state: FloatArray, base: int, wished: float, dt: float
) -> float:
    """Return the dump valve for a wish: FILL becomes pulses until the axle has settled.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract; the clock of the pattern is in the state.
    base : int
        Where the axle's block begins in the state.
    wished : float
        FILL, HOLD or VENT.
    dt : float
        Period, [s].

    Examples
    --------
    >>> import numpy as np
    >>> from railgrip.control.conventional_parameters import ConventionalParameters
    >>> state = np.zeros(30)
    >>> valves = [step_filling(ConventionalParameters(), state, 12, FILL, 0.01) for _ in range(28)]
    >>> valves.count(FILL), valves.count(HOLD)
    (8, 20)
    """
    if wished != FILL:
        state[base + FILL_CLOCK] = 0.0
        return wished
    if state[base + ADHERED_CLOCK] > parameters[SETTLE_TIME]:
        return FILL
    clock = state[base + FILL_CLOCK]
    valve = FILL if clock < parameters[FILL_PULSE] else HOLD
    clock += dt
    if clock >= parameters[FILL_PULSE] + parameters[FILL_HOLD]:
        clock = 0.0
    state[base + FILL_CLOCK] = clock
    return valve
