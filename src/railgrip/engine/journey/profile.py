"""The line as the train feels it: resistance by sections and the ceiling of permitted speed."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]
Piece = tuple[float, float, float, float]
"""Begin, end [m], and the squares of a speed at both [m²/s²]."""


def curve_resistance(radius: float) -> float:
    """Return the resistance of a curve over the weight (Roeckl).

    Parameters
    ----------
    radius : float
        Of the curve, [m]; above 60 m, below that the value at 60 m.

    Notes
    -----
    0.65/(R − 55 m) from 300 m, 0.5/(R − 30 m) below.

    Examples
    --------
    >>> round(curve_resistance(400.0) * 1e3, 2)
    1.88
    """
    radius = max(radius, 60.0)
    return 0.65 / (radius - 55.0) if radius >= 300.0 else 0.5 / (radius - 30.0)


class Sections:
    """Gradient, curve and tunnel resistance, as what they are in each section of the line.

    Attributes
    ----------
    position : array (section + 1)
        Where sections begin, and where the last one ends, [m].
    slope, slope_change : array (section)
        Specific force against the motion over the weight at the beginning, and its change [1/m].
    drag : array (section)
        Quadratic resistance that a tunnel adds, [N s²/m²].
    """

    def __init__(self, journey: Journey) -> None:
        line, train = journey.line, journey.train
        slopes = [(point.at, point.value) for point in line.gradient]
        if not slopes or slopes[0][0] > 0.0:
            slopes = [(0.0, 0.0), *slopes]
        if journey.curve_resistance:
            slopes = _added(
                slopes, [(c.begin, c.end, curve_resistance(c.radius)) for c in line.curve]
            )
        tunnels = [
            (one.begin, one.end, train.tunnel_quadratic(one.cross_section)) for one in line.tunnel
        ]
        drags = _added([(0.0, 0.0)], tunnels)
        length = train.length if journey.gradient_under == "train" else 0.0
        marks = {0.0, line.length, *(at for at, _ in slopes), *(at for at, _ in drags)}
        marks |= {at + length for at, _ in slopes}
        self.position = np.array(sorted(mark for mark in marks if mark <= line.length))
        begin, end = self.position[:-1], self.position[1:]
        self.drag = _at(drags, begin)
        if length == 0.0:
            self.slope, self.slope_change = _at(slopes, begin), np.zeros(begin.size)
        else:
            # the mean under the train is a difference of the height, linear between the marks
            mean = (
                _height(slopes, self.position) - _height(slopes, self.position - length)
            ) / length
            self.slope = mean[:-1]
            self.slope_change = np.diff(mean) / (end - begin)

    def mean_slope(self, places: Array) -> Array:
        """Return the mean of the slope between neighbouring places."""
        widths = np.diff(self.position)
        parts = (self.slope + 0.5 * self.slope_change * widths) * widths
        total = np.concatenate([[0.0], np.cumsum(parts)])
        i = np.clip(np.searchsorted(self.position, places, "right") - 1, 0, self.slope.size - 1)
        inside = places - self.position[i]
        height = total[i] + (self.slope[i] + 0.5 * self.slope_change[i] * inside) * inside
        return np.asarray(np.diff(height) / np.diff(places))

    def drag_at(self, places: Array) -> Array:
        """Return the drag that tunnels add at places."""
        i = np.clip(np.searchsorted(self.position, places, "right") - 1, 0, self.slope.size - 1)
        return np.asarray(self.drag[i])


def limits(journey: Journey) -> list[tuple[float, float]]:
    """Return (position, permitted speed) from there on, the train's length and own speed heeded.

    A higher limit holds for the front once the rear has left the lower one.
    """
    train = journey.train
    top, length = train.max_speed, train.length if train.rear_clears else 0.0
    points = [(point.at, point.value) for point in journey.line.speed_limit]
    if length > 0.0:
        ends = [at for at, _ in points[1:]] + [journey.line.length]
        marks = sorted({at for at, _ in points} | {end + length for end in ends})
        points = [
            (mark, min(v for (at, v), end in zip(points, ends, strict=True)
                       if at <= mark < end + length))
            for mark in marks if mark < journey.line.length
        ]  # fmt: skip
    found: list[tuple[float, float]] = []
    for at, speed in points:
        speed = min(speed, top)
        if not found or found[-1][1] != speed:
            found.append((at, speed))
    return found


def ceiling(
    journey: Journey, begin: float, end: float, final_speed: float, deceleration: float
) -> tuple[Array, Array, Array]:
    """Return the highest square of speed that limits and braking curves leave, by pieces.

    Parameters
    ----------
    journey : Journey
        Line and train.
    begin, end : float
        The leg from stop to stop, [m].
    final_speed : float
        At its end, [m/s].
    deceleration : float
        Of the braking curves, [m/s²].

    Returns
    -------
    position : array (piece + 1)
        Where pieces begin, the last entry their end, [m].
    square, slope : array (piece)
        Square of the speed at the beginning of each piece [m²/s²] and its slope [m/s²],
        0, −2 × deceleration or between. It may jump up between pieces, never down.
    """
    return braked(limit_pieces(journey, begin, end), final_speed, deceleration)


def limit_pieces(journey: Journey, begin: float, end: float) -> list[Piece]:
    """Return the squares of the speed limits by pieces, without braking curves."""
    steps = limits(journey)
    first = [v * v for at, v in steps if at <= begin][-1]
    marks = [(begin, first), *((at, v * v) for at, v in steps if begin < at < end)]
    stops = [at for at, _ in marks[1:]] + [end]
    return [(at, stop, square, square) for (at, square), stop in zip(marks, stops, strict=True)]


def braked(
    pieces: list[Piece], final_speed: float, deceleration: float
) -> tuple[Array, Array, Array]:
    """Return the highest square of speed below pieces that a train can keep to by its brake.

    Parameters
    ----------
    pieces : list of (begin, end, square there, square here)
        Lines of the square of the speed over position, one behind the other; they may jump, and
        fall more steeply than the train brakes.
    final_speed, deceleration : float
        At the end of the last one, [m/s]; of the brake, [m/s²].

    Returns
    -------
    (position, square, slope)
        As `ceiling`.
    """
    rows: list[tuple[float, float, float]] = []
    steepest, after = 2.0 * deceleration, final_speed**2
    for at, stop, first, last in reversed(pieces):
        slope = (last - first) / (stop - at)
        top = min(last, after)  # at the end of this piece
        foot = stop
        if last > top or slope < -steepest:
            foot = stop - (last - top) / (steepest + slope) if slope > -steepest else at
            foot = max(foot, at)
            if foot < stop:
                rows.append((foot, top + steepest * (stop - foot), -steepest))
        if foot > at:
            rows.append((at, first, slope))
        after = rows[-1][1]
    rows.reverse()
    table = np.array(rows)
    ends = np.append(table[:, 0], pieces[-1][1])
    return ends, table[:, 1].copy(), table[:, 2].copy()


def _added(
    steps: list[tuple[float, float]], stretches: list[tuple[float, float, float]]
) -> list[tuple[float, float]]:
    marks = sorted({at for at, _ in steps} | {x for a, b, _ in stretches for x in (a, b)})
    places = np.array(marks)
    base = _at(steps, places)
    for begin, end, value in stretches:
        base[(begin <= places) & (places < end)] += value
    return list(zip(marks, base.tolist(), strict=True))


def _at(steps: list[tuple[float, float]], places: Array) -> Array:
    positions = np.array([at for at, _ in steps])
    values = np.array([value for _, value in steps])
    return np.asarray(values[np.searchsorted(positions, places, "right") - 1])


def _height(steps: list[tuple[float, float]], places: Array) -> Array:
    """Return the integral of a step function from 0; the first step goes on before it."""
    total = [0.0]
    for (a, value), (b, _) in pairwise(steps):
        total.append(total[-1] + value * (b - a))
    i = np.clip(np.searchsorted([at for at, _ in steps], places, "right") - 1, 0, None)
    positions = np.array([at for at, _ in steps])[i]
    values = np.array([value for _, value in steps])[i]
    return np.asarray(np.array(total)[i] + values * (places - positions))
