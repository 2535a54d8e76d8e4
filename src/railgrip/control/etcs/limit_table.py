"""Limits before one target as a table: the speed that each allows at a place."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.control.etcs.ceiling import EMERGENCY, SERVICE, WARNING, ceiling_margin
from railgrip.control.etcs.supervision import supervision_limits
from railgrip.control.etcs.train_data import SupervisedTrain, Target, Track

Array = NDArray[np.float64]

LIMITS: Final = ("indication", "permitted", "warning", "sbi", "ebi")
"""In the order in which a train that goes on as it is passes them; SBI is the first of both."""
INDICATION, PERMITTED, WARNED, SBI, EBI = range(5)
FINE: Final = 0.02
"""Step of the speed, m/s: distances between are off by 1 mm, by 2 cm where a brake steps."""


class LimitTable(NamedTuple):
    """What the supervision allows before one target.

    Parameters
    ----------
    target : Target
        Where which speed must be reached.
    speed : ndarray (speed)
        Ascending from the target's speed, or from its release speed, [m/s].
    distance : ndarray (limit, speed)
        Before the target, in the order of `LIMITS`, not falling, [m].
    floor : ndarray (limit)
        Speeds below which the target limits nothing, [m/s].
    """

    target: Target
    speed: Array
    distance: Array
    floor: Array

    def speed_at(self, position: ArrayLike) -> Array:
        """Return the greatest speeds (limit, place) that are no excess at positions, [m/s].

        Behind a lower speed nothing is limited any more, behind an end of authority all is.
        """
        left = self.target.position - np.atleast_1d(np.asarray(position, dtype=float))
        rows = np.array([np.interp(left, row, self.speed) for row in self.distance])
        rows = np.asarray(np.maximum(rows, self.floor[:, None]))
        behind = left <= 0.0
        rows[:, behind] = 0.0 if self.target.is_end_of_authority else np.inf
        return rows

    def distance_at(self, speed: ArrayLike) -> Array:
        """Return how far (limit, speed) before the target the limits lie, [m]."""
        asked = np.atleast_1d(np.asarray(speed, dtype=float))
        return np.array([np.interp(asked, self.speed, row) for row in self.distance])


def limit_table(
    train: SupervisedTrain,
    track: Track,
    target: Target,
    *,
    top: float,
    driver_reacts: bool = False,
    release_speed: float = 0.0,
) -> LimitTable:
    """Return the limits before a target over the speed.

    Parameters
    ----------
    train, track, target : SupervisedTrain, Track, Target
        What the supervision knows.
    top : float
        Greatest speed that may come up, above the target's, [m/s].
    driver_reacts : bool
        Whether T_driver is part of T_indication.
    release_speed : float
        Of an end of authority: below it, and nearer than its first intervention, it is the one
        speed that is supervised, [m/s].

    Raises
    ------
    RailgripError
        Where the brake does not slow the train on the gradient.

    Notes
    -----
    Above a lower speed V the limits never fall below V, V + dV_warning, V + dV_sbi, V + dV_ebi.

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.9.3 and 3.13.10.

    Checked by tests/reference/etcs_era_tool: the stored values of ERA's tool, 0.25 m.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import constant
    >>> from railgrip.control.etcs.train_data import Brakes
    >>> train = SupervisedTrain(200.0, Brakes(constant(1.0), constant(1.0), 2.5, 2.5))
    >>> table = limit_table(train, Track(constant(0.0)), Target(5000.0), top=50.0)
    >>> table.speed_at(5000.0 - 1060.0)[PERMITTED].round(3), table.distance_at(40.0)[EBI]
    (array([40.]), array([900.]))
    """
    release = release_speed if target.is_end_of_authority else 0.0
    least = max(target.speed, release)
    speed = np.append(np.arange(least, top, FINE), top)
    found = supervision_limits(
        train, track, target, speed, driver_reacts=driver_reacts, release_speed=release
    )
    rows = (found.indication, found.permitted, found.warning,
            np.fmax(found.sbi1, found.sbi2), found.ebi)  # fmt: skip
    margins = (0.0, 0.0, *(ceiling_margin(target.speed, m) for m in (WARNING, SERVICE, EMERGENCY)))
    floor = np.full(len(LIMITS), least)
    if not target.is_end_of_authority:
        floor += np.array(margins)
    return LimitTable(target, speed, np.maximum.accumulate(np.array(rows), axis=1), floor)
