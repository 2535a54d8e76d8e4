"""The contact ellipse of wheel and rail, exactly, by elliptic integrals (Hertz 1882)."""

import math
from typing import NamedTuple

from railgrip.core.errors import Problem, RailgripError


class HertzPatch(NamedTuple):
    """The ellipse in which wheel and rail touch.

    Parameters
    ----------
    a : float
        Semi-axis along the track [m].
    b : float
        Semi-axis across the track [m].
    greatest_pressure : float
        Pressure at the centre, 3Q/(2πab) [Pa].
    approach : float
        How far the bodies move towards each other [m].
    """

    a: float
    b: float
    greatest_pressure: float
    approach: float


def hertz_1882(
    load: float,
    wheel_radius: float,
    wheel_transverse_radius: float,
    rail_transverse_radius: float,
    young: float,
    poisson: float,
) -> HertzPatch:
    """Contact ellipse of a wheel on a straight rail of the same material.

    Choose it to set up a calculation; it iterates and does not belong in an inner loop. In there
    use that a and b grow with load^(1/3) and their ratio stays.

    Parameters
    ----------
    load : float
        Vertical wheel load Q, > 0 [N].
    wheel_radius : float
        Rolling radius, > 0 [m].
    wheel_transverse_radius : float
        Radius of the wheel's profile [m]; `inf` for a cone, negative where the tread is concave.
    rail_transverse_radius : float
        Radius of the rail head [m]; `inf` for a flat head, negative for a concave one.
    young, poisson : float
        Young's modulus [Pa], > 0, and Poisson's ratio [-], −1 < ν ≤ ½, of both bodies.

    Returns
    -------
    HertzPatch
        Semi-axes along and across the track, greatest pressure, approach.

    Raises
    ------
    RailgripError
        "the profiles do not touch in one point, …" where 1/r_wheel + 1/r_rail across the track is
        not positive; and for a load, radius or material out of range.

    Notes
    -----
    A = 1/(2 r_wheel), B = (1/r_wheel,y + 1/r_rail,y)/2, E* = E/(2(1−ν²)); c ≥ d are the semi-axes,
    k' = d/c, e² = 1 − k'², K and E the complete elliptic integrals:

        min(A, B)/max(A, B) = k'² (K − E)/(E − k'² K)     determines k',
        c³ = 3 Q E/(2π E* (A + B) k'²),  d = k' c,  approach = 3 Q K/(2π c E*).

    The long axis lies along the direction of the smaller curvature. K and E come from the
    arithmetic-geometric mean, K − E and E − k'²K from its sum, so that a circle loses no digits.
    Known wrong when the radii change within the ellipse (worn or S1002 profiles near the flange).

    References
    ----------
    .. [1] H. Hertz, Über die Berührung fester elastischer Körper, J. reine angew. Math. 92 (1882)
       156–171.
    .. [2] K. L. Johnson, Contact Mechanics, Cambridge 1985, eqs 4.24–4.28.

    Checked by tests/reference/hertz_base_case, 1e-8.

    Examples
    --------
    >>> patch = hertz_1882(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> round(patch.a * 1e3, 6), round(patch.b * 1e3, 6)
    (7.191978, 5.409966)
    """
    _refuse_bad_input(load, wheel_radius, young, poisson)
    along = 0.5 / wheel_radius
    across = _curvature_across(wheel_transverse_radius, rail_transverse_radius)
    modulus = young / (2.0 * (1.0 - poisson * poisson))
    ratio = _axis_ratio(min(along, across) / max(along, across))
    first, second, _ = _elliptic_integrals(ratio)
    scale = 1.5 * load / (math.pi * modulus)
    long = math.cbrt(scale * second / ((along + across) * ratio * ratio))
    short = ratio * long
    a, b = (long, short) if along < across else (short, long)
    return HertzPatch(a, b, 1.5 * load / (math.pi * a * b), scale * first / long)


def _elliptic_integrals(ratio: float) -> tuple[float, float, float]:
    """K, E and σ = (K − E)/(K e²) for the complementary modulus `ratio` = √(1 − e²)."""
    square = (1.0 - ratio) * (1.0 + ratio)
    mean, geometric = 1.0, ratio
    total, weight, difference = 0.5, 0.5, square
    share = 1.0
    # Σ 2^(n−1) c_n², each term divided by e²; c_(n+1) = c_n²/(4 mean_(n+1)).
    while share > 1e-18:
        mean, geometric = 0.5 * (mean + geometric), math.sqrt(mean * geometric)
        weight *= 2.0
        share_of_next = difference / (16.0 * mean * mean)
        share *= share_of_next
        difference *= share_of_next
        total += weight * share
    first = 0.5 * math.pi / mean
    return first, first * (1.0 - square * total), total


def _axis_ratio(curvature_ratio: float) -> float:
    """Short over long semi-axis for the ratio (≤ 1) of the smaller to the larger curvature."""
    low, high = 1e-9, 1.0
    if curvature_ratio >= 1.0:
        return 1.0
    while True:
        middle = math.sqrt(low * high)
        if not low < middle < high:
            return middle
        _, _, sigma = _elliptic_integrals(middle)
        if middle * middle * sigma / (1.0 - sigma) < curvature_ratio:
            low = middle
        else:
            high = middle


def _curvature_across(wheel_transverse_radius: float, rail_transverse_radius: float) -> float:
    for name, radius in (("wheel", wheel_transverse_radius), ("rail", rail_transverse_radius)):
        if math.isnan(radius) or radius == 0.0:
            raise RailgripError(
                Problem(
                    "",
                    f"the transverse radius of the {name} must not be zero or NaN",
                    got=f"{radius} m",
                    cure="give a radius, inf for a straight profile, negative for a concave one",
                )
            )
    across = 0.5 / wheel_transverse_radius + 0.5 / rail_transverse_radius
    if across <= 0.0:
        raise RailgripError(
            Problem(
                "",
                "the profiles do not touch in one point, Hertz has no solution",
                got=f"wheel {wheel_transverse_radius} m, rail {rail_transverse_radius} m",
                allowed="1/wheel + 1/rail > 0",
                cure="a rail head rounder than the hollow of the tread",
            )
        )
    return across


def _refuse_bad_input(load: float, wheel_radius: float, young: float, poisson: float) -> None:
    for name, value, unit in (
        ("load", load, "N"),
        ("wheel radius", wheel_radius, "m"),
        ("Young's modulus", young, "Pa"),
    ):
        if not 0.0 < value < math.inf:
            raise RailgripError(
                Problem("", f"the {name} must be positive and finite", got=f"{value} {unit}")
            )
    if not -1.0 < poisson <= 0.5:
        raise RailgripError(
            Problem(
                "", "Poisson's ratio out of range", got=f"{poisson}", allowed="-1 < ratio <= 0.5"
            )
        )
