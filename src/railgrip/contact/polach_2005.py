"""Creep force of one wheel (Polach 2005): the default law of the plant."""

import math

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import resultant, slip_speed_of
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.contact.validity import valid_within
from railgrip.core.formulas.elementary import arctangent, exp_decay

_QUARTER_PI = 0.7853981633974483
_TWO_OVER_PI = 0.6366197723675814
_LEAST_FORCE = 1e-12
_LEAST_CREEPAGE = 1e-15


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


@valid_within(spin_share=3.0)
def polach_rolling(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Creep forces for combined creepages and spin (Polach 1999, with the rail of 2005).

    Choose it as `polach_2005`, where the wheel also creeps sideways or spins: curves, flange. It
    gives no spin moment.

    Parameters
    ----------
    contact : RollingContact
        The contact.
    rail : RailFriction
        State of the rail.
    speed : float
        Speed of the train, > 0 [m/s].
    creepage : Creepage
        Longitudinal and lateral creepage and spin.

    Returns
    -------
    CreepForce
        Forces [N] with the sign of the creepages; the spin moment is zero.

    Notes
    -----
    s = √(s_x² + s_y²); s_yC = s_y + φ a where that is greater in size, else s_y;
    s_c = √(s_x² + s_yC²). With F of `polach_2005` at s_c, its slope
    G ab √((C11 s_x)² + (C22 s_y)²)/s and μ at the slip speed s v,

        F_x = F s_x/s_c,  F_y = F s_y/s_c + F_yS,
        F_yS = (9/16) a μQ K H φ/s_c,  K = 1 + 6.3 (1 − e^(−a/b)),
        H = (1/3) (1 − δ²)^(3/2) − ε_S (δ³/3 − δ²/2 + 1/6),  δ = (ε_S² − 1)/(ε_S² + 1),
        ε_S = (8/3) G C23 b √(ab) |s_yC|/(K μQ).

    F_yS is quoted from memory; the paper was not at hand. Checked of it: for small pure spin it is
    exactly G (ab)^(3/2) C23 φ, whatever K; for large ε_S it vanishes, as it must; in between, pure
    spin on the base case stays within 8 % of μQ of `fastsim_1982` up to a `spin_share` of 2.5,
    and spin combined with creepages within 15 %.
    Even where all is small, longitudinal creepage weakens the force by spin, by |s_yC|/s_c: a
    property of the formula. k_A and k_S do not reduce F_yS; where, for that reason, lateral
    creepage against spin would give a resultant above μQ, it is cut to μQ.
    Known wrong beyond: F_yS dies out too soon, at 5 it is 0.12 μQ and FASTSIM's 0.35 μQ. And in
    the work done: without a spin moment, creepage against a large spin may give power.

    References
    ----------
    .. [1] O. Polach, A fast wheel–rail forces calculation computer code, Vehicle System Dynamics 33
       (1999) Suppl. 728–739, doi:10.1080/00423114.1999.12063125.
    .. [2] O. Polach, Wear 258 (2005) 992–1000, doi:10.1016/j.wear.2004.03.046.

    Checked by tests/reference/polach_base_case, 1e-5, and tests/laws/test_rolling_laws.py.

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> force = polach_rolling(base, DRY_POLACH_2005, 20.0, Creepage(0.01, 0.0, 0.0))
    >>> round(force.longitudinal, 2), force.lateral
    (35940.38, 0.0)
    """
    slip_speed = slip_speed_of(speed, creepage)
    limit = contact.load * falling_friction(rail, slip_speed)
    with_spin = creepage.lateral + creepage.spin * contact.a
    across = max(abs(creepage.lateral), abs(with_spin))
    total = max(resultant(creepage.longitudinal, across), _LEAST_CREEPAGE)
    straight = max(resultant(creepage.longitudinal, creepage.lateral), _LEAST_CREEPAGE)
    pull = resultant(contact.c11 * creepage.longitudinal, contact.c22 * creepage.lateral)
    slope = contact.shear_modulus * contact.a * contact.b * pull / straight
    chord = polach_2005(rail, contact.load, slope, slip_speed, total) / total
    by_spin = limit * _spin_share(contact, limit, across) * contact.a * creepage.spin / total
    force_x = chord * creepage.longitudinal
    force_y = chord * creepage.lateral + by_spin
    share = min(1.0, limit / max(resultant(force_x, force_y), _LEAST_FORCE))
    return CreepForce(share * force_x, share * force_y, 0.0)


def _spin_share(contact: RollingContact, limit: float, across: float) -> float:
    """(9/16) K H: the spin's share of the friction force."""
    width = 1.0 + 6.3 * (1.0 - exp_decay(contact.a / contact.b))
    root = math.sqrt(contact.a * contact.b)
    stress = 8.0 / 3.0 * contact.shear_modulus * contact.c23 * contact.b * root * across
    stress = stress / (width * max(limit, _LEAST_FORCE))
    square = stress * stress
    delta = (square - 1.0) / (square + 1.0)
    rest = 4.0 * square / ((square + 1.0) * (square + 1.0))
    ring = rest * math.sqrt(rest) / 3.0
    cap = delta * delta * (delta / 3.0 - 0.5) + 1.0 / 6.0
    return 0.5625 * width * (ring - stress * cap)
