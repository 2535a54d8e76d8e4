"""Forces on a train that does not slip: scalar functions, compiled by the kernels."""

from __future__ import annotations

from math import sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.core.constants import GRAVITY
from railgrip.engine.journey.effort import brake_pieces, map_arrays, pieces_of
from railgrip.scenario.point_train import PointTrain

Array = NDArray[np.float64]


class TrainArrays(NamedTuple):
    """A train as the kernels read it, SI."""

    dynamic_mass: float
    weight: float
    constant: float
    linear: float
    quadratic: float
    max_acceleration: float
    friction_brake: float
    traction_efficiency: float
    brake_efficiency: float
    effort: Array
    brake: Array
    map_speed: Array
    map_share: Array
    map_value: Array


HOLD = -1.0
"""The share of the effort that means: as much as holds the speed."""
UNLIMITED = 1e12
"""Stands for a force or an acceleration that nothing limits."""


def train_arrays(train: PointTrain) -> TrainArrays:
    """Return the arrays of a train."""
    return TrainArrays(
        train.dynamic_mass,
        train.mass * GRAVITY,
        train.resistance.constant,
        train.resistance.linear,
        train.resistance.quadratic,
        UNLIMITED if train.max_acceleration is None else train.max_acceleration,
        UNLIMITED if train.friction_brake is None else train.friction_brake,
        train.efficiency.traction,
        train.efficiency.regeneration,
        pieces_of(train.effort),
        brake_pieces(train.regeneration),
        *map_arrays(train.efficiency.map),
    )


def piece_at(pieces: Any, speed: float) -> int:
    """Return the piece of an effort that holds at a speed, m/s."""
    low, high = 0, pieces.shape[0]
    while high - low > 1:
        middle = (low + high) // 2
        if pieces[middle, 0] <= speed:
            low = middle
        else:
            high = middle
    return low


def effort_at(pieces: Any, piece: int, speed: float) -> float:
    """Return the force of one piece of an effort, N."""
    force: float = pieces[piece, 1] + pieces[piece, 2] * speed
    if pieces[piece, 3] != 0.0:
        force += pieces[piece, 3] / max(speed, 1e-3)
    return max(force, 0.0)


def resistance(train: Any, slope: float, drag: float, speed: float) -> float:
    """Return what resists the motion, N: running resistance, tunnel, gradient and curve."""
    quadratic = train.quadratic + drag
    force: float = train.constant + (train.linear + quadratic * speed) * speed
    force += train.weight * slope
    return force


def efficiency(train: Any, speed: float, share: float, constant: float) -> float:
    """Return the efficiency between DC link and wheel: the map's, or else the constant."""
    n, m = train.map_speed.shape[0], train.map_share.shape[0]
    if n == 0:
        return constant
    i = 0
    while i < n - 2 and train.map_speed[i + 1] < speed:
        i += 1
    j = 0
    while j < m - 2 and train.map_share[j + 1] < share:
        j += 1
    x = (speed - train.map_speed[i]) / (train.map_speed[i + 1] - train.map_speed[i])
    y = (share - train.map_share[j]) / (train.map_share[j + 1] - train.map_share[j])
    x, y = min(max(x, 0.0), 1.0), min(max(y, 0.0), 1.0)
    low = train.map_value[i, j] * (1.0 - y) + train.map_value[i, j + 1] * y
    high = train.map_value[i + 1, j] * (1.0 - y) + train.map_value[i + 1, j + 1] * y
    found: float = low * (1.0 - x) + high * x
    return found


def speed_of(square: float) -> float:
    """Return the speed of a square of it, 0 for one that rounding made negative."""
    return sqrt(max(square, 0.0))
