"""FASTSIM with all strips abreast: the same bits as strip by strip, many times as fast.

The march along a strip is a chain in which each cell waits for the one before. Strips do not wait
for each other, so here each row of cells across the patch is one loop, which LLVM turns into packed
arithmetic. What a strip carries from row to row stands in `work`, one column a strip.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from railgrip.contact.fastsim_1982 import fastsim_1982, fastsim_elliptic_1982
from railgrip.contact.fastsim_grid import (
    CELLS,
    Flexibilities,
    flexibilities,
    greatest_bound,
    next_traction,
    strip_at,
)
from railgrip.contact.modified_fastsim_2013 import (
    EUROSPRINTER_2013,
    modified_fastsim_2013,
    softened,
)
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import friction_force
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact

Y, EDGE, RISE_X, RISE_Y, TURNING, BOUND, TRACTION, ALONG, ACROSS, SUM_X, SUM_Y, SUM_M = range(12)
WORK_ROWS = 12


def set_out(
    work: Any, contact: RollingContact, limit: float, flexible: Flexibilities, creepage: Creepage,
    is_elliptic: bool,
) -> None:  # fmt: skip
    """Put every strip at its leading edge."""
    strips = np.uint64(work.shape[1])
    half = 0.5 * math.pi / work.shape[1]
    turn_cos, turn_sin = math.cos(2.0 * half), math.sin(2.0 * half)
    greatest = greatest_bound(contact, limit, half, is_elliptic)
    cos, sin = math.cos(half), math.sin(half)
    for j in range(strips):
        strip = strip_at(cos, sin, contact, greatest, flexible, creepage, is_elliptic)
        work[Y, j], work[EDGE, j] = strip.y, strip.edge
        work[RISE_X, j], work[RISE_Y, j] = strip.rise_x, strip.rise_y
        work[TURNING, j], work[BOUND, j] = strip.turning, strip.bound
        work[TRACTION, j] = work[ALONG, j] = work[ACROSS, j] = 0.0
        work[SUM_X, j] = work[SUM_Y, j] = work[SUM_M, j] = 0.0
        cos, sin = cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin


def march_row(work: Any, front: float, cos: float, sin: float, is_elliptic: bool) -> None:
    """Take every strip on to its next cell, at x = x_l cos θ."""
    step, middle = front - cos, 0.5 * (front + cos)
    shape = sin if is_elliptic else sin * sin
    for j in range(np.uint64(work.shape[1])):
        traction, along, across = next_traction(
            work[TRACTION, j],
            work[ALONG, j],
            work[ACROSS, j],
            step * work[RISE_X, j],
            step * (work[RISE_Y, j] + work[TURNING, j] * middle),
            work[BOUND, j] * shape,
        )
        work[TRACTION, j], work[ALONG, j], work[ACROSS, j] = traction, along, across
        weight = sin * traction
        work[SUM_X, j] += weight * along
        work[SUM_Y, j] += weight * across
        work[SUM_M, j] += weight * cos * across


def sum_up(work: Any, contact: RollingContact) -> CreepForce:
    """Forces and moment of all strips."""
    strips = np.uint64(work.shape[1])
    half = 0.5 * math.pi / work.shape[1]
    turn_cos, turn_sin = math.cos(2.0 * half), math.sin(2.0 * half)
    cos, sin = math.cos(half), math.sin(half)
    cell = 4.0 * half * sin * contact.a * contact.b
    force_x = force_y = moment = 0.0
    for j in range(strips):
        weight = sin * sin
        force_x += weight * work[SUM_X, j]
        force_y += weight * work[SUM_Y, j]
        moment += weight * (work[EDGE, j] * work[SUM_M, j] - work[Y, j] * work[SUM_X, j])
        cos, sin = cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin
    return CreepForce(cell * force_x, cell * force_y, cell * moment)


def fastsim_abreast(
    contact: RollingContact, limit: float, flexible: Flexibilities, creepage: Creepage,
    is_elliptic: bool, work: Any,
) -> CreepForce:  # fmt: skip
    """`fastsim_on_grid` with as many strips as `work` has columns, and as many cells in each."""
    set_out(work, contact, limit, flexible, creepage, is_elliptic)
    cells = work.shape[1]
    half = 0.5 * math.pi / cells
    turn_cos, turn_sin = math.cos(2.0 * half), math.sin(2.0 * half)
    cos, sin, front = math.cos(half), math.sin(half), 1.0
    for _ in range(cells):
        march_row(work, front, cos, sin, is_elliptic)
        front = cos
        cos, sin = cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin
    return sum_up(work, contact)


def _parabolic(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage, work: Any
) -> CreepForce:
    limit = friction_force(contact, rail, speed, creepage)
    return fastsim_abreast(contact, limit, flexibilities(contact), creepage, False, work)


def _elliptic(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage, work: Any
) -> CreepForce:
    limit = friction_force(contact, rail, speed, creepage)
    return fastsim_abreast(contact, limit, flexibilities(contact), creepage, True, work)


def _modified(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage, work: Any
) -> CreepForce:
    limit = friction_force(contact, rail, speed, creepage)
    flexible = softened(contact, limit, creepage, EUROSPRINTER_2013)
    return fastsim_abreast(contact, limit, flexible, creepage, False, work)


ABREAST = {
    fastsim_1982: _parabolic,
    fastsim_elliptic_1982: _elliptic,
    modified_fastsim_2013: _modified,
}
"""Law → the same law, bit for bit, that takes `work` as its last argument."""


def work_space(cells: int = CELLS) -> Any:
    """Return an array for what the strips carry, to be used again and again.

    Examples
    --------
    >>> work_space(50).shape
    (12, 50)
    """
    return np.zeros((WORK_ROWS, cells))
