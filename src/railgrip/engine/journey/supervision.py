"""The supervision aboard a journey: limits of the line and the way ahead, and its ceiling."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from railgrip.control.etcs.ceiling import EMERGENCY, ceiling_margin
from railgrip.control.etcs.limit_table import PERMITTED, LimitTable, limit_table
from railgrip.control.etcs.steps import Steps
from railgrip.control.etcs.supervised_way import SupervisedWay
from railgrip.control.etcs.train_data import Target
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.journey.profile import Piece, braked, limit_pieces, limits
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

RESERVE = 0.005
"""The ceiling stays so far below a permitted speed that falls: chords lie above its curve, m/s."""
COARSE = 0.02
"""Nodes of the ceiling are this share of the speed apart, and so many m/s."""
TINY = 1e-6
"""Left and right of a place, m."""


class Onboard:
    """The supervision of a journey: its targets' limits, computed once each.

    Parameters
    ----------
    journey : Journey
        With a table ``supervision``.

    Raises
    ------
    RailgripError
        ``supervision: is missing``; ``supervision.train: EBD: the brake does not slow …``
    """

    def __init__(self, journey: Journey) -> None:
        if journey.supervision is None:
            raise RailgripError(Problem("supervision", "is missing", cure="a table [supervision]"))
        self.journey, self.own = journey, journey.supervision
        self.track = self.own.track(journey.line)
        at, speed = zip(*limits(journey), strict=True)
        self.limits = Steps(at, speed)
        self.top = max(speed) + ceiling_margin(max(speed), EMERGENCY) + 5.0
        self.drops = [
            self._table(Target(at[k], speed[k], is_end_of_authority=False))
            for k in range(1, len(at)) if speed[k] < speed[k - 1]
        ]  # fmt: skip
        self._ends: dict[float, LimitTable] = {}

    def way(self, authority: float, stop: float, is_stop: bool = True) -> SupervisedWay:
        """Return what is known before a stop, or before an authority that ends earlier."""
        end = min(authority, stop + self.own.past_stop) if is_stop else authority
        tables = tuple(table for table in self.drops if table.target.position < end)
        if end < np.inf:
            tables = (*tables, self._end(end))
        return SupervisedWay(self.limits, tables)

    def ceiling(
        self, way: SupervisedWay, begin: float, end: float, final_speed: float
    ) -> tuple[Array, Array, Array]:
        """Return the highest square of speed below the permitted speed and the braking curves.

        As `railgrip.engine.journey.profile.ceiling` does; the permitted speed is kept to by
        5 mm/s, and where that leaves nothing, centimetres before an end of authority, it ends.
        """
        deceleration = self.journey.deceleration()
        assert deceleration is not None
        lid = braked(self._pieces(way, begin, end), final_speed, deceleration)
        count = max(int(np.flatnonzero(lid[1] > 0.0).max(initial=-1)) + 1, 1)
        return lid[0][: count + 1], lid[1][:count], lid[2][:count]

    def kept(self, way: SupervisedWay, place: float) -> float:
        """Return the speed that a train kept below the permitted speed has at most at a place."""
        return float(self._permitted(way, np.array([place]))[0])

    def _pieces(self, way: SupervisedWay, begin: float, end: float) -> list[Piece]:
        marks = [at for piece in limit_pieces(self.journey, begin, end) for at in piece[:2]]
        places = np.unique(np.concatenate([marks, *(_nodes(table) for table in way.tables)]))
        places = places[(places >= begin) & (places <= end)]
        places = places[np.append(np.diff(places) > 10.0 * TINY, True)]
        right = self._permitted(way, places[:-1] + TINY)
        left = self._permitted(way, places[1:] - TINY)
        return list(zip(places[:-1].tolist(), places[1:].tolist(), (right**2).tolist(),
                        (left**2).tolist(), strict=True))  # fmt: skip

    def _permitted(self, way: SupervisedWay, places: Array) -> Array:
        least = np.array([self.limits.at(x) for x in places.tolist()])
        for table in way.tables:
            speed = table.speed_at(places)[PERMITTED]
            least = np.minimum(least, np.maximum(speed - RESERVE, table.floor[PERMITTED]))
        return least

    def _end(self, position: float) -> LimitTable:
        if position not in self._ends:
            location = position + self.own.overlap
            self._ends[position] = self._table(Target(position, supervised_location=location))
        return self._ends[position]

    def _table(self, target: Target) -> LimitTable:
        own = self.own
        try:
            return limit_table(
                own.train_before(target.speed), self.track, target, top=self.top,
                driver_reacts=own.driver_reacts, release_speed=own.release_speed,
            )  # fmt: skip
        except RailgripError as error:
            raise RailgripError(
                [replace(one, where=f"supervision.train: {one.where}") for one in error.problems]
            ) from None


def _nodes(table: LimitTable) -> Array:
    """Return where a polygon through the permitted speed needs its corners."""
    speeds, top = [float(table.speed[0])], float(table.speed[-1])
    while speeds[-1] < top:
        speeds.append(speeds[-1] + COARSE * (1.0 + speeds[-1]))
    before = table.distance_at(speeds)[PERMITTED]
    return np.append(table.target.position - before, table.target.position)
