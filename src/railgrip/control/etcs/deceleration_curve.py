"""Deceleration curve through a foot: arcs of parabola joined where the deceleration steps."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.control.etcs.deceleration_field import DecelerationField
from railgrip.core.errors import Problem, RailgripError

Array = NDArray[np.float64]


class DecelerationCurve(NamedTuple):
    """Speed over position of a train that brakes through a foot.

    Parameters
    ----------
    speed : ndarray (node)
        Ascending, [m/s].
    position : ndarray (node)
        Of the front, descending, [m].
    deceleration : ndarray (arc)
        Between the nodes, > 0, [m/s²].
    """

    speed: Array
    position: Array
    deceleration: Array

    def position_at(self, speed: ArrayLike) -> Array:
        """Return where the curve has a speed, [m]; NaN outside the curve."""
        asked = np.asarray(speed, dtype=float)
        arc = np.clip(
            np.searchsorted(self.speed, asked, side="right") - 1, 0, self.deceleration.size - 1
        )
        way = (asked**2 - self.speed[arc] ** 2) / (2.0 * self.deceleration[arc])
        # a foot speed that went through a change of units is the foot's all the same
        inside = (asked >= self.speed[0] - 1e-9) & (asked <= self.speed[-1] + 1e-9)
        return np.where(inside, self.position[arc] - way, np.nan)

    def speed_at(self, position: ArrayLike) -> Array:
        """Return the curve's speed at a position, [m/s]; NaN beyond its ends."""
        asked = np.asarray(position, dtype=float)
        arc = np.clip(
            np.searchsorted(-self.position, -asked, side="right") - 1, 0, self.deceleration.size - 1
        )
        square = self.speed[arc] ** 2 + 2.0 * self.deceleration[arc] * (self.position[arc] - asked)
        inside = (asked <= self.position[0]) & (asked >= self.position[-1])
        return np.where(inside, np.sqrt(np.maximum(square, 0.0)), np.nan)


def deceleration_curve(
    field: DecelerationField,
    position: float,
    speed: float,
    *,
    lowest: float,
    highest: float,
    name: str = "EBD",
) -> DecelerationCurve:
    """Return the curve through a point, from one speed to another.

    Parameters
    ----------
    field : DecelerationField
        What slows the train.
    position, speed : float
        A point that the curve goes through, [m], [m/s].
    lowest, highest : float
        Speeds between which the curve is wanted, ``lowest ≤ speed < highest``, [m/s].
    name : str
        Name of the curve, for the message.

    Returns
    -------
    DecelerationCurve
        Exact: there is no step, only arcs that end where the deceleration changes.

    Raises
    ------
    RailgripError
        ``EBD: the brake does not hold the train on the gradient; got −0.05 m/s² at 40 km/h, …``

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.8.1.3: arcs of parabola.

    Checked by tests/reference/etcs_era_tool: 0.25 m.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import Steps, constant
    >>> field = DecelerationField(Steps((0.0, 20.0), (1.0, 0.5)), constant(0.0))
    >>> curve = deceleration_curve(field, 1000.0, 0.0, lowest=0.0, highest=30.0)
    >>> float(curve.position_at(30.0))
    300.0
    """
    back = _arcs(field, position, speed, highest, name)
    ahead = _arcs(field, position, speed, lowest, name) if lowest < speed else []
    below = [(v, x, a) for v, x, a in reversed(ahead)]
    nodes = [(v, x) for v, x, _ in below] + [(speed, position)] + [(v, x) for v, x, _ in back]
    arcs = [a for _, _, a in below] + [a for _, _, a in back]
    speeds, positions = np.array(nodes).T
    return DecelerationCurve(speeds, positions, np.array(arcs))


def _arcs(
    field: DecelerationField, position: float, speed: float, until: float, name: str
) -> list[tuple[float, float, float]]:
    """Return (speed, position at the arc's far end, deceleration) from a point to a speed."""
    rises = until > speed
    speeds, positions = field.speed_breaks(), field.position_breaks()
    arcs = []
    while speed != until:
        next_speed = _next(speeds, speed, rises)
        if next_speed is None or (next_speed > until if rises else next_speed < until):
            next_speed = until
        next_position = _next(positions, position, not rises)
        inner = position + (-0.5 if rises else 0.5) if next_position is None else next_position
        deceleration = field.at(0.5 * (speed + next_speed), 0.5 * (position + inner))
        if deceleration <= 0.0:
            raise _no_brake(name, deceleration, speed, position)
        end = position - (next_speed**2 - speed**2) / (2.0 * deceleration)
        reached = next_speed
        if next_position is not None and (end < next_position if rises else end > next_position):
            square = speed**2 + 2.0 * deceleration * (position - next_position)
            end, reached = next_position, float(np.sqrt(max(square, 0.0)))
        arcs.append((reached, end, deceleration))
        speed, position = reached, end
    return arcs


def _next(breaks: list[float], here: float, rises: bool) -> float | None:
    """Return the break that comes next, upwards or downwards."""
    index = bisect_right(breaks, here) if rises else bisect_left(breaks, here) - 1
    return breaks[index] if 0 <= index < len(breaks) else None


def _no_brake(name: str, deceleration: float, speed: float, position: float) -> RailgripError:
    return RailgripError(
        Problem(
            name,
            "the brake does not slow the train on the gradient",
            got=f"{deceleration:.3g} m/s² at {3.6 * speed:.4g} km/h, {position:.6g} m",
            cure="a stronger brake or a gentler fall",
        )
    )
