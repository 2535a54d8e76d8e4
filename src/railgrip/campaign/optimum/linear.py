"""The linear system of one Newton step: tridiagonal, plus one dense row for the time."""

from __future__ import annotations

from math import sqrt
from typing import Any

from railgrip.campaign.optimum.conditions import CONDITIONS, conditions

OBJECTIVE, TIME, MISFIT, GAP, COUNT = range(5)
"""Places in ``work.found``: what `assemble` finds besides the system."""

LATE = 1e-4
"""What a second of lateness is paid, in the grid's units, so that the time asked for is used up
even where it saves nothing. The optimum of that time is the same."""


def assemble(grid: Any, point: Any, work: Any, target: float, aim: float) -> None:
    """Fill the system of the Newton step towards complementarity ``aim``.

    ``point.clock`` is (slack of the time, price of time); ``target`` is the time asked for.
    """
    n = grid.width.shape[0]
    z, drive, back = point.square, grid.bounds[7], grid.bounds[8]
    price = point.clock[1] - (LATE if target > 0.0 else 0.0)
    convex = max(price, 0.0)
    diagonal, beside, rhs, by_time = work.diagonal, work.beside, work.rhs, work.by_time
    for k in range(n + 1):
        diagonal[k] = rhs[k] = by_time[k] = 0.0
        beside[k] = 0.0
    objective = seconds = misfit = gap = 0.0
    count = 0
    for i in range(n):
        p = conditions(grid, i, z, point.motor[i], point.friction[i], work)
        width = grid.width[i]
        objective += width * (drive * p - back * point.motor[i])
        value, slope, bend = work.value, work.gradient, work.bend
        cost = width * drive
        g0, g1 = cost * slope[10, 0], cost * slope[10, 1]
        g2, g3 = cost - width * back, cost
        curve = cost * bend[10]
        w00 = w01 = w02 = w03 = w11 = w12 = w13 = w22 = w23 = w33 = 0.0
        for j in range(CONDITIONS):
            if not grid.given[j]:
                continue
            s, y = point.slack[i, j], point.dual[i, j]
            miss = value[j] - s
            misfit = max(misfit, abs(miss))
            gap += s * y
            count += 1
            ratio = y / s
            new = y + (aim - s * y) / s - ratio * miss
            a, b, c, d = slope[j, 0], slope[j, 1], slope[j, 2], slope[j, 3]
            g0 -= a * new
            g1 -= b * new
            g2 -= c * new
            g3 -= d * new
            curve -= y * bend[j]
            w00 += ratio * a * a
            w01 += ratio * a * b
            w02 += ratio * a * c
            w03 += ratio * a * d
            w11 += ratio * b * b
            w12 += ratio * b * c
            w13 += ratio * b * d
            w22 += ratio * c * c
            w23 += ratio * c * d
            w33 += ratio * d * d
        curve *= 0.25
        w00 += curve
        w01 += curve
        w11 += curve
        if not grid.given[3]:
            w22, w02, w12, w23, g2 = 1.0, 0.0, 0.0, 0.0, 0.0
        if not grid.given[6]:
            w33, w03, w13, w23, g3 = 1.0, 0.0, 0.0, 0.0, 0.0
        # both brakes of the interval are eliminated
        det = w22 * w33 - w23 * w23
        i22, i23, i33 = w33 / det, -w23 / det, w22 / det
        a0, b0 = i22 * w02 + i23 * w03, i23 * w02 + i33 * w03
        a1, b1 = i22 * w12 + i23 * w13, i23 * w12 + i33 * w13
        ag, bg = i22 * g2 + i23 * g3, i23 * g2 + i33 * g3
        kept = work.kept
        kept[i, 0], kept[i, 1], kept[i, 2] = a0, a1, ag
        kept[i, 3], kept[i, 4], kept[i, 5] = b0, b1, bg
        diagonal[i] += w00 - w02 * a0 - w03 * b0
        beside[i] += w01 - w02 * a1 - w03 * b1
        diagonal[i + 1] += w11 - w12 * a1 - w13 * b1
        rhs[i] += g0 - w02 * ag - w03 * bg
        rhs[i + 1] += g1 - w12 * ag - w13 * bg
        # the time 2 width / (v₀ + v₁), convex in the squares
        v0, v1 = sqrt(z[i]), sqrt(z[i + 1])
        total = v0 + v1
        seconds += 2.0 * width / total
        once = 2.0 * width / (total * total)
        twice = 2.0 * once / total
        d0 = 0.5 / v0 if v0 > 0.0 else 0.0
        d1 = 0.5 / v1 if v1 > 0.0 else 0.0
        by_time[i] -= once * d0
        by_time[i + 1] -= once * d1
        if v0 > 0.0:
            diagonal[i] += convex * (twice * d0 * d0 + 0.5 * once * d0 / z[i])
        if v1 > 0.0:
            diagonal[i + 1] += convex * (twice * d1 * d1 + 0.5 * once * d1 / z[i + 1])
        beside[i] += convex * twice * d0 * d1
    for k in range(1, n):
        for side in range(2):
            sign = 1.0 if side == 0 else -1.0
            s, y = point.room[k, side], point.press[k, side]
            miss = sign * (z[k] - work.edge[k, side]) - s
            misfit = max(misfit, abs(miss))
            gap += s * y
            count += 1
            diagonal[k] += y / s
            rhs[k] -= sign * (y + (aim - s * y) / s - y / s * miss)
    spare = point.clock[0]
    miss = target - seconds - spare
    new = price
    if target > 0.0:
        misfit = max(misfit, abs(miss))
        gap += spare * point.clock[1]
        count += 1
        new += (aim - spare * point.clock[1]) / spare - point.clock[1] / spare * miss
    for k in range(1, n):
        rhs[k] += by_time[k] * new
    found = work.found
    found[0], found[1], found[2], found[3], found[4] = objective, seconds, misfit, gap, count


def factorise(work: Any, n: int, lift: float) -> bool:
    """Factorise the tridiagonal part with a lifted diagonal; False where it is not positive."""
    pivot = work.diagonal[1] + lift
    if not pivot > 0.0:
        return False
    work.pivot[1] = pivot
    for k in range(1, n - 1):
        pivot = work.diagonal[k + 1] + lift - work.beside[k] * work.beside[k] / pivot
        if not pivot > 1e-13 * abs(work.diagonal[k + 1]):
            return False
        work.pivot[k + 1] = pivot
    return True


def substitute(work: Any, n: int, x: Any) -> None:
    """Solve the factorised system in place."""
    for k in range(2, n):
        x[k] -= work.beside[k - 1] / work.pivot[k - 1] * x[k - 1]
    x[n - 1] /= work.pivot[n - 1]
    for k in range(n - 2, 0, -1):
        x[k] = (x[k] - work.beside[k] * x[k + 1]) / work.pivot[k]


def direction(grid: Any, point: Any, work: Any, target: float) -> bool:
    """Fill ``work.d_square`` with the step of the squares; False where no lift helps."""
    n = grid.width.shape[0]
    lift = 0.0
    while not factorise(work, n, lift):
        lift = max(1e-6, 10.0 * lift, work.lifted[0] / 3.0)
        if not lift < 1e12:
            return False
    work.lifted[0] = lift if lift > 0.0 else work.lifted[0]
    u, w = work.d_square, work.other
    for k in range(1, n):
        u[k], w[k] = -work.rhs[k], work.by_time[k]
    substitute(work, n, u)
    if target > 0.0:
        substitute(work, n, w)
        along = across = 0.0
        for k in range(1, n):
            along += work.by_time[k] * u[k]
            across += work.by_time[k] * w[k]
        ratio = point.clock[1] / point.clock[0]
        part = ratio * along / (1.0 + ratio * across)
        for k in range(1, n):
            u[k] -= part * w[k]
    return True
