"""Newton's method on the conditions of the optimum (primal–dual interior point).

The multipliers of the motion are the costates of the maximum principle, that of the time is its
price. Each condition's slack times its multiplier is driven to nothing together with the rest, so
that traction, cruising, coasting and braking, and where they change, come out by themselves.
"""

from __future__ import annotations

from typing import Any

from railgrip.campaign.optimum.conditions import CONDITIONS, conditions
from railgrip.campaign.optimum.linear import LATE, assemble, direction
from railgrip.compiler import entry

FOUND, TOO_MANY, FAILED = 0, 1, 2
TIGHT = 1e-7
"""Complementarity left over, as a share of the energy."""
PRICED = 1e-5
"""The price of time is read while complementarity is above this share of the energy."""
FIT = 1e-6
"""Misfit of a condition left over, m/s² (and tens of seconds)."""
AHEAD = 0.05
"""Complementarity over the energy stays above this share of the misfit: where it vanishes before
the conditions hold, steps become short."""
LITTLE = 0.05
"""The energy, as a force over the way, m/s², below which tolerances do not fall with it."""
NEARLY = 10.0
"""Times the tolerances: where rounding lets no step get further, this is near enough."""
MOST = 200
STUCK = 1e-5
"""Steps that the nearest condition cuts to less than this, five times running, lead nowhere."""
FAR = 1e4
"""By how much complementarity of a pair may differ from the one aimed at."""
CLOSE = 0.99
"""How much of the way to the nearest condition a step goes."""


def begin(grid: Any, point: Any, work: Any, target: float, spare: float) -> None:
    """Fill slacks and multipliers for a first guess of squares and brakes."""
    n = grid.width.shape[0]
    way = 0.0
    for i in range(n):
        way += grid.width[i]
    aim = 0.05 * way / n
    for i in range(n):
        conditions(grid, i, point.square, point.motor[i], point.friction[i], work)
        for j in range(CONDITIONS):
            point.slack[i, j] = max(work.value[j], 0.02)
            point.dual[i, j] = aim / point.slack[i, j]
    for k in range(n + 1):
        # the guess keeps the lower bound, and so do all that follow: no square becomes negative
        point.room[k, 0] = point.square[k] - work.edge[k, 0]
        point.room[k, 1] = max(work.edge[k, 1] - point.square[k], 0.02)
        point.press[k, 0] = aim / point.room[k, 0]
        point.press[k, 1] = aim / point.room[k, 1]
    if target > 0.0:
        point.clock[0] = max(spare, 0.01 * target)
        point.clock[1] = LATE + 10.0 * aim / point.clock[0]


def lengths(grid: Any, point: Any, work: Any, target: float, aim: float) -> None:
    """Fill the steps of everything else and, in ``work.reach``, how far they may go."""
    n = grid.width.shape[0]
    z, dz = point.square, work.d_square
    primal = dual = 1.0
    for i in range(n):
        kept = work.kept
        dr = -(kept[i, 2] + kept[i, 0] * dz[i] + kept[i, 1] * dz[i + 1])
        df = -(kept[i, 5] + kept[i, 3] * dz[i] + kept[i, 4] * dz[i + 1])
        if not grid.given[3]:
            dr = 0.0
        if not grid.given[6]:
            df = 0.0
        work.d_motor[i], work.d_friction[i] = dr, df
        conditions(grid, i, z, point.motor[i], point.friction[i], work)
        for j in range(CONDITIONS):
            if not grid.given[j]:
                continue
            slope, s, y = work.gradient, point.slack[i, j], point.dual[i, j]
            ds = slope[j, 0] * dz[i] + slope[j, 1] * dz[i + 1] + slope[j, 2] * dr
            ds += slope[j, 3] * df + work.value[j] - s
            dy = (aim - s * y - y * ds) / s
            work.d_slack[i, j], work.d_dual[i, j] = ds, dy
            if ds < 0.0:
                primal = min(primal, -s / ds)
            if dy < 0.0:
                dual = min(dual, -y / dy)
    for k in range(1, n):
        for side in range(2):
            sign = 1.0 if side == 0 else -1.0
            s, y = point.room[k, side], point.press[k, side]
            ds = sign * (z[k] + dz[k] - work.edge[k, side]) - s
            dy = (aim - s * y - y * ds) / s
            work.d_room[k, side], work.d_press[k, side] = ds, dy
            if ds < 0.0:
                primal = min(primal, -s / ds)
            if dy < 0.0:
                dual = min(dual, -y / dy)
    work.d_clock[0] = work.d_clock[1] = 0.0
    if target > 0.0:
        s, y = point.clock[0], point.clock[1]
        ds = target - work.found[1] - s
        for k in range(1, n):
            ds -= work.by_time[k] * dz[k]
        dy = (aim - s * y - y * ds) / s
        work.d_clock[0], work.d_clock[1] = ds, dy
        if ds < 0.0:
            primal = min(primal, -s / ds)
        if dy < 0.0:
            dual = min(dual, -y / dy)
    work.reach[0], work.reach[1] = primal, dual


def gap_ahead(grid: Any, point: Any, work: Any, target: float) -> float:
    """Return the complementarity that the whole step would leave."""
    n = grid.width.shape[0]
    primal, dual = work.reach[0], work.reach[1]
    gap = 0.0
    for i in range(n):
        for j in range(CONDITIONS):
            if grid.given[j]:
                slack = point.slack[i, j] + primal * work.d_slack[i, j]
                gap += slack * (point.dual[i, j] + dual * work.d_dual[i, j])
    for k in range(1, n):
        for side in range(2):
            room = point.room[k, side] + primal * work.d_room[k, side]
            gap += room * (point.press[k, side] + dual * work.d_press[k, side])
    if target > 0.0:
        spare = point.clock[0] + primal * work.d_clock[0]
        gap += spare * (point.clock[1] + dual * work.d_clock[1])
    return gap


def move(grid: Any, point: Any, work: Any, target: float, aim: float) -> None:
    """Go the step, short of the nearest condition, and keep every pair near its complementarity."""
    n = grid.width.shape[0]
    primal, dual = min(1.0, CLOSE * work.reach[0]), min(1.0, CLOSE * work.reach[1])
    for i in range(n):
        point.motor[i] += primal * work.d_motor[i]
        point.friction[i] += primal * work.d_friction[i]
        for j in range(CONDITIONS):
            if grid.given[j]:
                point.slack[i, j] += primal * work.d_slack[i, j]
                y = point.dual[i, j] + dual * work.d_dual[i, j]
                point.dual[i, j] = kept_near(y, point.slack[i, j], aim)
    for k in range(1, n):
        point.square[k] += primal * work.d_square[k]
        for side in range(2):
            point.room[k, side] += primal * work.d_room[k, side]
            y = point.press[k, side] + dual * work.d_press[k, side]
            point.press[k, side] = kept_near(y, point.room[k, side], aim)
    point.clock[0] += primal * work.d_clock[0]
    point.clock[1] += dual * work.d_clock[1]
    if target > 0.0:
        point.clock[1] = kept_near(point.clock[1], point.clock[0], aim)


def kept_near(dual: float, slack: float, aim: float) -> float:
    """Return a multiplier that is neither lost nor runs away: a lost one hardly moves again."""
    return min(max(dual, aim / (FAR * slack)), FAR * aim / slack)


def _newton(grid: Any, point: Any, work: Any, target: float, spare: float) -> int:
    """Find the optimum from a first guess; ``target`` 0 takes ``point.clock[1]`` as given.

    ``spare`` is the time that the guess leaves. Returns how it ended; squares and brakes are in
    ``point``, energy and time in ``work.found``.
    """
    begin(grid, point, work, target, spare)
    work.d_square[0] = work.d_square[grid.width.shape[0]] = work.lifted[0] = 0.0
    stuck, way = 0, 0.0
    for i in range(grid.width.shape[0]):
        way += grid.width[i]
    for _ in range(MOST):
        assemble(grid, point, work, target, 0.0)
        energy, misfit, gap, count = work.found[0], work.found[2], work.found[3], work.found[4]
        scale = max(abs(energy), LITTLE * way)
        if not gap < 1e30:
            return 2
        if gap > PRICED * scale:
            # once time asked for and time left are both rounding, their ratio is none to read
            work.price[0] = point.clock[1] - (LATE if target > 0.0 else 0.0)
        if misfit < FIT and gap < TIGHT * scale:
            return 0
        if not direction(grid, point, work, target):
            return 2
        lengths(grid, point, work, target, 0.0)
        share = gap_ahead(grid, point, work, target) / gap
        share = min(max(share * share, 0.05), 0.8)
        least = max(0.2 * TIGHT, AHEAD * min(misfit, 1.0)) * scale / count
        aim = max(share * gap / count, min(least, gap / count))
        assemble(grid, point, work, target, aim)
        if not direction(grid, point, work, target):
            return 2
        lengths(grid, point, work, target, aim)
        stuck = stuck + 1 if work.reach[0] < STUCK else 0
        if stuck > 4:
            return 0 if misfit < NEARLY * FIT and gap < NEARLY * TIGHT * scale else 2
        move(grid, point, work, target, aim)
    return 1


newton = entry(_newton)
