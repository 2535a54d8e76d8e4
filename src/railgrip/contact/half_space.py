"""How the surface of an elastic half-space moves under a loaded rectangle (Boussinesq, Cerruti)."""

import math
from typing import NamedTuple


class Influence(NamedTuple):
    """Displacement difference of two equal half-spaces under a unit load on one rectangle.

    All are for a shear modulus of 1/π: divide by π G.

    Parameters
    ----------
    xx, yy : float
        Displacement along x (y) by a unit tangential traction along x (y) [m].
    xy : float
        Displacement along y by a unit traction along x, and the other way round [m].
    zz : float
        Approach of the surfaces by a unit pressure [m].
    """

    xx: float
    xy: float
    yy: float
    zz: float


def rectangle_influence(x: float, y: float, dx: float, dy: float, poisson: float) -> Influence:
    """Displacement difference at (x, y) by unit loads on the rectangle dx × dy around the origin.

    Choose it to build the influence matrix of a grid. Both bodies are of the same material, so
    that pressure moves nothing along the surface and traction nothing across it.

    Parameters
    ----------
    x, y : float
        Where the displacement is asked [m].
    dx, dy : float
        Sides of the loaded rectangle, > 0 [m].
    poisson : float
        Poisson's ratio of both bodies, 0 … ½ [-].

    Returns
    -------
    Influence
        Displacements for a shear modulus of 1/π, each > 0 but xy [m].

    Notes
    -----
    Under a point load on both bodies in opposite directions, at the distance r = √(x² + y²),

        π G u_xx = (1 − ν)/r + ν x²/r³,  π G u_xy = ν x y/r³,  π G u_zz = (1 − ν)/r,

    twice what one half-space gives. Over the rectangle, with L = Σ ± Y asinh(X/|Y|) and
    M = Σ ± X asinh(Y/|X|) over its corners (X, Y) as seen from (x, y), these integrate to

        xx = L + (1 − ν) M,  yy = M + (1 − ν) L,  xy = −ν Σ ± √(X² + Y²),  zz = (1 − ν)(L + M).

    Known wrong when the patch is no longer small against the radii of the bodies (conformal
    contact), or the two materials differ.

    References
    ----------
    .. [1] K. L. Johnson, Contact Mechanics, Cambridge 1985, eqs 3.19 and 3.75.
    .. [2] J. J. Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, Kluwer 1990, ch. 4.

    Checked by tests/unit/contact/test_half_space.py: integration of the point load, 1e-6.

    Examples
    --------
    >>> round(rectangle_influence(0.0, 0.0, 1e-3, 1e-3, 0.25).xx * 1e3, 6)
    3.084808
    """
    left, right = x - 0.5 * dx, x + 0.5 * dx
    low, high = y - 0.5 * dy, y + 0.5 * dy
    along = (_leg(high, right) - _leg(high, left)) - (_leg(low, right) - _leg(low, left))
    across = (_leg(right, high) - _leg(right, low)) - (_leg(left, high) - _leg(left, low))
    radii = (math.sqrt(right * right + high * high) - math.sqrt(left * left + high * high)) - (
        math.sqrt(right * right + low * low) - math.sqrt(left * left + low * low)
    )
    stiff = 1.0 - poisson
    return Influence(
        along + stiff * across,
        -poisson * radii,
        across + stiff * along,
        stiff * (along + across),
    )


def _leg(y: float, x: float) -> float:
    """Return y asinh(x/|y|), and its limit 0 at y = 0."""
    return y * math.asinh(x / abs(y)) if y != 0.0 else 0.0
