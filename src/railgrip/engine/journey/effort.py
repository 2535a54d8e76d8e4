"""Tractive effort, regeneration and efficiency as arrays that a kernel reads.

An effort is a row of pieces; piece i holds from ``pieces[i, 0]`` to the next one's speed and is
``c0 + c1 v + c2 / v`` with the coefficients in columns 1 to 3.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from railgrip.scenario.point_train import EfficiencyMap, Effort, Regeneration

Array = NDArray[np.float64]


def pieces_of(effort: Effort) -> Array:
    """Return the pieces of a tractive effort.

    Examples
    --------
    >>> pieces_of(Effort(force=200e3, power=2e6)).tolist()
    [[0.0, 200000.0, 0.0, 0.0], [10.0, 0.0, 0.0, 2000000.0]]
    """
    if not effort.table:
        assert effort.force is not None
        assert effort.power is not None
        return hyperbola(effort.force, effort.power)
    rows = []
    for here, there in zip(effort.table, (*effort.table[1:], effort.table[-1]), strict=True):
        slope = 0.0
        if effort.between == "linear" and there.speed > here.speed:
            slope = (there.force - here.force) / (there.speed - here.speed)
        rows.append((here.speed, here.force - slope * here.speed, slope, 0.0))
    return np.array(rows)


def hyperbola(force: float, power: float) -> Array:
    """Return a constant force up to where it takes the power, then the power over the speed."""
    if force == 0.0 or power == 0.0:
        return np.zeros((1, 4))
    return np.array([(0.0, force, 0.0, 0.0), (power / force, 0.0, 0.0, power)])


def brake_pieces(brake: Regeneration) -> Array:
    """Return the pieces of the motors' brake, faded out at low speed."""
    pieces = hyperbola(brake.force, brake.power)
    if brake.fade_start == 0.0 or len(pieces) == 1:
        return pieces
    if brake.fade_start > pieces[1, 0]:
        brake = brake.model_copy(update={"fade_start": float(pieces[1, 0])})
    end, start = min(brake.fade_end, brake.fade_start), brake.fade_start
    slope = brake.force / (start - end) if start > end else 0.0
    rows = [(0.0, 0.0, 0.0, 0.0), (end, -slope * end, slope, 0.0)]
    rows = rows[:1] if start == end else rows[int(end == 0.0) :]
    return np.array([*rows, (start, brake.force, 0.0, 0.0), tuple(pieces[1])])


def map_arrays(chart: EfficiencyMap | None) -> tuple[Array, Array, Array]:
    """Return speeds, shares and values; empty arrays for no map."""
    if chart is None:
        return np.zeros(0), np.zeros(0), np.zeros((0, 0))
    return np.array(chart.speed), np.array(chart.share), np.array(chart.value)
