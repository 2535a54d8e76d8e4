"""Dynamic brake first: on a slide it hands over to the friction brake, then the valve works."""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import (
    DYNAMIC_LEAST_FORCE,
    DYNAMIC_RELEASE_TIME,
    DYNAMIC_RETURN_AFTER,
    DYNAMIC_RETURN_TIME,
)
from railgrip.control.conventional_state import ADHERED_CLOCK, HANDED_OVER


def hand_over(
    parameters: FloatArray,
    state: FloatArray,
    base: int,
    wants_vent: bool,
    dynamic_force: float,
    share: float,
    dt: float,
) -> float:
    """Return the permitted share of the dynamic brake.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    base : int
        Where the axle's block begins in the state.
    wants_vent : bool
        Whether the slip asks for less brake force.
    dynamic_force : float
        Dynamic brake force achieved, [N].
    share : float
        Share permitted until now, 0..1.
    dt : float
        Period, [s].

    Notes
    -----
    Two brakes that are both modulated on one axle hunt each other, so the dynamic brake goes out
    altogether; it comes back slowly when the axle has adhered for `dynamic_return_after`.

    Examples
    --------
    >>> import numpy as np
    >>> from railgrip.control.conventional_parameters import ConventionalParameters
    >>> state = np.zeros(30)
    >>> round(hand_over(ConventionalParameters(), state, 12, True, 8e3, 1.0, 0.03), 2)
    0.9
    """
    if wants_vent and dynamic_force > parameters[DYNAMIC_LEAST_FORCE]:
        state[base + HANDED_OVER] = 1.0
    elif state[base + ADHERED_CLOCK] > parameters[DYNAMIC_RETURN_AFTER]:
        state[base + HANDED_OVER] = 0.0
    if state[base + HANDED_OVER] > 0.0:
        change: float = -dt / parameters[DYNAMIC_RELEASE_TIME]
    else:
        change = dt / parameters[DYNAMIC_RETURN_TIME]
    return min(1.0, max(0.0, share + change))
