"""Creep force of one wheel (Freibauer 1983), the formula that Polach's model grew out of."""

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.kalker_linear import kalker_linear
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import scaled, size_of, slip_speed_of
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.contact.validity import valid_within
from railgrip.core.formulas.elementary import arctangent

_QUARTER_PI = 0.7853981633974483
_TWO_OVER_PI = 0.6366197723675814
_LEAST_FORCE = 1e-12


def freibauer_1983(
    rail: RailFriction, load: float, slope: float, slip_speed: float, creepage: float
) -> float:
    """Adhesion force of one wheel at a given creepage (Freibauer 1983).

    Choose it for clean dry rails, or to compare with Čáp's paper; its slope is the full one of
    Kalker's theory in every rail condition, so on wet rails take `polach_2005`. It stays
    within 5.2 % of μQ of Kalker's exact theory.

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
    F = (2/π) μQ [arctan ε + ε/(1 + ε²)], ε = (π/4) slope s/(Qμ); the limit of FASTSIM with an
    elliptic traction bound. Čáp writes ε = s/(ρφ) with 1/ρ = (2π/3) a² b K/Q, the same for
    slope = (8/3) a² b K. Equal to `polach_2005` with k_A = k_S = 1.

    References
    ----------
    .. [1] L. Freibauer, Adheze kola vozidla na dráze, VŠDS Žilina 1983, 214–219, as quoted by
    .. [2] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 2.2–2.5.

    Checked by tests/reference/creep_base_case, 1e-6.

    Examples
    --------
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> round(freibauer_1983(rail, 100e3, 14.523733e6, 0.0, 0.001) / 30e3, 6)
    0.442801
    """
    limit = load * falling_friction(rail, slip_speed)
    stress = _QUARTER_PI * slope * creepage / max(limit, _LEAST_FORCE)
    angle = arctangent(stress)
    return _TWO_OVER_PI * limit * (stress / (1.0 + stress * stress) + angle)


@valid_within(spin_share=0.5)
def freibauer_rolling(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Creep forces for combined creepages and spin: linear theory, scaled to Freibauer's curve.

    Choose it as `freibauer_1983`. Čáp sums the creepages to one; here the forces of Kalker's linear
    theory are summed to one instead, which is the same along the track and keeps Kalker's slope
    across it. The spin moment is scaled as the forces are.

    Parameters
    ----------
    contact : RollingContact
        The contact.
    rail : RailFriction
        State of the rail; k_A and k_S are not used.
    speed : float
        Speed of the train, > 0 [m/s].
    creepage : Creepage
        Longitudinal and lateral creepage and spin.

    Returns
    -------
    CreepForce
        Forces [N] with the sign of the creepages, spin moment [N m].

    Notes
    -----
    With F_lin = √(F_x² + F_y²) of `kalker_linear`, all three are multiplied by F/F_lin, where
    F = (2/π) μQ [arctan ε + ε/(1 + ε²)], ε = (π/4) F_lin/(μQ).
    Known wrong when spin turns the slip within the patch, and in the moment where the forces by
    spin and by lateral creepage cancel.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 2.2–2.9.

    Checked by tests/reference/creep_base_case, 1e-6, and tests/laws/test_rolling_laws.py.

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> force = freibauer_rolling(base, rail, 20.0, Creepage(0.001, 0.0, 0.0))
    >>> round(force.longitudinal / 30e3, 6)
    0.442801
    """
    linear = kalker_linear(contact, rail, speed, creepage)
    size = size_of(linear)
    slip_speed = slip_speed_of(speed, creepage)
    return scaled(linear, freibauer_1983(rail, contact.load, size, slip_speed, 1.0) / size)
