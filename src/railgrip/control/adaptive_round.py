"""How the adaptive supervisor begins, and when it looks again: the same for all it works above."""

from __future__ import annotations

from railgrip.control.adaptive_parameters import START, SUPERVISE_EVERY
from railgrip.control.adaptive_state import IS_ARMED, IS_DECIDED, RANGE, STATE, WAITED
from railgrip.control.adaptive_states import START_MACRO, START_MICRO
from railgrip.control.contract import MACRO, MICRO, FloatArray
from railgrip.control.state_layout import axle_base


def begin_supervision(
    parameters: FloatArray, state: FloatArray, n_axles: int, n_lead: float
) -> None:
    """Fill the state at the start (INIT in figure 4), but for the scale of each axle's signal.

    Parameters
    ----------
    parameters, state : ndarray
        With the places of `adaptive_parameters` and `adaptive_state`.
    n_axles : int
        Number of axles.
    n_lead : float
        So many axles at the front begin in macro-slip, whatever `START` says.
    """
    for axle in range(n_axles):
        state[axle_base(axle) + IS_ARMED] = 1.0
        state[axle_base(axle) + RANGE] = MACRO if axle < n_lead else parameters[START]
    is_reverse = parameters[START] == MICRO
    state[IS_DECIDED] = 1.0 if is_reverse else 0.0
    state[STATE] = START_MICRO if is_reverse else START_MACRO


def time_to_look(parameters: FloatArray, state: FloatArray, dt: float) -> float:
    """Return the time since the supervisor last looked if its turn has come, else 0, [s]."""
    waited = WAITED
    state[waited] += 1.0
    if state[waited] < parameters[SUPERVISE_EVERY]:
        return 0.0
    look = state[waited] * dt
    state[waited] = 0.0
    return float(look)
