"""The contact ellipse under a yawed wheel: turned, and changed in shape."""

import math
from typing import NamedTuple

from railgrip.contact.input_checks import refuse_not_positive
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.patch import hertz_1882


class YawedPatch(NamedTuple):
    """The ellipse under a wheel with an angle of attack.

    Parameters
    ----------
    a, b : float
        Semi-axes [m]: a is the one that lies along the track without yaw, b the other.
    turn_from_rail : float
        Angle of the axis a from the direction of the track [rad], in the sense in which yaw counts.
    turn_from_wheel : float
        Angle of the axis a from the plane of the wheel [rad], in the same sense.
    greatest_pressure : float
        Pressure at the centre [Pa].
    """

    a: float
    b: float
    turn_from_rail: float
    turn_from_wheel: float
    greatest_pressure: float


def yawed_patch(
    load: float,
    wheel_radius: float,
    wheel_transverse_radius: float,
    rail_transverse_radius: float,
    young: float,
    poisson: float,
    yaw: float,
) -> YawedPatch:
    """Contact ellipse of a wheel whose plane stands at an angle to the rail.

    Choose it to see whether yaw matters for the patch: at the angles of a curve (some mrad) the
    semi-axes hardly change, and the ellipse turns by a small multiple of the yaw.

    Parameters
    ----------
    load, wheel_radius, wheel_transverse_radius, rail_transverse_radius, young, poisson : float
        As in `railgrip.core.formulas.patch.hertz_1882`.
    yaw : float
        Angle of attack α, from the track to the plane of the wheel, |α| ≤ π/2 [rad].

    Returns
    -------
    YawedPatch
        Semi-axes, the two angles, greatest pressure.

    Raises
    ------
    RailgripError
        "the bodies do not touch in one point at this yaw, Hertz has no solution"; "the yaw is out
        of range"; and for load, radii and material out of range.

    Notes
    -----
    With D1 = 1/r1x − 1/r1y of the wheel and D2 = 1/r2x − 1/r2y of the rail (r2x = ∞), the curvature
    of the gap in a direction θ from the track is

        (Σ + D2 cos 2θ + D1 cos 2(θ − α))/2,

    whose stationary directions obey tan 2θ = D1 sin 2α/(D2 + D1 cos 2α); the principal curvatures
    are (Σ ± √(D1² + D2² + 2 D1 D2 cos 2α))/2. For small α: θ = α D1/(D1 + D2), that is −1.5 α from
    the rail and −2.5 α from the wheel for a cone of 0.5 m on a head of 0.3 m: the ellipse turns
    against the yaw. The paper's (1.15), `printed_turn`, gives 0.375 α for the same case.
    Near a circle the turn is large for the smallest yaw and means nothing.

    References
    ----------
    .. [1] K. L. Johnson, Contact Mechanics, Cambridge 1985, eqs 4.4–4.5.
    .. [2] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 1.15.

    Checked by tests/unit/contact/test_yawed_patch.py: eigenvectors of the summed curvature tensor.

    Examples
    --------
    >>> patch = yawed_patch(100e3, 0.5, math.inf, 0.3, 210e9, 0.3, 1e-3)
    >>> round(patch.turn_from_rail * 1e3, 4), round(patch.turn_from_wheel * 1e3, 4)
    (-1.5, -2.5)
    """
    refuse_not_positive((("wheel radius", wheel_radius, "m"),))
    _refuse_zero_radius(wheel_transverse_radius, rail_transverse_radius)
    if not abs(yaw) <= 0.5 * math.pi:
        raise RailgripError(
            Problem("", "the yaw is out of range", got=f"{yaw:g} rad", allowed="-pi/2 … pi/2")
        )
    total = 1.0 / wheel_radius + 1.0 / wheel_transverse_radius + 1.0 / rail_transverse_radius
    wheel = 1.0 / wheel_radius - 1.0 / wheel_transverse_radius
    rail = -1.0 / rail_transverse_radius
    # The axis a keeps its side: the curvature along it is the greater one if it is so without yaw.
    side = math.copysign(1.0, wheel + rail)
    along = side * (rail + wheel * math.cos(2.0 * yaw))
    across = side * wheel * math.sin(2.0 * yaw)
    difference = math.hypot(along, across)
    if not total > difference:
        raise RailgripError(
            Problem(
                "",
                "the bodies do not touch in one point at this yaw, Hertz has no solution",
                got=f"yaw {yaw:g} rad, wheel {wheel_transverse_radius:g} m, "
                f"rail {rail_transverse_radius:g} m across",
                cure="less yaw, or a rail head rounder than the hollow of the tread",
            )
        )
    curvature_a = 0.5 * (total + side * difference)
    curvature_b = 0.5 * (total - side * difference)
    patch = hertz_1882(load, 1.0 / curvature_a, 1.0 / curvature_b, math.inf, young, poisson)
    turn = 0.5 * math.atan2(across, along)
    return YawedPatch(patch.a, patch.b, turn, turn - yaw, patch.greatest_pressure)


def printed_turn(
    wheel_radius: float, wheel_transverse_radius: float, rail_transverse_radius: float, yaw: float
) -> float:
    """Turn of the ellipse as the paper prints it (1.15), to be compared with `yawed_patch`.

    Do not choose it for a calculation: it lacks the factor 1/cos ϑ and gives no sense of the turn.

    Parameters
    ----------
    wheel_radius, wheel_transverse_radius, rail_transverse_radius : float
        As in `yawed_patch`.
    yaw : float
        Angle of attack α [rad].

    Returns
    -------
    float
        The angle that the paper calls ξ1 [rad].

    Raises
    ------
    RailgripError
        "the wheel radius must be positive and finite" and for a transverse radius of zero.

    Notes
    -----
    sin 2ξ1 = (1/r1x − 1/r1y)/(Σ 1/r) · sin 2α. For a cone of 0.5 m on a head of 0.3 m that is
    0.375 α; the text of the paper calls it α/2. Divided by cos ϑ = 0.25 it is the true 1.5 α from
    the rail. The text means the angle from the planes of the wheel, which is 2.5 α.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 1.15.

    Checked by tests/unit/contact/test_yawed_patch.py.

    Examples
    --------
    >>> round(printed_turn(0.5, math.inf, 0.3, 1e-3) * 1e3, 4)
    0.375
    """
    refuse_not_positive((("wheel radius", wheel_radius, "m"),))
    _refuse_zero_radius(wheel_transverse_radius, rail_transverse_radius)
    total = 1.0 / wheel_radius + 1.0 / wheel_transverse_radius + 1.0 / rail_transverse_radius
    wheel = 1.0 / wheel_radius - 1.0 / wheel_transverse_radius
    sine = wheel / total * math.sin(2.0 * yaw) if total > 0.0 else math.inf
    if not abs(sine) <= 1.0:
        raise RailgripError(
            Problem("", "the printed formula (1.15) has no angle for these radii", got=f"{sine:g}")
        )
    return 0.5 * math.asin(sine)


def _refuse_zero_radius(wheel: float, rail: float) -> None:
    for name, radius in (("wheel", wheel), ("rail", rail)):
        if math.isnan(radius) or radius == 0.0:
            raise RailgripError(
                Problem(
                    "",
                    f"the transverse radius of the {name} must not be zero or NaN",
                    got=f"{radius} m",
                    cure="give a radius, inf for a straight profile, negative for a concave one",
                )
            )
