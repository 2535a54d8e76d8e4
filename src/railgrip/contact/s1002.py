"""The wheel profile S1002 (UIC-ORE) in all its eight zones: height, slope, radius, conicity."""

import csv
import math
from functools import cache
from importlib.resources import files
from typing import NamedTuple

from railgrip.core.errors import Problem, RailgripError

FLANGE_BACK, FIELD_SIDE = -0.070, 0.060
"""Ends of the profile [m]."""


class ProfilePoint(NamedTuple):
    """The profile at one lateral position.

    Parameters
    ----------
    zone : str
        A … H, from the field side to the back of the flange.
    height : float
        z, positive away from the axle: how much the local radius exceeds the rolling radius [m].
    slope : float
        z' = dz/dy [-]; infinite at the back of the flange.
    second_derivative : float
        z'' [1/m]; positive where the tread is concave.
    transverse_radius : float
        r1y as `hertz_1882` takes it [m]: negative where the profile is concave, `inf` where it is
        straight.
    conicity : float
        −z', by which the local radius falls towards the field side [-]; its arctangent is the
        contact angle γ of the spin ω sin γ.
    """

    zone: str
    height: float
    slope: float
    second_derivative: float
    transverse_radius: float
    conicity: float


class _Zone(NamedTuple):
    """One piece of the profile; lengths in mm, as in its table."""

    name: str
    outer: float
    inner: float
    is_arc: bool
    coefficients: tuple[float, ...]


def s1002(position: float) -> ProfilePoint:
    """Profile S1002 at a lateral position.

    Choose it for new wheels; a worn tread is another profile.

    Parameters
    ----------
    position : float
        y from the running circle, −0.070 … 0.060 [m]: positive towards the field side, negative
        towards the flange, on either wheel.

    Returns
    -------
    ProfilePoint
        Height, slope, second derivative, transverse radius, conicity.

    Raises
    ------
    RailgripError
        "the position is off the profile S1002; got y = 61 mm; allowed: -70 … 60 mm".

    Notes
    -----
    r1y = −(1 + z'²)^(3/2)/z''. About the running circle the tread is concave, from y = 14.1 mm
    (zone B) convex, in zone A straight. The conicity is the local slope; the equivalent conicity of
    a wheelset needs the rail too.

    Where zones meet, the published pieces do so within 1.2e-4 mm in height (C and D; B and C
    3.7e-5, all others 7e-8 mm) and 8e-6 in slope (C and D; B and C 3.3e-6, all others 6e-9). z''
    jumps by 0.0042 1/mm between A and B and at each end of an arc but D's at C. At a limit the
    zone nearer to the running circle is taken, so B at −26 mm.

    The paper prints z with two wrong coefficients, 1.565e-2 y² and 2.646e-3 y⁸ in place of
    1.5657e-3 and 2.6467e-13; for r1y at −8, 0 and +8 mm it prints 192.6, 303.4 and 588.6 mm in
    place of 214.2, 319.9 and 601.5 mm, for it took (1 + z')^(3/2); and at +8 mm z = 0.183 and
    z' = −1.141e-2 in place of −0.183 and −1.414e-2.

    References
    ----------
    .. [1] UIC 510-2 and EN 13715, profile S1002; the coefficients as published with them.
    .. [2] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       the polynomial that it numbers 1.12 for a second time.

    Checked by tests/reference/s1002_radii, 1e-6.

    Examples
    --------
    >>> [round(1e3 * s1002(1e-3 * y).transverse_radius, 3) for y in (-8, 0, 8)]
    [-214.216, -319.89, -601.525]
    >>> round(s1002(0.0).conicity, 4)
    0.0336
    """
    if not FLANGE_BACK <= position <= FIELD_SIDE:
        raise RailgripError(
            Problem(
                "",
                "the position is off the profile S1002",
                got=f"y = {1e3 * position:g} mm",
                allowed=f"{1e3 * FLANGE_BACK:g} … {1e3 * FIELD_SIDE:g} mm",
                cure="count y from the running circle, positive towards the field side",
            )
        )
    y = 1e3 * position
    zone = _zone_of(y)
    height, slope, second = (_arc if zone.is_arc else _polynomial)(zone.coefficients, y)
    if zone.is_arc:
        _, side, arc_radius, _ = zone.coefficients
        radius = side * arc_radius
    else:
        radius = -((1.0 + slope * slope) ** 1.5) / second if second else math.inf
    return ProfilePoint(zone.name, 1e-3 * height, slope, 1e3 * second, 1e-3 * radius, -slope)


def zone_limits() -> tuple[tuple[str, float, float], ...]:
    """Zones of the profile, from the field side to the back of the flange.

    Returns
    -------
    tuple of (name, outer limit, inner limit)
        Limits as lateral positions [m].

    Examples
    --------
    >>> zone_limits()[2]
    ('C', -0.026, -0.035)
    """
    return tuple((zone.name, zone.outer / 1e3, zone.inner / 1e3) for zone in _zones())


def _zone_of(y: float) -> _Zone:
    zones = _zones()
    if y > zones[0].inner:
        return zones[0]
    for zone in zones[1:]:
        if y >= zone.inner:
            return zone
    return zones[-1]  # the last digit of -0.070 m in mm


def _polynomial(coefficients: tuple[float, ...], y: float) -> tuple[float, float, float]:
    """Height, slope and second derivative by Horner's scheme."""
    height = slope = half_second = 0.0
    for coefficient in reversed(coefficients):
        half_second = half_second * y + slope
        slope = slope * y + height
        height = height * y + coefficient
    return height, slope, 2.0 * half_second


def _arc(coefficients: tuple[float, ...], y: float) -> tuple[float, float, float]:
    """Height, slope and second derivative of a circle; vertical where it ends."""
    middle, side, radius, centre = coefficients
    offset = y - centre
    square = (radius - offset) * (radius + offset)
    if square <= 0.0:
        return middle, -math.copysign(math.inf, side * offset), -side * math.inf
    rise = math.sqrt(square)
    return middle + side * rise, -side * offset / rise, -side * radius * radius / rise**3


@cache
def _zones() -> tuple[_Zone, ...]:
    """The table of the zones, from the field side to the back of the flange."""
    source = files("railgrip") / "data" / "contact" / "s1002_zones.csv"
    lines = [line for line in source.read_text("utf-8").splitlines() if line[:1] != "#"]
    return tuple(
        _Zone(
            row["zone"],
            float(row["from_mm"]),
            float(row["to_mm"]),
            row["form"] == "arc",
            tuple(float(number) for number in row["coefficients"].split(";")),
        )
        for row in csv.DictReader(lines)
    )
