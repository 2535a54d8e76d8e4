"""The arrays that Newton's method works on: kernels allocate nothing."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.optimum.conditions import CONDITIONS

Array = NDArray[np.float64]


class Point(NamedTuple):
    """Unknowns, slacks of the conditions, and multipliers."""

    square: Array
    motor: Array
    friction: Array
    slack: Array
    dual: Array
    room: Array
    press: Array
    clock: Array


class Work(NamedTuple):
    """The linear system, the step and scratch."""

    diagonal: Array
    beside: Array
    rhs: Array
    by_time: Array
    pivot: Array
    other: Array
    weight: Array
    spring: Array
    kept: Array
    edge: Array
    d_square: Array
    d_motor: Array
    d_friction: Array
    d_slack: Array
    d_dual: Array
    d_room: Array
    d_press: Array
    d_clock: Array
    value: Array
    gradient: Array
    bend: Array
    slopes: Array
    found: Array
    reach: Array
    lifted: Array
    price: Array


def new_point(square: Array, motor: Array, friction: Array) -> Point:
    """Return a point at a first guess."""
    n = motor.size
    two, ten = (n + 1, 2), (n, CONDITIONS)
    return Point(
        square.copy(), motor.copy(), friction.copy(),
        np.ones(ten), np.ones(ten), np.ones(two), np.ones(two), np.ones(2),
    )  # fmt: skip


def new_work(lowest: Array, highest: Array) -> Work:
    """Return the arrays for squares of speed between two bounds."""
    n = lowest.size - 1
    nodes, ten = (n + 1,), (n, CONDITIONS)
    return Work(
        diagonal=np.zeros(nodes),
        beside=np.zeros(nodes),
        rhs=np.zeros(nodes),
        by_time=np.zeros(nodes),
        pivot=np.zeros(nodes),
        other=np.zeros(nodes),
        weight=np.zeros(CONDITIONS),
        spring=np.zeros(5),
        kept=np.zeros((n, 6)),
        edge=np.column_stack([lowest, highest]),
        d_square=np.zeros(nodes),
        d_motor=np.zeros(n),
        d_friction=np.zeros(n),
        d_slack=np.zeros(ten),
        d_dual=np.zeros(ten),
        d_room=np.zeros((n + 1, 2)),
        d_press=np.zeros((n + 1, 2)),
        d_clock=np.zeros(2),
        value=np.zeros(CONDITIONS + 1),
        gradient=np.zeros((CONDITIONS + 1, 4)),
        bend=np.zeros(CONDITIONS + 1),
        slopes=np.zeros(2),
        found=np.zeros(5),
        reach=np.zeros(2),
        lifted=np.zeros(1),
        price=np.zeros(1),
    )
