"""Friction that falls with the slip speed (Polach 2005)."""

from railgrip.contact.rail_friction import RailFriction
from railgrip.core.formulas.elementary import exp_decay


def falling_friction(rail: RailFriction, slip_speed: float) -> float:
    """Friction coefficient of the rail at a slip speed.

    Choose it where one coefficient serves the whole patch. The local friction in each point of the
    patch, and the renewed rise by asperity vibration, are other models.

    Parameters
    ----------
    rail : RailFriction
        State of the rail.
    slip_speed : float
        Magnitude of the slip speed of wheel on rail, ≥ 0 [m/s].

    Returns
    -------
    float
        Friction coefficient, between A μ0 and μ0 [-].

    Notes
    -----
    μ = μ0 [(1 − A) e^(−B w) + A]. The form with a half-value speed, μ_k + μ_1 2^(−w/w_h), is the
    same with μ_k = A μ0, μ_1 = (1 − A) μ0, w_h = ln 2/B.

    References
    ----------
    .. [1] O. Polach, Wear 258 (2005) 992–1000, doi:10.1016/j.wear.2004.03.046.

    Examples
    --------
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> round(falling_friction(DRY_POLACH_2005, 0.2), 6)
    0.512684
    """
    fall = exp_decay(rail.friction_decay * slip_speed)
    share = (1.0 - rail.friction_ratio) * fall + rail.friction_ratio
    return rail.static_friction * share
