"""Hertz in the form of railway handbooks: the angle ϑ and the factors ξ and η (Čáp 2000)."""

import math
from typing import NamedTuple

from railgrip.contact.input_checks import refuse_not_positive
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.patch import hertz_1882


class HertzFactors(NamedTuple):
    """Shape of a contact ellipse, whatever its load.

    Parameters
    ----------
    angle : float
        Auxiliary angle ϑ, 0 < ϑ ≤ π/2 [rad]; π/2 is a circle.
    long : float
        Factor ξ ≥ 1 of the longer semi-axis [-].
    short : float
        Factor η ≤ 1 of the shorter semi-axis [-].
    is_long_along : bool
        Whether the longer semi-axis lies along the track.
    """

    angle: float
    long: float
    short: float
    is_long_along: bool


def mean_young(first: float, second: float) -> float:
    """Young's modulus E' that stands for two bodies, 1/E' = (1/E1 + 1/E2)/2.

    Pass it as `young` wherever one modulus is asked for; exact where both have the same Poisson's
    ratio.

    Parameters
    ----------
    first, second : float
        Young's moduli of wheel and rail, > 0 [Pa].

    Returns
    -------
    float
        Mean modulus E' [Pa].

    Raises
    ------
    RailgripError
        "the Young's modulus must be positive and finite".

    Examples
    --------
    >>> round(mean_young(200e9, 220e9) / 1e9, 3)
    209.524
    """
    refuse_not_positive((("Young's modulus", first, "Pa"), ("Young's modulus", second, "Pa")))
    return 2.0 * first * second / (first + second)


def hertz_factors(curvature_along: float, curvature_across: float) -> HertzFactors:
    """Factors ξ, η and angle ϑ for the summed curvatures along and across the track.

    Choose it to compare with handbooks and graphs; `hertz_1882` gives the ellipse itself.

    Parameters
    ----------
    curvature_along : float
        K_x = 1/r1x + 1/r2x, > 0 [1/m].
    curvature_across : float
        K_y = 1/r1y + 1/r2y, > 0 [1/m]; a concave tread enters with a negative r1y.

    Returns
    -------
    HertzFactors
        ϑ, ξ, η and which way the ellipse lies.

    Raises
    ------
    RailgripError
        "the summed curvatures must be positive, Hertz has no solution".

    Notes
    -----
    semi-axis = (ξ or η) · cbrt(3 Q (1 − ν²)/(E' (K_x + K_y))) (1.6),
    cos ϑ = |K_x − K_y|/(K_x + K_y).
    The longer semi-axis lies along the track where K_x < K_y. The paper reads ξ and η off a graph;
    here they come from the elliptic integrals. Its ϑ, the arccosine of the magnitude of
    (r1x − r2y)/(r1x + r2y) (1.7a), and its rule "along the track if r1x > r2y" hold for a cone on a
    straight rail only.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 1.6, 1.7, 1.7a.

    Checked by tests/reference/hertz_factors, the classic table of Hertz's factors, its last digit.

    Examples
    --------
    >>> factors = hertz_factors(1 / 0.5, 1 / 0.3)
    >>> round(math.degrees(factors.angle), 2), round(factors.long, 4), round(factors.short, 4)
    (75.52, 1.1939, 0.8497)
    """
    total = curvature_along + curvature_across
    if not (curvature_along > 0.0 and curvature_across > 0.0 and total < math.inf):
        raise RailgripError(
            Problem(
                "",
                "the summed curvatures must be positive, Hertz has no solution",
                got=f"{curvature_along:g} 1/m along, {curvature_across:g} 1/m across the track",
                cure="a rail head rounder than the hollow of the tread",
            )
        )
    # With this load and ν = 0 the cube root of (1.6) is one metre.
    patch = hertz_1882(total / 3.0, 1.0 / curvature_along, 1.0 / curvature_across, math.inf, 1.0, 0)
    return HertzFactors(
        math.acos(abs(curvature_along - curvature_across) / total),
        max(patch.a, patch.b),
        min(patch.a, patch.b),
        curvature_along < curvature_across,
    )
