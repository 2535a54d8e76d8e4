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
    z, drive, back = point.square, grid.bounds[5], grid.bounds[6]
    price = point.clock[1] - (LATE if target > 0.0 else 0.0)
    # where a second is worth little, its reward has a curvature of its own: steps stay in bounds
    convex = max(price, 0.01 * LATE)
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
        weight = work.weight
        for j in range(CONDITIONS):
            weight[j] = 0.0
            if not grid.given[j]:
                continue
            s, y = point.slack[i, j], point.dual[i, j]
            miss = value[j] - s
            misfit = max(misfit, abs(miss))
            gap += s * y
            count += 1
            weight[j] = y / s
            new = y + (aim - s * y) / s - weight[j] * miss
            g0 -= slope[j, 0] * new
            g1 -= slope[j, 1] * new
            g2 -= slope[j, 2] * new
            g3 -= slope[j, 3] * new
            curve -= y * bend[j]
        both = 0.25 * curve + without_brakes(grid, i, slope, weight, g2, g3, work)
        h0, h1, k = work.spring[0], work.spring[1], work.spring[2]
        stiff, c = work.spring[3], work.spring[4]
        steep = (weight[8] + weight[9]) * (0.5 / width) ** 2
        diagonal[i] += both + steep + stiff * h0 * h0
        beside[i] += both - steep + stiff * h0 * h1
        diagonal[i + 1] += both + steep + stiff * h1 * h1
        rhs[i] += g0 - k * g2 - stiff * h0 * c
        rhs[i + 1] += g1 - k * g2 - stiff * h1 * c
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


def without_brakes(
    grid: Any, i: int, slope: Any, weight: Any, g2: float, g3: float, work: Any
) -> float:  # fmt: skip
    """Eliminate both brakes of an interval; return what is added to all places of its squares.

    Traction p = h·z + r' + f, the motors' brake r = r' − k (z₀ + z₁) and friction f are three
    springs in a row: the conditions on each make its stiffness, and that of the row is
    1/(1/ρ + 1/D_r + 1/D_f). Written so, nothing cancels where one is far stiffer than another.
    ``work.spring`` receives h₀, h₁, k, the stiffness and the pull of both brakes' own costs;
    ``work.kept[i]`` what gives the steps of the brakes.
    """
    effort = slope[2, 0] + slope[0, 0]
    pull = weight[0] + weight[1] + weight[2]
    part = weight[2] / pull
    spread: float = (pull - weight[2]) * part * effort * effort
    h0, h1 = slope[0, 0] - part * effort, slope[0, 1] - part * effort
    k = ease_r = ease_f = 0.0
    if grid.given[3]:
        hold = weight[3] + weight[4] + weight[5]
        part, limit = weight[5] / hold, slope[5, 0]
        spread += (hold - weight[5]) * part * limit * limit
        k, ease_r = -part * limit, 1.0 / hold
    if grid.given[6]:
        ease_f = 1.0 / (weight[6] + weight[7])
    ease = 1.0 / pull
    stiff = 1.0 / (ease + ease_r + ease_f)
    h0 -= k
    h1 -= k
    kept, spring = work.kept, work.spring
    kept[i, 0], kept[i, 1] = stiff * h0 * ease_r + k, stiff * h1 * ease_r + k
    kept[i, 2] = stiff * (g2 * (ease + ease_f) - g3 * ease_f) * ease_r
    kept[i, 3], kept[i, 4] = stiff * h0 * ease_f, stiff * h1 * ease_f
    kept[i, 5] = stiff * (g3 * (ease + ease_r) - g2 * ease_r) * ease_f
    spring[0], spring[1], spring[2], spring[3] = h0, h1, k, stiff
    spring[4] = g2 * ease_r + g3 * ease_f
    return spread


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
