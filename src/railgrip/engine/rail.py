"""The rail under the wheels: read as the axles before left it, heated and cleaned in passing.

Cells lie in a ring that is just longer than the train (or as long as the line, if the rail is to
be shown afterwards), so that a batch needs the same memory however far it runs. An axle reads a
cell once, when it enters it, and interpolates linearly between cell centres; what it gives to a
cell is read by the axles behind it only.
"""

from __future__ import annotations

import math
from typing import Any

from railgrip.compiler import compiled, inlined
from railgrip.core.constants import GRAVITY
from railgrip.core.formulas.elementary import exp_decay, power_2_3
from railgrip.engine import layout as at
from railgrip.engine import offsets as to
from railgrip.engine.offsets import width
from railgrip.track.cleaning import blended, left_contaminant
from railgrip.track.random_field import lognormal_factor, next_field_value, standard_normal
from railgrip.track.sanding import sanded_friction

_left = inlined(left_contaminant)
_blended = inlined(blended)
_sanded = inlined(sanded_friction)
_normal = inlined(standard_normal)
_next_field = inlined(next_field_value)
_factor = inlined(lognormal_factor)
_exp_decay = inlined(exp_decay)
_power_2_3 = inlined(power_2_3)


RAIL_STREAM = 1
FIRST_CELL_STREAM = 2
"""Streams of random numbers: the rail from cell to cell, and where its field begins."""


@compiled
def own_row(rows: int, run: float) -> int:
    """Return the row of a table that has one row for all runs, or one for each."""
    return int(run) if rows > 1 else 0


@compiled
def lay_rail(
    L: int, S: Any, energy: Any, factor: Any, sand: Any, way: Any, k: int, cell: int
) -> None:
    """Lay rail up to `cell` in front of the train, as an earlier run left it or fresh.

    Fresh rail has no energy yet, no sand, and a factor of its own.
    """
    mask = energy.shape[0] // L - 1
    front = int(S[at.RAIL_FRONT * L + k])
    field = S[at.FIELD * L + k]
    number = int(S[at.NUMBER * L + k])
    spread = way.relative_spread[own_row(way.relative_spread.shape[0], S[at.RUN * L + k])]
    while front < cell:
        front += 1
        slot = (front & mask) * L + k
        energy[slot] = 0.0
        sand[slot] = 0.0
        if 0 <= front < way.earlier_energy.shape[0]:
            energy[slot] = way.earlier_energy[front]
            sand[slot] = way.earlier_sand[front]
        if way.is_random == 1:
            for node in range(way.nodes_per_cell):
                place = way.first_node + front * way.nodes_per_cell + node
                normal = _normal(place, number, RAIL_STREAM, way.seed)
                field = _next_field(field, way.correlation, normal)
            factor[slot] = _factor(field, spread)
        else:
            factor[slot] = 1.0
    S[at.FIELD * L + k] = field
    S[at.RAIL_FRONT * L + k] = float(front)


@compiled
def field_before(way: Any, run: int, cell: int) -> float:
    """Return a standard normal number to begin the random field with, before its first cell."""
    place = way.first_node + cell * way.nodes_per_cell
    return float(_normal(place, run, FIRST_CELL_STREAM, way.seed))


@compiled
def read_cell(
    L: int, S: Any, energy: Any, factor: Any, sand: Any, conditions: Any, of_cell: Any,
    sand_friction: float, effective_sand: float, b: int, k: int, cell: int,
) -> None:  # fmt: skip
    """Take the friction state of a cell into AHEAD_*, as the axles before left it."""
    slot = (cell & (energy.shape[0] // L - 1)) * L + k
    row = of_cell[min(max(cell, 0), of_cell.shape[0] - 1)]
    rate = conditions[row, 2 * at.N_FRICTION]
    # a wheel that locks within a step may give a trace of energy back
    left = _left(max(energy[slot], 0.0), rate) if rate > 0.0 else 1.0
    for i in range(at.N_FRICTION):
        contaminated = conditions[row, i]
        clean = conditions[row, at.N_FRICTION + i]
        if i == 0:
            contaminated = contaminated * factor[slot]
            clean = max(clean, contaminated)
            if sand[slot] > 0.0:
                contaminated = _sanded(contaminated, sand[slot], sand_friction, effective_sand)
                clean = _sanded(clean, sand[slot], sand_friction, effective_sand)
        S[b + (at.BEHIND_FRICTION + i) * L + k] = S[b + (at.AHEAD_FRICTION + i) * L + k]
        S[b + (at.AHEAD_FRICTION + i) * L + k] = _blended(clean, contaminated, left)
        S[b + (at.CLEAN_FRICTION + i) * L + k] = clean
    S[b + at.CLEANING_RATE * L + k] = rate
    S[b + at.CLEANING * L + k] = 1.0 - left


@compiled
def heat_rail(L: int, S: Any, energy: Any, per_metre: float, b: int, k: int) -> None:
    """Give what an axle has rubbed since the last cell centre to the two cells it lay between."""
    mask = energy.shape[0] // L - 1
    cell = int(S[b + at.CELL * L + k])
    given = S[b + at.PENDING_ENERGY * L + k]
    energy[(cell & mask) * L + k] += 0.5 * given * per_metre
    energy[((cell + 1) & mask) * L + k] += 0.5 * given * per_metre
    S[at.RAIL_ENERGY * L + k] += given
    S[b + at.PENDING_ENERGY * L + k] = 0.0


@compiled
def enter_cells(
    L: int, S: Any, energy: Any, factor: Any, sand: Any, way: Any, n_axles: int, ahead: float,
    k: int,
) -> None:  # fmt: skip
    """Let the axles of a lane read the cells that they reach within a time `ahead`."""
    of_cell = way.condition_of_cell
    conditions = way.conditions[own_row(way.conditions.shape[0], S[at.RUN * L + k])]
    per_metre = 1.0 / way.cell_length
    front = (S[at.POSITION * L + k] + S[at.TRAIN_SPEED * L + k] * ahead - way.origin) * per_metre
    cell_ahead = math.floor(front) + 3
    if S[at.RAIL_FRONT * L + k] < cell_ahead:
        lay_rail(L, S, energy, factor, sand, way, k, cell_ahead)
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        place = front - S[b + at.OFFSET * L + k] * per_metre - 0.5
        cell = S[b + at.CELL * L + k]
        while cell + 1.0 <= place:
            heat_rail(L, S, energy, per_metre, b, k)
            cell += 1.0
            S[b + at.CELL * L + k] = cell
            read_cell(
                L, S, energy, factor, sand, conditions, of_cell,
                way.sand_friction, way.effective_sand, b, k, int(cell) + 1,
            )  # fmt: skip


@inlined
def rail_pass(lanes: Any, S: Any, b: int, origin: float, per_metre: float, ahead: float) -> None:
    """Set the friction state that acts in a tick, as it is in its middle.

    What the axle finds is interpolated between cell centres; then it cleans for itself too: with
    half of what it is giving to the rail, carried on to the middle of the tick.
    """
    L = width(lanes)
    for k in range(L):
        reach = S[b + to.HERE_POSITION * L + k] + S[b + to.HERE_SPEED * L + k] * ahead
        place = (reach - S[b + to.OFFSET * L + k] - origin) * per_metre - 0.5
        share = min(max(place - S[b + to.CELL * L + k], 0.0), 1.0)
        train_speed = S[b + to.HERE_SPEED * L + k]
        wheel_speed = S[b + to.WHEEL_SPEED * L + k]
        rolling = max(max(abs(train_speed), abs(wheel_speed)), 1e-3)
        own = 0.5 * abs(S[b + to.CONTACT_FORCE * L + k] * (wheel_speed - train_speed)) / rolling
        middle = max(1.5 * own - 0.5 * S[b + to.OWN_ENERGY * L + k], 0.0)
        left = _exp_decay(S[b + to.CLEANING_RATE * L + k] * middle)
        S[b + to.OWN_ENERGY * L + k] = own
        for i in range(to.N_FRICTION):
            behind = S[b + (to.BEHIND_FRICTION + i) * L + k]
            found = behind + share * (S[b + (to.AHEAD_FRICTION + i) * L + k] - behind)
            clean = S[b + (to.CLEAN_FRICTION + i) * L + k]
            S[b + (to.FOUND_FRICTION + i) * L + k] = found
            S[b + (to.RAIL_FRICTION + i) * L + k] = clean + left * (found - clean)
        # Hertz: the patch and with it Kalker's slope grow with load^(2/3)
        gain = S[b + to.LOAD_TRANSFER * L + k] * S[b + to.HERE_PITCH * L + k]
        load = 1.0 + gain / S[b + to.STATIC_LOAD * L + k]
        S[b + to.SLOPE * L + k] = S[b + to.KALKER_SLOPE * L + k] * _power_2_3(load)


@compiled
def lay_sand(
    L: int, S: Any, sand: Any, n_axles: int, origin: float, cell_length: float, tick: float,
    delay: float, least_speed: float, k: int,
) -> None:  # fmt: skip
    """Lay the axles' sand in front of each wheel, by length, after the sander's delay.

    In front means two cells ahead: the wheel itself then finds it when it gets there.
    """
    mask = sand.shape[0] // L - 1
    per_metre = 1.0 / cell_length
    moved = (S[at.POSITION * L + k] - S[at.POSITION_BEFORE * L + k]) * per_metre
    if S[at.TRAIN_SPEED * L + k] <= least_speed or moved <= 0.0:
        return
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        flow = S[b + at.SANDER_FLOW * L + k]
        if flow > 0.0 and S[b + at.SAND_TIME * L + k] * tick > delay:
            place = S[at.POSITION * L + k] - S[b + at.OFFSET * L + k] - origin
            last = place * per_metre + 2.0
            first = last - moved
            cell = math.floor(first)
            within = min((float(cell + 1) - first) / moved, 1.0)
            laid = flow * tick * per_metre
            sand[(cell & mask) * L + k] += within * laid
            sand[((cell + 1) & mask) * L + k] += (1.0 - within) * laid


@compiled
def line_forces(L: int, S: Any, way: Any, formation: Any, ahead: float, k: int) -> None:
    """Gradient and curve force on the train, each vehicle a strip of mass."""
    elevation, curve_work = way.elevation, way.curve_work
    front = S[at.POSITION * L + k] + S[at.TRAIN_SPEED * L + k] * ahead - way.origin
    shares = formation.vehicle_share[own_row(formation.vehicle_share.shape[0], S[at.RUN * L + k])]
    slope = 0.0
    curve = 0.0
    for vehicle in range(formation.vehicle_front.shape[0]):
        near = (front - formation.vehicle_front[vehicle]) / way.elevation_step
        far = near - formation.vehicle_length[vehicle] / way.elevation_step
        share = shares[vehicle] / formation.vehicle_length[vehicle]
        slope += share * (_interpolate(elevation, near) - _interpolate(elevation, far))
        curve += share * (_interpolate(curve_work, near) - _interpolate(curve_work, far))
    weight = S[at.TRAIN_MASS * L + k] * GRAVITY
    S[at.GRADIENT_FORCE * L + k] = weight * slope
    S[at.CURVE_FORCE * L + k] = weight * curve


@compiled
def _interpolate(heights: Any, place: float) -> float:
    place = min(max(place, 0.0), heights.shape[0] - 1.000001)
    i = int(place)
    return float(heights[i] + (place - i) * (heights[i + 1] - heights[i]))
