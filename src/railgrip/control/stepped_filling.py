"""Stepped filling: after a slide the brake comes back in pulses, not in one sweep."""

from __future__ import annotations

from railgrip.control.contract import FILL, HOLD, FloatArray
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_state import ADHERED_CLOCK, FILL_CLOCK
from railgrip.core.formulas.choosing import choose


def step_filling(
    parameters: ConventionalParameters, state: FloatArray, base: int, wished: float, dt: float
) -> float:
    """Return the dump valve for a wish: FILL becomes pulses until the axle has settled.

    Parameters
    ----------
    parameters : ConventionalParameters
        By name.
    state : ndarray
        As in the controller contract; the clock of the pattern is in it.
    base : int
        Where the axle's values begin.
    wished : float
        FILL, HOLD or VENT.
    dt : float
        Period, [s].

    Examples
    --------
    >>> import numpy as np
    >>> from railgrip.control.conventional_parameters import ConventionalParameters
    >>> from railgrip.control.state_layout import state_size
    >>> state = np.zeros(state_size(1))
    >>> valves = [step_filling(ConventionalParameters(), state, 48, FILL, 0.01) for _ in range(28)]
    >>> valves.count(FILL), valves.count(HOLD)
    (8, 20)
    """
    clock = state[base + FILL_CLOCK]
    has_settled = state[base + ADHERED_CLOCK] > parameters.settle_time
    valve = choose(has_settled | (clock < parameters.fill_pulse), FILL, HOLD)
    after = clock + dt
    after = choose(after >= parameters.fill_pulse + parameters.fill_hold, 0.0, after)
    after = choose(has_settled, clock, after)
    fills = wished == FILL
    state[base + FILL_CLOCK] = choose(fills, after, 0.0)
    return choose(fills, valve, wished)
