"""A function of one influence: straight lines through a few points, held constant outside."""

from __future__ import annotations

from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np

from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.inputs import FloatArray

MOST_POINTS = 4
LEAST_GAP = 0.03
"""Least distance of two break points, in shares of the range of the data."""


class Shape(NamedTuple):
    """What is asked of a function: how many points, which of them may move.

    Parameters
    ----------
    points : int
        2 to 4.
    ends : {"flat", "open"}
        flat: all points are break points to be found, constant before the first and after the
        last; open: the first and last point stand where the data begin and end.
    at : tuple of float
        Places of the points where they are known; nothing moves then.
    """

    points: int = 2
    ends: Literal["flat", "open"] = "flat"
    at: tuple[float, ...] = ()

    @property
    def free_points(self) -> int:
        """How many break points are to be found."""
        if self.at:
            return 0
        return self.points if self.ends == "flat" else self.points - 2

    @property
    def parameters(self) -> int:
        """How many numbers are to be found: break points, and values but one."""
        return self.free_points + (len(self.at) or self.points) - 1


def check_shape(name: str, shape: Shape) -> None:
    """Refuse a shape that the pad file could not hold.

    Raises
    ------
    RailgripError
        ``speed.points: a function has 2 to 4 points; got 5``
    """
    count = len(shape.at) or shape.points
    if not 2 <= count <= MOST_POINTS:
        what = f"a function has 2 to {MOST_POINTS} points"
        raise RailgripError(Problem(f"{name}.points", what, got=str(count)))
    if any(b <= a for a, b in zip(shape.at, shape.at[1:], strict=False)):
        raise RailgripError(Problem(f"{name}.at", "must ascend", got=f"{list(shape.at)}"))


class Placed(NamedTuple):
    """A shape over data: where its points may stand.

    Parameters
    ----------
    shape : Shape
        What is asked.
    low, high : float
        Range of the data.
    """

    shape: Shape
    low: float
    high: float

    def places(self, numbers: FloatArray) -> FloatArray:
        """Return where the points stand: the first free one, then the gaps between them."""
        if self.shape.at:
            return np.array(self.shape.at)
        free = np.cumsum(numbers[: self.shape.free_points])
        if self.shape.ends == "flat":
            return np.asarray(free)
        room = 0.5 * LEAST_GAP * (self.high - self.low) * np.arange(len(free), 0, -1)
        return np.concatenate([[self.low], np.minimum(free, self.high - room), [self.high]])

    def values(self, numbers: FloatArray) -> FloatArray:
        """Return the values at the points, the first being 1."""
        return np.concatenate([[1.0], numbers[self.shape.free_points :]])

    def numbers(self, places: FloatArray, values: FloatArray) -> FloatArray:
        """Return the parameters of a curve through points; the reverse of the two above."""
        free = places if self.shape.ends == "flat" else places[1:-1]
        gaps = np.empty(0) if self.shape.at else np.diff(free, prepend=0.0)
        return np.concatenate([gaps, values[1:] / values[0]])

    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Return the least and greatest of each parameter."""
        span = self.high - self.low
        free = self.shape.free_points
        inner = LEAST_GAP * span
        low = np.full(self.shape.parameters, 0.05)
        high = np.full(self.shape.parameters, 20.0)
        if free:
            low[0], high[0] = self.low + inner, self.high - inner
            low[1:free], high[1:free] = inner, span
        return low, high


def hats(places: FloatArray, x: FloatArray) -> FloatArray:
    """Return the share of each point in the value at x, (…, point); the shares sum to 1.

    Examples
    --------
    >>> hats(np.array([150.0, 350.0]), np.array([100.0, 200.0])).tolist()
    [[1.0, 0.0], [0.75, 0.25]]
    """
    ramps = [np.clip((x - a) / (b - a), 0.0, 1.0) for a, b in pairwise(places.tolist())]
    inner = [before - after for before, after in pairwise(ramps)]
    return np.stack([1.0 - ramps[0], *inner, ramps[-1]], axis=-1)


def rise(places: FloatArray, values: FloatArray, x: FloatArray) -> FloatArray:
    """Return the slope of the curve at x, 0 outside its points."""
    slopes = (np.diff(values) / np.diff(places)).tolist()
    cells = pairwise(places.tolist())
    pieces = [s * ((x >= a) & (x < b)) for s, (a, b) in zip(slopes, cells, strict=True)]
    return np.asarray(sum(pieces))


def log_curve(placed: Placed, numbers: FloatArray, x: FloatArray) -> tuple[FloatArray, ...]:
    """Return log h(x), its derivative to each parameter, and its derivative to x.

    Parameters
    ----------
    placed : Placed
        The shape.
    numbers : ndarray (parameter,)
        First break point, gaps, then the values from the second point on.
    x : ndarray
        Influence.

    Returns
    -------
    tuple of ndarray
        log h of x's shape, (…, parameter), and x's shape.

    Notes
    -----
    h = Σ c_k H_k(x) with hats H_k. Moving a point k of a piece with slope s changes h by −s H_k.
    """
    places, values = placed.places(numbers), placed.values(numbers)
    shares = hats(places, x)
    h = shares @ values
    slope = rise(places, values, x)
    free = placed.shape.free_points
    begin = 0 if placed.shape.ends == "flat" else 1
    columns = [shares[..., 1:]]
    if free:
        moves = -slope[..., None] * shares[..., begin : begin + free]
        # a gap moves its own point and all that follow
        for k in range(free - 2, -1, -1):
            moves[..., k] += moves[..., k + 1]
        columns.insert(0, moves)
    return np.log(h), np.concatenate(columns, axis=-1) / h[..., None], slope / h
