"""The ten conditions of one interval of the grid, with their derivatives.

Unknown are the squares of speed z at both ends, the motors' brake r and the friction brake f. In
the middle of the interval, with the mean square, the traction is

    p = a + R(v) + slope + r + f,    a = (z₁ − z₀)/(2 width).
"""

from __future__ import annotations

from math import sqrt
from typing import Any

from railgrip.engine.journey.forces import piece_at

CONDITIONS = 10
FLOOR = 1e-3
"""The least force that a limit leaves open, m/s²; a limit of nothing has no inside."""


def limit_at(pieces: Any, speed: float, out: Any) -> float:
    """Return a force limit; leave its derivatives by the square of the speed in ``out``."""
    i = piece_at(pieces, speed)
    square, c0, c1, c2 = speed * speed, pieces[i, 1], pieces[i, 2], pieces[i, 3]
    force: float = c0 + c1 * speed + c2 / speed
    out[0] = 0.5 * c1 / speed - 0.5 * c2 / (square * speed)
    out[1] = -0.25 * c1 / (square * speed) + 0.75 * c2 / (square * square * speed)
    if force < FLOOR:
        out[0] = 0.0
        out[1] = 0.0
        return FLOOR
    return force


def resistance_at(grid: Any, i: int, square: float) -> float:
    """Return running resistance and gradient force in an interval, per dynamic mass."""
    constant, linear = grid.bounds[0], grid.bounds[1]
    found: float = constant + linear * sqrt(square) + grid.drag[i] * square + grid.slope[i]
    return found


def conditions(grid: Any, i: int, z: Any, motor: float, friction: float, work: Any) -> float:
    """Fill values, gradients and curvatures of an interval's conditions; return the traction.

    ``work.value[j] ≥ 0`` is condition j, ``work.gradient[j]`` its derivatives by z₀, z₁, r and f,
    ``work.bend[j]`` its second derivative by the mean square; row 10 holds those of p itself.
    """
    value, gradient, bend, limits = work.value, work.gradient, work.bend, grid.bounds
    width = grid.width[i]
    square = 0.5 * (z[i] + z[i + 1])
    speed = sqrt(square)
    steep = 0.5 / width
    a = (z[i + 1] - z[i]) * steep
    half_r = 0.5 * (0.5 * limits[1] / speed + grid.drag[i])
    bend_r = -0.25 * limits[1] / (square * speed)
    p: float = a + resistance_at(grid, i, square) + motor + friction
    by_0, by_1 = half_r - steep, half_r + steep
    effort = limit_at(grid.effort, speed, work.slopes)
    half_e, bend_e = 0.5 * work.slopes[0], work.slopes[1]
    brake = limit_at(grid.brake, speed, work.slopes)
    half_b, bend_b = 0.5 * work.slopes[0], work.slopes[1]
    for j in range(11):
        gradient[j, 0] = gradient[j, 1] = gradient[j, 2] = gradient[j, 3] = bend[j] = 0.0
    value[0] = value[10] = p
    value[1], value[2] = limits[2] - p, effort - p
    for j in (0, 1, 2, 10):
        sign = 1.0 if j in (0, 10) else -1.0
        gradient[j, 0], gradient[j, 1] = sign * by_0, sign * by_1
        gradient[j, 2] = gradient[j, 3] = sign
        bend[j] = sign * bend_r
    gradient[2, 0] += half_e
    gradient[2, 1] += half_e
    bend[2] += bend_e
    value[3], value[4], value[5] = motor, limits[3] - motor, brake - motor
    gradient[3, 2], gradient[4, 2], gradient[5, 2] = 1.0, -1.0, -1.0
    gradient[5, 0] = gradient[5, 1] = half_b
    bend[5] = bend_b
    value[6], value[7] = friction, limits[4] - friction
    gradient[6, 3], gradient[7, 3] = 1.0, -1.0
    value[8], value[9] = grid.gain[i] - a, grid.loss[i] + a
    gradient[8, 0], gradient[8, 1] = steep, -steep
    gradient[9, 0], gradient[9, 1] = -steep, steep
    return p
