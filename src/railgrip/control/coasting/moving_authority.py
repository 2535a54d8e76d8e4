"""Moving authority behind a slower train, as a target of the coasting-initiation law."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.control.coasting.coasting_law import AnnouncedTarget
from railgrip.core.errors import Problem, RailgripError


class MovingAuthority(NamedTuple):
    """Authority that ends a margin before the rear of a leading train.

    Parameters
    ----------
    time : ndarray (moment)
        Ascending, [s].
    position : ndarray (moment)
        Of the leader's front, never falling; straight between the moments, [m].
    length : float
        Of the leader, > 0, [m].
    margin : float
        ≥ 0, [m].
    period : float
        t_MA: the authority is renewed so often; 0 for all the time, [s].

    Examples
    --------
    >>> leader = moving_authority([0.0, 100.0], [1000.0, 2000.0], length=200.0, margin=50.0)
    >>> leader.target(14.0).position, leader.next_renewal(14.0)
    (850.0, 20.0)
    """

    time: NDArray[np.float64]
    position: NDArray[np.float64]
    length: float
    margin: float
    period: float

    def target(self, time: float) -> AnnouncedTarget:
        """Return the end of authority that is known at a time; its speed is 0."""
        known = time
        if self.period > 0.0:
            known = self.period * math.floor(time / self.period + 1e-9)
        front = float(np.interp(known, self.time, self.position))
        return AnnouncedTarget(front - self.length - self.margin)

    def speed(self, time: float) -> float:
        """Return how fast the end of authority moves: 0 between renewals, [m/s]."""
        if self.period > 0.0:
            return 0.0
        k = int(np.searchsorted(self.time, time, side="right"))
        if not 0 < k < self.time.size:
            return 0.0
        steps = np.diff(self.position[k - 1 : k + 1]) / np.diff(self.time[k - 1 : k + 1])
        return float(steps[0])

    def next_renewal(self, time: float) -> float:
        """Return when the authority changes next: a renewal, or a corner of the record, [s]."""
        if self.period > 0.0:
            return self.period * (math.floor(time / self.period + 1e-9) + 1)
        k = int(np.searchsorted(self.time, time + 1e-9, side="right"))
        return float(self.time[k]) if k < self.time.size else math.inf


def moving_authority(
    time: ArrayLike,
    position: ArrayLike,
    *,
    length: float,
    margin: float,
    period: float = 10.0,
) -> MovingAuthority:
    """Return the authority behind a leading train, its record checked.

    Parameters
    ----------
    time, position : array_like (moment)
        Record of the leader's front, [s], [m].
    length, margin, period : float
        As in `MovingAuthority`.

    Raises
    ------
    RailgripError
        ``time: must rise from moment to moment`` and so on.

    Examples
    --------
    >>> moving_authority([0.0, 9.0], [500.0, 500.0], length=100.0, margin=50.0).target(5.0).position
    350.0
    """
    times, places = np.asarray(time, dtype=float), np.asarray(position, dtype=float)
    problems = []
    if times.ndim != 1 or times.shape != places.shape or times.size < 2:
        got = f"{times.size} and {places.size}"
        problems.append(Problem("time", "needs two or more moments, as many as positions", got))
    else:
        if not (np.diff(times) > 0.0).all():
            problems.append(Problem("time", "must rise from moment to moment"))
        if not (np.diff(places) >= 0.0).all():
            problems.append(Problem("position", "the leading train must not run backwards"))
    for name, value, least in (("length", length, 0.0), ("margin", margin, 0.0),
                               ("period", period, 0.0)):  # fmt: skip
        if not value >= least:
            problems.append(Problem(name, "must not be negative", got=f"{value:g}"))
    if problems:
        raise RailgripError(problems)
    return MovingAuthority(times, places, length, margin, period)
