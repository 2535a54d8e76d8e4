"""The fastest run on a grid: ceiling backwards, then full power forwards below it."""

from __future__ import annotations

from math import sqrt
from typing import Any

from railgrip.campaign.optimum.conditions import resistance_at
from railgrip.compiler import entry
from railgrip.engine.journey.forces import piece_at

DONE, STALLED, TOO_WEAK = 0, 1, 2


def open_force(pieces: Any, most: float, speed: float) -> float:
    """Return the greatest force at a speed, per dynamic mass."""
    if speed <= 0.0:
        return most
    i = piece_at(pieces, speed)
    force: float = pieces[i, 1] + pieces[i, 2] * speed + pieces[i, 3] / speed
    return min(max(force, 0.0), most)


def _flat_out(grid: Any, z: Any) -> int:
    """Replace the permitted squares of speed by those of the fastest run.

    ``z`` holds the permitted squares, its ends the squares asked for there. Returns the outcome
    and, above it by 10 × index, where it came to be.
    """
    n = grid.width.shape[0]
    for i in range(n - 1, -1, -1):
        low, high = 0.0, z[i]
        for halving in range(60):
            middle = high if halving == 0 else 0.5 * (low + high)
            square = 0.5 * (middle + z[i + 1])
            speed = sqrt(square)
            a = 0.5 * (z[i + 1] - middle) / grid.width[i]
            brakes = open_force(grid.brake, grid.bounds[3], speed)
            if grid.given[6]:
                brakes += grid.bounds[4]
            if a >= -grid.loss[i] and a + resistance_at(grid, i, square) >= -brakes:
                low = middle
                if halving == 0:
                    break
            else:
                high = middle
        if low <= 0.0 and z[i] > 0.0:
            return TOO_WEAK + 10 * i
        z[i] = low
    for i in range(n):
        low, high = 0.0, z[i + 1]
        for halving in range(60):
            middle = high if halving == 0 else 0.5 * (low + high)
            square = 0.5 * (middle + z[i])
            a = 0.5 * (middle - z[i]) / grid.width[i]
            pull = open_force(grid.effort, grid.bounds[2], sqrt(square))
            if a <= grid.gain[i] and a + resistance_at(grid, i, square) <= pull:
                low = middle
                if halving == 0:
                    break
            else:
                high = middle
        if low <= 0.0 and z[i + 1] > 0.0:
            return STALLED + 10 * i
        z[i + 1] = low
    return DONE


flat_out = entry(_flat_out)
