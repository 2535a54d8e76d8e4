"""The rail under the wheels: read as the axles before left it, heated and cleaned in passing.

Cells lie in a ring that is just longer than the train (or as long as the run, if the rail is to
be shown afterwards), so that a batch needs the same memory however far it runs. An axle reads a
cell once, when it enters it, and interpolates linearly between cell centres; what it gives to a
cell is read by the axles behind it only.
"""

from __future__ import annotations

import math
from typing import Any

import numba

from railgrip.core.constants import GRAVITY
from railgrip.engine import layout as at
from railgrip.engine.compiler import inlined
from railgrip.track.cleaning import blended, left_contaminant
from railgrip.track.random_field import lognormal_factor, next_field_value, standard_normal
from railgrip.track.sanding import sanded_friction

_left = inlined(left_contaminant)
_blended = inlined(blended)
_sanded = inlined(sanded_friction)
_normal = inlined(standard_normal)
_next_field = inlined(next_field_value)
_factor = inlined(lognormal_factor)

_scalar = numba.njit(error_model="numpy")
_lanes = numba.njit(forceinline=True, error_model="numpy")

RAIL_STREAM = 1
FIRST_CELL_STREAM = 2
"""Streams of random numbers: the rail from cell to cell, and where its field begins."""


@_scalar
def lay_rail(L: int, S: Any, memory: Any, way: Any, k: int, cell: int) -> None:
    """Lay fresh rail up to `cell` in front of the train: no energy yet, no sand, its own factor."""
    mask = memory.ring_energy.shape[0] // L - 1
    front = int(S[at.RAIL_FRONT * L + k])
    while front < cell:
        front += 1
        slot = (front & mask) * L + k
        memory.ring_energy[slot] = 0.0
        memory.ring_sand[slot] = 0.0
        factor = 1.0
        if way.is_random == 1:
            run = int(S[at.RUN * L + k])
            normal = _normal(front, run, RAIL_STREAM, way.seed)
            field = _next_field(S[at.FIELD * L + k], way.correlation, normal)
            S[at.FIELD * L + k] = field
            factor = _factor(field, way.relative_spread)
        memory.ring_factor[slot] = factor
    S[at.RAIL_FRONT * L + k] = float(front)


@_scalar
def field_before(way: Any, run: int, cell: int) -> float:
    """Return a standard normal number to begin the random field with, before its first cell."""
    return float(_normal(cell, run, FIRST_CELL_STREAM, way.seed))


@_scalar
def _read_cell(L: int, S: Any, memory: Any, way: Any, b: int, k: int, cell: int) -> None:
    """Take the friction state of a cell into AHEAD_*, as the axles before left it."""
    slot = (cell & (memory.ring_energy.shape[0] // L - 1)) * L + k
    last = way.condition_of_cell.shape[0] - 1
    row = way.conditions[way.condition_of_cell[min(max(cell, 0), last)]]
    left = _left(memory.ring_energy[slot], row[10])
    factor = memory.ring_factor[slot]
    sand = memory.ring_sand[slot]
    for i in range(at.N_FRICTION):
        contaminated = row[i]
        clean = row[at.N_FRICTION + i]
        if i == 0:
            contaminated = contaminated * factor
            clean = max(clean, contaminated)
            if sand > 0.0:
                contaminated = _sanded(contaminated, sand, way.sand_friction, way.effective_sand)
                clean = _sanded(clean, sand, way.sand_friction, way.effective_sand)
        S[b + (at.AHEAD_FRICTION + i) * L + k] = _blended(clean, contaminated, left)
        S[b + (at.CLEAN_FRICTION + i) * L + k] = clean
    S[b + at.CLEANING_RATE * L + k] = row[10]
    S[b + at.CLEANING * L + k] = 1.0 - left


@_scalar
def enter_cells(L: int, S: Any, memory: Any, way: Any, n_axles: int, k: int, h: float) -> None:
    """Find the rail under each axle of a lane at the end of the coming tick."""
    train_end = S[at.POSITION * L + k] + S[at.TRAIN_SPEED * L + k] * h
    ahead = int(math.floor((train_end - way.origin) / way.cell_length)) + 3
    lay_rail(L, S, memory, way, k, ahead)
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        place = (train_end - S[b + at.OFFSET * L + k] - way.origin) / way.cell_length - 0.5
        cell = S[b + at.CELL * L + k]
        while cell + 1.0 <= place:
            cell += 1.0
            for i in range(at.N_FRICTION):
                S[b + (at.BEHIND_FRICTION + i) * L + k] = S[b + (at.AHEAD_FRICTION + i) * L + k]
            _read_cell(L, S, memory, way, b, k, int(cell) + 1)
        S[b + at.CELL * L + k] = cell


@_lanes
def interpolate_rail(L: int, S: Any, way: Any, b: int, h: float) -> None:
    """Set the friction state for the end of the tick; the old end is the new start."""
    for k in range(L):
        train_end = S[at.POSITION * L + k] + S[at.TRAIN_SPEED * L + k] * h
        place = (train_end - S[b + at.OFFSET * L + k] - way.origin) / way.cell_length - 0.5
        share = min(max(place - S[b + at.CELL * L + k], 0.0), 1.0)
        for i in range(at.N_FRICTION):
            behind = S[b + (at.BEHIND_FRICTION + i) * L + k]
            ahead = S[b + (at.AHEAD_FRICTION + i) * L + k]
            S[b + (at.RAIL_FRICTION + i) * L + k] = S[b + (at.RAIL_END_FRICTION + i) * L + k]
            S[b + (at.RAIL_END_FRICTION + i) * L + k] = behind + share * (ahead - behind)


@_scalar
def heat_rail(
    L: int, S: Any, memory: Any, way: Any, b: int, k: int, start: float, energy: float
) -> None:
    """Give the axle's friction energy of a tick to the cells it passed, by length."""
    mask = memory.ring_energy.shape[0] // L - 1
    offset = S[b + at.OFFSET * L + k]
    first = (start - offset - way.origin) / way.cell_length
    last = (S[at.POSITION * L + k] - offset - way.origin) / way.cell_length
    cell = int(math.floor(first))
    edge = float(cell) + 1.0
    within = 1.0
    if last > edge:
        within = (edge - first) / (last - first)
        memory.ring_energy[((cell + 1) & mask) * L + k] += (
            (1.0 - within) * energy / way.cell_length
        )
    memory.ring_energy[(cell & mask) * L + k] += within * energy / way.cell_length
    S[b + at.RAIL_ENERGY * L + k] += energy


@_scalar
def lay_sand(L: int, S: Any, memory: Any, way: Any, b: int, k: int, h: float) -> None:
    """Lay an axle's sand on the cell in front of its wheel, after the sander's delay."""
    mask = memory.ring_energy.shape[0] // L - 1
    cell = int(S[b + at.CELL * L + k]) + 2
    mass = S[b + at.SANDER_FLOW * L + k] * h
    memory.ring_sand[(cell & mask) * L + k] += mass / way.cell_length


@_scalar
def line_forces(L: int, S: Any, plan: Any, k: int, h: float) -> None:
    """Gradient and curve force on the train, each vehicle a strip of mass, at the tick's end."""
    way = plan.way
    formation = plan.formation
    front = S[at.POSITION * L + k] + S[at.TRAIN_SPEED * L + k] * h - way.origin
    slope = 0.0
    curve = 0.0
    for vehicle in range(formation.vehicle_front.shape[0]):
        near = front - formation.vehicle_front[vehicle]
        far = near - formation.vehicle_length[vehicle]
        share = formation.vehicle_share[vehicle] / formation.vehicle_length[vehicle]
        slope += share * (_height(way.elevation, way, near) - _height(way.elevation, way, far))
        curve += share * (_height(way.curve_work, way, near) - _height(way.curve_work, way, far))
    weight = S[at.TRAIN_MASS * L + k] * GRAVITY
    S[at.GRADIENT_FORCE * L + k] = S[at.GRADIENT_FORCE_END * L + k]
    S[at.GRADIENT_FORCE_END * L + k] = weight * slope
    S[at.CURVE_FORCE * L + k] = weight * curve


@_scalar
def _height(heights: Any, way: Any, distance: float) -> float:
    place = min(max(distance / way.elevation_step, 0.0), heights.shape[0] - 1.000001)
    i = int(place)
    return float(heights[i] + (place - i) * (heights[i + 1] - heights[i]))
