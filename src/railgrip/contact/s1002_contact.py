"""A new S1002 wheel on a round rail head: radii, ellipse and contact at a lateral position."""

import math
from typing import NamedTuple

from railgrip.contact.input_checks import refuse_not_positive
from railgrip.contact.rolling_contact import RollingContact, rolling_contact
from railgrip.contact.s1002 import s1002
from railgrip.core.errors import Problem, RailgripError


class WheelRadii(NamedTuple):
    """Principal radii of a wheel where it touches the rail, as `hertz_1882` takes them.

    Parameters
    ----------
    along : float
        In the plane of rolling, > 0 [m].
    across : float
        Of the profile [m]; negative where it is concave, `inf` where it is straight.
    """

    along: float
    across: float


def s1002_radii(wheel_radius: float, position: float) -> WheelRadii:
    """Principal radii of an S1002 wheel at a lateral position.

    Parameters
    ----------
    wheel_radius : float
        Radius at the running circle, > 0 [m].
    position : float
        y from the running circle, positive towards the field side [m].

    Returns
    -------
    WheelRadii
        Radii along and across.

    Raises
    ------
    RailgripError
        From `s1002`; "the wheel radius must be positive and finite".

    Notes
    -----
    r1x = (r + z) √(1 + z'²) (Meusnier: the normal leans by γ, so a circle of radius r + z bends the
    surface by cos γ/(r + z)); on the tread the root is 1 within 0.3 %.

    Checked by tests/unit/contact/test_s1002_contact.py.

    Examples
    --------
    >>> radii = s1002_radii(0.46, 0.003)
    >>> round(radii.along, 5), round(radii.across, 4)
    (0.46006, -0.3816)
    """
    refuse_not_positive((("wheel radius", wheel_radius, "m"),))
    point = s1002(position)
    along = (wheel_radius + point.height) * math.hypot(1.0, point.slope)
    return WheelRadii(along, point.transverse_radius)


def s1002_contact(
    load: float,
    wheel_radius: float,
    position: float,
    rail_transverse_radius: float,
    young: float,
    poisson: float,
) -> RollingContact:
    """Rolling contact of an S1002 wheel that touches the rail at a lateral position.

    Choose it where the place of contact is known; it does not look for it.

    Parameters
    ----------
    load : float
        Normal force Q, > 0 [N]; on the tread the wheel load within 0.3 %.
    wheel_radius : float
        Radius at the running circle, > 0 [m].
    position : float
        y from the running circle, positive towards the field side [m].
    rail_transverse_radius : float
        Radius of the rail where it is touched [m].
    young, poisson : float
        Young's modulus [Pa] and Poisson's ratio [-] of both bodies.

    Returns
    -------
    RollingContact
        As `rolling_contact` makes it.

    Raises
    ------
    RailgripError
        "S1002 at y = -8 mm is concave with 214.2 mm, Hertz has no solution on a rail of 300 mm".

    Notes
    -----
    A rail head of 0.3 m has a solution from y = −1.23 mm towards the field side only; towards the
    flange the hollow of the tread is rounder than the head, down to the flange itself.
    Known wrong where the radii change within the ellipse, so in most of zones B and C: from 0 to
    8 mm, about the width of an ellipse, the radius doubles.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       section on the profile UIC-ORE.

    Checked by tests/unit/contact/test_s1002_contact.py.

    Examples
    --------
    >>> contact = s1002_contact(100e3, 0.46, 0.003, 0.3, 210e9, 0.28)
    >>> round(contact.a * 1e3, 3), round(contact.b * 1e3, 3)
    (5.495, 11.512)
    """
    radii = s1002_radii(wheel_radius, position)
    refuse_hollow_contact(position, radii.across, rail_transverse_radius)
    return rolling_contact(load, radii.along, radii.across, rail_transverse_radius, young, poisson)


def refuse_hollow_contact(position: float, wheel: float, rail: float) -> None:
    """Refuse a place where the tread's hollow is as round as the rail head, or rounder.

    Parameters
    ----------
    position : float
        y from the running circle [m].
    wheel, rail : float
        Transverse radii there [m].

    Raises
    ------
    RailgripError
        As in `s1002_contact`.

    Examples
    --------
    >>> refuse_hollow_contact(0.008, -0.6015, 0.3)
    """
    if rail == 0.0 or math.isnan(rail) or 1.0 / wheel + 1.0 / rail > 0.0:
        return  # the other cases are refused by hertz_1882
    word = "concave" if wheel < 0.0 else "convex"
    shape = "straight" if math.isinf(wheel) else f"{word} with {1e3 * abs(wheel):.1f} mm"
    allowed = (
        f"a rail head of radius 0 … {-1e3 * wheel:.1f} mm" if wheel < 0.0 else "a convex rail head"
    )
    raise RailgripError(
        Problem(
            "",
            f"S1002 at y = {1e3 * position:g} mm is {shape}, Hertz has no solution on a rail",
            got=f"rail head of radius {1e3 * rail:g} mm",
            allowed=allowed,
            cure="a place further towards the field side, where the tread is flatter, "
            "or a rounder rail head",
        )
    )
