"""A straight-line curve through up to four points, without a branch.

A hinge is max(0, x − x_i): zero before x_i, rising after it. A sum of hinges bends at each x_i.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from railgrip.core.errors import Problem, RailgripError

_GREATEST_NUMBER_OF_POINTS = 4


class Hinges(NamedTuple):
    """A curve of straight lines: `value0` on the left, bending by `s_i` at `x_i`.

    Parameters
    ----------
    value0 : float
        Value left of the first hinge, in the unit of the curve.
    x1, x2, x3, x4 : float
        Where it bends, in the unit of the argument.
    s1, s2, s3, s4 : float
        Change of slope at each bend; 0 for a hinge that is not used.
    """

    value0: float
    x1: float = 0.0
    x2: float = 0.0
    x3: float = 0.0
    x4: float = 0.0
    s1: float = 0.0
    s2: float = 0.0
    s3: float = 0.0
    s4: float = 0.0


def piecewise_linear(hinges: Hinges, x: float) -> float:
    """Value of a curve of straight lines.

    Parameters
    ----------
    hinges : Hinges
        The curve, usually from `hinges_from_points`.
    x : float
        Argument, any value.

    Returns
    -------
    float
        value0 + Σ s_i max(0, x − x_i).

    Notes
    -----
    Known wrong when x is many times larger than the last point: the slopes cancel there, and the
    rounding of their sum grows with x (1e-16 of slope · x).

    Examples
    --------
    >>> fade = hinges_from_points([(150.0, 1.0), (350.0, 0.8)])
    >>> round(piecewise_linear(fade, 250.0), 12)
    0.9
    """
    first = hinges.s1 * max(0.0, x - hinges.x1) + hinges.s2 * max(0.0, x - hinges.x2)
    second = hinges.s3 * max(0.0, x - hinges.x3) + hinges.s4 * max(0.0, x - hinges.x4)
    return hinges.value0 + first + second


def hinges_from_points(points: Sequence[tuple[float, float]]) -> Hinges:
    """Curve of straight lines through points, constant before the first and after the last.

    Parameters
    ----------
    points : sequence of (x, value)
        One to four points with rising x.

    Returns
    -------
    Hinges
        The curve.

    Raises
    ------
    RailgripError
        "a curve needs one to four points", "x must rise from point to point" or
        "points must be finite numbers".

    Examples
    --------
    >>> hinges_from_points([(0.0, 1.0), (10.0, 3.0)])[:4]
    (1.0, 0.0, 10.0, 10.0)
    """
    _refuse_bad_points(points)
    xs = [float(x) for x, _ in points]
    slopes = [(right[1] - left[1]) / (right[0] - left[0]) for left, right in pairwise(points)]
    bends = [after - before for before, after in zip([0.0, *slopes], [*slopes, 0.0], strict=True)]
    unused = _GREATEST_NUMBER_OF_POINTS - len(xs)
    return Hinges(float(points[0][1]), *(xs + [xs[-1]] * unused), *(bends + [0.0] * unused))


def _refuse_bad_points(points: Sequence[tuple[float, float]]) -> None:
    if not 1 <= len(points) <= _GREATEST_NUMBER_OF_POINTS:
        raise RailgripError(
            Problem("", "a curve needs one to four points", got=f"{len(points)} points")
        )
    if not all(math.isfinite(x) and math.isfinite(value) for x, value in points):
        raise RailgripError(Problem("", "points must be finite numbers", got=f"{list(points)}"))
    xs = [x for x, _ in points]
    if any(right <= left for left, right in pairwise(xs)):
        raise RailgripError(
            Problem("", "x must rise from point to point", got=f"x = {xs}", cure="sort the points")
        )
