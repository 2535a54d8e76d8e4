"""Creep force of one wheel (Shen, Hedrick and Elkins 1983)."""

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction

_LEAST_FORCE = 1e-12


def shen_hedrick_elkins_1983(
    rail: RailFriction, load: float, slope: float, slip_speed: float, creepage: float
) -> float:
    """Adhesion force of one wheel at a given creepage (Shen, Hedrick and Elkins 1983).

    Choose it for clean dry rails: without an arctangent it is the cheapest law, and with
    longitudinal creepage alone it stays within 2.2 % of μQ of Kalker's exact theory.
    Past f = 3 the patch slides and only the falling friction acts.

    Parameters
    ----------
    rail : RailFriction
        State of the rail; k_A and k_S are not used.
    load : float
        Wheel load Q, ≥ 0 [N].
    slope : float
        Initial slope of Kalker's linear theory, G a b C11 [N per unit creepage].
    slip_speed : float
        Magnitude of the slip speed, ≥ 0 [m/s].
    creepage : float
        Magnitude of the creepage, ≥ 0 [-].

    Returns
    -------
    float
        Magnitude of the force along the track, 0 … μQ [N].

    Notes
    -----
    f = slope s/(μQ); F = μQ (f − f²/3 + f³/27) for f ≤ 3, else μQ.
    Known wrong when the spin is large (flange contact).

    References
    ----------
    .. [1] Z. Y. Shen, J. K. Hedrick, J. A. Elkins, A comparison of alternative creep force models
       for rail vehicle dynamic analysis, Vehicle System Dynamics 12 (1983) 79–83,
       doi:10.1080/00423118308968725.

    Checked by tests/reference/creep_base_case, 1e-6.

    Examples
    --------
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> round(shen_hedrick_elkins_1983(rail, 100e3, 14.523733e6, 0.0, 0.001), 1)
    12306.0
    """
    limit = load * falling_friction(rail, slip_speed)
    f = min(3.0, slope * creepage / max(limit, _LEAST_FORCE))
    return limit * f * (1.0 - f * (1.0 / 3.0 - f * (1.0 / 27.0)))
