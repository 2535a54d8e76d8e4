"""Creep force of one wheel (Carter 1926), exact in two dimensions."""

import math

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import slip_speed_of
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.contact.validity import valid_within

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


@valid_within(lateral_share=0.0, spin_share=0.0)
def carter_rolling(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Longitudinal creep force alone, by Carter's curve with Kalker's slope.

    Choose it as `carter_1926`. The theory is plane: lateral creepage and spin are left out, give no
    force, and are flagged where the law is taken over arrays.

    Parameters
    ----------
    contact : RollingContact
        The contact.
    rail : RailFriction
        State of the rail; k_A and k_S are not used.
    speed : float
        Speed of the train, > 0 [m/s].
    creepage : Creepage
        Of it only the longitudinal one gives a force; the friction falls with both.

    Returns
    -------
    CreepForce
        Longitudinal force [N] with the sign of the creepage; the others are zero.

    Notes
    -----
    Carter's own slope 2 Q R/a needs a cylinder's radius; on the ellipse the slope is Kalker's,
    G a b C11, so that the law has the right tangent. For Carter's own take `carter_1926`.
    Known wrong when the patch is not much wider than long, or creeps sideways.

    References
    ----------
    .. [1] F. W. Carter, On the action of a locomotive driving wheel, Proc. R. Soc. A 112 (1926)
       151–157, doi:10.1098/rspa.1926.0100.

    Checked by tests/laws/test_rolling_laws.py.

    Examples
    --------
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> round(carter_rolling(base, rail, 20.0, Creepage(-0.001, 0.0, 0.0)).longitudinal, 1)
    -12765.9
    """
    slope = contact.shear_modulus * contact.a * contact.b * contact.c11
    along = abs(creepage.longitudinal)
    force = carter_1926(rail, contact.load, slope, slip_speed_of(speed, creepage), along)
    return CreepForce(math.copysign(force, creepage.longitudinal), 0.0, 0.0)
