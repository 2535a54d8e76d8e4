"""Dynamic brake first: on a slide it hands over to the friction brake, then the valve works."""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_state import ADHERED_CLOCK, HANDED_OVER
from railgrip.core.formulas.choosing import choose


def hand_over(
    parameters: ConventionalParameters,
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
    parameters : ConventionalParameters
        By name.
    state : ndarray
        As in the controller contract.
    base : int
        Where the axle's values begin.
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
    >>> from railgrip.control.state_layout import state_size
    >>> state = np.zeros(state_size(1))
    >>> round(hand_over(ConventionalParameters(), state, 48, True, 8e3, 1.0, 0.03), 2)
    0.9
    """
    has_adhered = state[base + ADHERED_CLOCK] > parameters.dynamic_return_after
    is_out = choose(has_adhered, 0.0, state[base + HANDED_OVER])
    goes_out = wants_vent & (dynamic_force > parameters.dynamic_least_force)
    is_out = choose(goes_out, 1.0, is_out)
    state[base + HANDED_OVER] = is_out
    release = -dt / parameters.dynamic_release_time
    come_back = dt / parameters.dynamic_return_time
    return min(1.0, max(0.0, share + choose(is_out > 0.0, release, come_back)))
