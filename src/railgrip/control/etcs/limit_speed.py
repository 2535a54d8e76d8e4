"""Speed of a supervision limit at a place: what a train may run there."""

from __future__ import annotations

from typing import Final

import numpy as np

from railgrip.control.etcs.supervision import CURVES, supervision_limits
from railgrip.control.etcs.train_data import SupervisedTrain, Target, Track
from railgrip.core.errors import RailgripError, unknown_name

EXACT: Final = 1e-9
"""Halving ends at so small a range of speeds, m/s."""


def limit_speed(
    train: SupervisedTrain,
    track: Track,
    target: Target,
    position: float,
    *,
    ceiling: float,
    name: str = "permitted",
) -> float:
    """Return the greatest speed at a position that a limit allows.

    Parameters
    ----------
    train, track, target : SupervisedTrain, Track, Target
        What the supervision knows.
    position : float
        Of the front, [m].
    ceiling : float
        Speed limit before the target, above the target's speed, [m/s].
    name : str
        One of `CURVES`; the permitted speed is the driver's limit.

    Returns
    -------
    float
        Between the target's speed and the ceiling, [m/s].

    Raises
    ------
    RailgripError
        ``name: curve 'permited' unknown; known: …; did you mean 'permitted'?``

    Notes
    -----
    The distances grow with the speed, so the speed is found by halving.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import constant
    >>> from railgrip.control.etcs.train_data import Brakes
    >>> train = SupervisedTrain(200.0, Brakes(constant(1.0), constant(1.0), 2.5, 2.5))
    >>> track, stop = Track(constant(0.0)), Target(5000.0)
    >>> round(limit_speed(train, track, stop, 5000.0 - 1060.0, ceiling=50.0), 6)
    40.0
    """
    if name not in CURVES:
        raise RailgripError(unknown_name("name", "curve", name, CURVES))
    low, high = target.speed, ceiling
    while high - low > EXACT:
        middle = 0.5 * (low + high)
        limits = supervision_limits(train, track, target, np.array([middle]))
        if float(getattr(limits, name)[0]) > target.position - position:
            high = middle
        else:
            low = middle
    return low
