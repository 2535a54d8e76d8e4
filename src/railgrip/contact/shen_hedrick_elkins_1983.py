"""Creep force of one wheel (Shen, Hedrick and Elkins 1983)."""

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.kalker_linear import kalker_linear
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import scaled, size_of, slip_speed_of
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.contact.validity import valid_within

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


@valid_within(spin_share=0.5)
def shen_hedrick_elkins_rolling(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Creep forces for combined creepages and moderate spin (Shen, Hedrick and Elkins 1983).

    Choose it for vehicle dynamics on clean dry rail, away from the flange.

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
    With F_lin = √(F_x² + F_y²) of `kalker_linear` (spin in F_y) and f = F_lin/(μQ), both forces
    are multiplied by (f − f²/3 + f³/27)/f for f ≤ 3, else by 1/f. The original is about forces.
    For the spin moment conventions differ: left linear, left out, or, as here, reduced by the same
    factor as the forces, as if Kalker's coefficients were; that alone keeps the law passive.
    Known wrong when the spin is large (flange contact), and in the moment where its
    force and that of lateral creepage cancel.

    References
    ----------
    .. [1] Z. Y. Shen, J. K. Hedrick, J. A. Elkins, A comparison of alternative creep force models
       for rail vehicle dynamic analysis, Vehicle System Dynamics 12 (1983) 79–83,
       doi:10.1080/00423118308968725.

    Checked by tests/reference/creep_base_case, 1e-6, and tests/laws/test_rolling_laws.py.

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> force = shen_hedrick_elkins_rolling(base, rail, 20.0, Creepage(0.001, 0.0, 0.0))
    >>> round(force.longitudinal, 1)
    12306.0
    """
    linear = kalker_linear(contact, rail, speed, creepage)
    size = size_of(linear)
    slip_speed = slip_speed_of(speed, creepage)
    bounded = shen_hedrick_elkins_1983(rail, contact.load, size, slip_speed, 1.0)
    return scaled(linear, bounded / size)
