"""What every law of rolling contact reads and returns: the contact, the creepages, the forces."""

from collections.abc import Callable
from typing import NamedTuple

from railgrip.contact.kalker_1990 import kalker_coefficients
from railgrip.contact.rail_friction import RailFriction
from railgrip.core.formulas.patch import hertz_1882


class RollingContact(NamedTuple):
    """One elliptic contact of wheel and rail, ready for a creep law.

    Parameters
    ----------
    load : float
        Normal force Q, > 0 [N].
    a, b : float
        Semi-axes along and across the track, > 0 [m].
    shear_modulus : float
        G of both bodies, > 0 [Pa].
    poisson : float
        Poisson's ratio of both bodies, 0 … ½ [-].
    c11, c22, c23, c33 : float
        Kalker's creepage coefficients of this ellipse [-].
    """

    load: float
    a: float
    b: float
    shear_modulus: float
    poisson: float
    c11: float
    c22: float
    c23: float
    c33: float


class Creepage(NamedTuple):
    """How the wheel slips on the rail, as a rigid body, over the speed of the train.

    Signs are the house's: a driven wheel has positive longitudinal creepage. Kalker's own
    creepages are the negatives of these three.

    Parameters
    ----------
    longitudinal : float
        (wheel speed − train speed)/train speed, s_x [-].
    lateral : float
        The same across the track, s_y [-].
    spin : float
        Rotation about the normal over the train speed, ω_s/v [1/m]: a point (x, y) of the patch
        gains the slips −spin·y along and +spin·x across the track. x points in the direction of
        rolling, y to its left, from the centre of the ellipse.
    """

    longitudinal: float
    lateral: float
    spin: float


class CreepForce(NamedTuple):
    """What the rail does to the wheel; a driven wheel's longitudinal force is positive.

    For small creepage F_x = G a b C11 s_x, F_y = G a b C22 s_y + G (ab)^(3/2) C23 φ and
    M = −G (ab)^(3/2) C23 s_y + G (ab)² C33 φ: Kalker's forces for the negative creepages.

    Parameters
    ----------
    longitudinal, lateral : float
        Forces along and across the track [N].
    spin_moment : float
        Moment about the normal [N m].
    """

    longitudinal: float
    lateral: float
    spin_moment: float


RollingLaw = Callable[[RollingContact, RailFriction, float, Creepage], CreepForce]
"""``law(contact, rail, speed, creepage)``, registered under ``railgrip.rolling_laws``."""


def rolling_contact(
    load: float,
    wheel_radius: float,
    wheel_transverse_radius: float,
    rail_transverse_radius: float,
    young: float,
    poisson: float,
) -> RollingContact:
    """Contact of one wheel on a straight rail, by Hertz's ellipse and Kalker's table.

    Parameters
    ----------
    load, wheel_radius, wheel_transverse_radius, rail_transverse_radius, young, poisson : float
        As in `railgrip.core.formulas.patch.hertz_1882`.

    Returns
    -------
    RollingContact
        Semi-axes, elastic constants and coefficients.

    Raises
    ------
    RailgripError
        From `hertz_1882` and `kalker_coefficients`.

    Examples
    --------
    >>> import math
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> round(base.a * 1e3, 6), round(base.c11, 6)
    (7.191978, 4.550468)
    """
    patch = hertz_1882(
        load, wheel_radius, wheel_transverse_radius, rail_transverse_radius, young, poisson
    )
    shear_modulus = young / (2.0 * (1.0 + poisson))
    coefficients = kalker_coefficients(patch.a, patch.b, poisson)
    return RollingContact(load, patch.a, patch.b, shear_modulus, poisson, *coefficients)
