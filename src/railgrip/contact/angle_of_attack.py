"""Creepages of a wheel that does not run where it points."""

import math
from typing import NamedTuple

from railgrip.contact.rolling_contact import Creepage


class WheelAttitude(NamedTuple):
    """How the wheel stands on the rail.

    Parameters
    ----------
    angle_of_attack : float
        Yaw of the wheelset against the track α, −π/2 … π/2 [rad].
    contact_angle : float
        Slope of the running surface where it touches, γ, 0 for a cylinder [rad]; its sign is that
        of the spin, so it differs between the two wheels of a wheelset.
    wheel_radius : float
        Rolling radius, > 0 [m]; `inf` leaves the spin out.
    """

    angle_of_attack: float
    contact_angle: float
    wheel_radius: float


STRAIGHT = WheelAttitude(0.0, 0.0, math.inf)
"""A cylindrical wheel that runs where it points."""


def attack_creepage(attitude: WheelAttitude, longitudinal: float) -> Creepage:
    """Creepages of a wheel under an angle of attack.

    Choose it to put a yawed wheel into a law of rolling contact. Angles of attack reach some
    milliradians on straight track and about 20 mrad in tight curves.

    Parameters
    ----------
    attitude : WheelAttitude
        Angle of attack, contact angle and radius.
    longitudinal : float
        Longitudinal creepage in the plane of the wheel, s_x = u/v − cos α [-].

    Returns
    -------
    Creepage
        s_x as given, s_y = sin α [-], spin [1/m].

    Notes
    -----
    w_x = u − v cos α, w_y = v sin α, s = w/v; spin ω_s/v = (u/v) sin γ/r with ω = u/r.
    u, v are the peripheral speed of the wheel and the speed of the train. The creepage of the plant
    (u − v)/v is s_x − (1 − cos α), lower by α²/2: 5·10⁻⁵ at 10 mrad.
    The turn of the ellipse under yaw is left out.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 1.3–1.5.

    Checked by tests/laws/test_deformed_curves.py.

    Examples
    --------
    >>> attack_creepage(WheelAttitude(0.005, 0.0, 0.46), 0.01)
    Creepage(longitudinal=0.01, lateral=0.004999979166692708, spin=0.0)
    """
    speed_ratio = longitudinal + math.cos(attitude.angle_of_attack)
    spin = speed_ratio * math.sin(attitude.contact_angle) / attitude.wheel_radius
    return Creepage(longitudinal, math.sin(attitude.angle_of_attack), spin)
