"""Creep force of one wheel (Polach 2005): the default law of the plant."""

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction
from railgrip.core.formulas.elementary import arctangent

_QUARTER_PI = 0.7853981633974483
_TWO_OVER_PI = 0.6366197723675814
_LEAST_FORCE = 1e-12


def polach_2005(
    rail: RailFriction, load: float, slope: float, slip_speed: float, creepage: float
) -> float:
    """Adhesion force of one wheel at a given creepage (Polach 2005).

    Choose it for braking and traction at the adhesion limit: it has the flatter slope of wet and
    contaminated rails and the maximum with the falling branch behind it. For small creepage on a
    clean dry rail Kalker's theory says the same.

    Parameters
    ----------
    rail : RailFriction
        State of the rail.
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
        Magnitude of the force along the track, 0 … μQ [N]; the caller gives it its sign.

    Notes
    -----
    ε = (2/3) C π a² b s/(Qμ) with C = (3G/8a) C11, that is ε = (π/4) slope s/(Qμ);
    F = (2Qμ/π) [k_A ε/(1 + (k_A ε)²) + arctan(k_S ε)], μ from `falling_friction`.
    The initial slope is (k_A + k_S)/2 of Kalker's. Spin and lateral creepage are left out. Where
    Qμ = 0 the force is 0.
    Known trap: a public program codes 1 + k_A ε² in place of 1 + (k_A ε)².
    Known wrong when the friction coefficient differs within the patch.

    References
    ----------
    .. [1] O. Polach, Creep forces in simulations of traction vehicles running on adhesion limit,
       Wear 258 (2005) 992–1000, doi:10.1016/j.wear.2004.03.046.

    Checked by tests/reference/polach_base_case, 1e-5.

    Examples
    --------
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> round(polach_2005(DRY_POLACH_2005, 100e3, 14.523733e6, 0.2, 0.01), 2)
    35940.38
    """
    limit = load * falling_friction(rail, slip_speed)
    stress = _QUARTER_PI * slope * creepage / max(limit, _LEAST_FORCE)
    stick = rail.adhesion_reduction * stress
    angle = arctangent(rail.slip_reduction * stress)
    return _TWO_OVER_PI * limit * (stick / (1.0 + stick * stick) + angle)
