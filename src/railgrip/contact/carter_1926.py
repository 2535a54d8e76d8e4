"""Creep force of one wheel (Carter 1926), exact in two dimensions."""

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction

_LEAST_FORCE = 1e-12


def carter_1926(
    rail: RailFriction, load: float, slope: float, slip_speed: float, creepage: float
) -> float:
    """Adhesion force of one wheel at a given creepage (Carter 1926).

    Choose it for cylinders, or a worn flat rail head with a patch much wider than it is long. On an
    ellipse it saturates too early.

    Parameters
    ----------
    rail : RailFriction
        State of the rail; k_A and k_S are not used.
    load : float
        Wheel load Q, ≥ 0 [N].
    slope : float
        Initial slope [N per unit creepage]; Carter's own is 2 Q R/a, R the wheel radius.
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
    F = μQ [1 − (1 − s R/(μa))²] up to s = μa/R, then μQ; written with the slope,
    u = min(1, slope s/(2 μQ)), F = μQ u (2 − u).

    References
    ----------
    .. [1] F. W. Carter, On the action of a locomotive driving wheel, Proc. R. Soc. A 112 (1926)
       151–157, doi:10.1098/rspa.1926.0100.

    Checked by tests/laws/test_contact_creep_laws.py.

    Examples
    --------
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> round(carter_1926(rail, 100e3, 2 * 100e3 * 0.46 / 0.006, 0.0, 0.001), 1)
    13374.1
    """
    limit = load * falling_friction(rail, slip_speed)
    u = min(1.0, 0.5 * slope * creepage / max(limit, _LEAST_FORCE))
    return limit * u * (2.0 - u)
