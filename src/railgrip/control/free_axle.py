"""One axle is let run free now and then, so that it shows the train's speed.

Dead reckoning drifts. While enough axles turn at the reference speed it is trusted; while none
does, the possible error grows with time, and beyond a share of the slip band the fastest axle is
released until it turns with the train.
"""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import (
    DRIFT_FLOOR,
    DRIFT_RATE,
    DRIFT_SHARE,
    FREE_LONGEST,
    INHIBIT_SPEED,
)
from railgrip.control.conventional_state import (
    COUNTED_SPEED,
    DRIFT,
    FREED_AXLE,
    FREED_TIME,
    IS_BRAKED,
    IS_MOTORED,
    REFERENCE,
)
from railgrip.control.state_layout import axle_base


def free_an_axle(
    parameters: FloatArray,
    state: FloatArray,
    n_axles: int,
    is_witnessed: bool,
    slip_lower: float,
    dt: float,
) -> None:
    """Decide which axle, if any, runs free to show the train's speed.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    n_axles : int
        Number of axles.
    is_witnessed : bool
        Whether enough axles adhere for the reference speed to be trusted.
    slip_lower : float
        Slip at the lower threshold of the narrowest band in use.
    dt : float
        Period, [s].
    """
    reference = state[REFERENCE]
    if is_witnessed:
        state[DRIFT] = 0.0
    else:
        state[DRIFT] += parameters[DRIFT_RATE] * dt
    if state[FREED_AXLE] > 0.0:
        state[FREED_TIME] += dt
        # A sight resets the drift, so does adhesion come back.
        is_over = state[DRIFT] <= 0.0 or state[FREED_TIME] > parameters[FREE_LONGEST]
        if is_over or reference < parameters[INHIBIT_SPEED]:
            state[FREED_AXLE] = 0.0
            state[DRIFT] = 0.0
        return
    trusted = max(parameters[DRIFT_FLOOR], parameters[DRIFT_SHARE] * slip_lower * reference)
    if state[DRIFT] > trusted and reference > parameters[INHIBIT_SPEED]:
        candidate = fastest_to_free(state, n_axles)
        if candidate >= 0:
            state[FREED_AXLE] = 1.0 + candidate
            state[FREED_TIME] = 0.0


def fastest_to_free(state: FloatArray, n_axles: int) -> int:
    """Return the axle, faster than all before it, that can be released; -1 for none."""
    fastest = 0.0
    candidate = -1
    for axle in range(n_axles):
        base = axle_base(axle)
        speed = state[base + COUNTED_SPEED]
        if speed > fastest:
            fastest = speed
            if state[base + IS_BRAKED] + state[base + IS_MOTORED] > 0.0:
                candidate = axle
    return candidate
