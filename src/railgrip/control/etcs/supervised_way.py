"""All that a train is told of the way ahead, and what the supervision allows on it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.control.etcs.ceiling import EMERGENCY, SERVICE, WARNING, ceiling_margin
from railgrip.control.etcs.limit_table import LIMITS, LimitTable
from railgrip.control.etcs.steps import Steps

Array = NDArray[np.float64]


class SupervisedWay(NamedTuple):
    """Speed limits and targets up to the end of authority.

    Parameters
    ----------
    limits : Steps
        Most restrictive speed over the position of the front, [m/s].
    tables : tuple of LimitTable
        One for each lower limit ahead and for the end of authority, ascending by position.

    Examples
    --------
    >>> from railgrip.control.etcs.limit_table import PERMITTED, limit_table
    >>> from railgrip.control.etcs.steps import constant
    >>> from railgrip.control.etcs.train_data import Brakes, SupervisedTrain, Target, Track
    >>> train = SupervisedTrain(200.0, Brakes(constant(1.0), constant(1.0), 2.5, 2.5))
    >>> stop = limit_table(train, Track(constant(0.0)), Target(5000.0), top=50.0)
    >>> way = SupervisedWay(constant(30.0), (stop,))
    >>> way.speeds([1000.0, 4500.0])[PERMITTED].round(2)
    array([30.  , 25.78])
    """

    limits: Steps
    tables: tuple[LimitTable, ...]

    def speeds(self, position: ArrayLike) -> Array:
        """Return the greatest speeds (limit, place) that are no excess at positions, [m/s].

        Before the first target's indication there is none: its speed is infinite.
        """
        places = np.atleast_1d(np.asarray(position, dtype=float))
        found = np.array([self._ceilings(x) for x in places.tolist()]).T
        for table in self.tables:
            found = np.minimum(found, table.speed_at(places))
        return found

    def deciding(self, position: float, limit: int) -> LimitTable | None:
        """Return the target that decides a limit at a place; none where a speed limit does."""
        least, found = self._ceilings(position)[limit], None
        for table in self.tables:
            speed = float(table.speed_at(position)[limit, 0])
            if speed < least:
                least, found = speed, table
        return found

    def _ceilings(self, position: float) -> list[float]:
        speed = self.limits.at(position)
        margins = (ceiling_margin(speed, m) for m in (WARNING, SERVICE, EMERGENCY))
        return [np.inf, speed, *(speed + margin for margin in margins)]


def excess(way: SupervisedWay, position: ArrayLike, speed: ArrayLike) -> Array:
    """Return how far speeds are above each limit, (limit, place), [m/s]."""
    asked = np.atleast_1d(np.asarray(speed, dtype=float))
    above: Array = asked - way.speeds(position)
    assert above.shape[0] == len(LIMITS)
    return above
