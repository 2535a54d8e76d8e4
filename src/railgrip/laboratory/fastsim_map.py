"""Traction, slip, stick and slip zones within the patch, by FASTSIM."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.compiler import entry
from railgrip.contact.fastsim_grid import CELLS, flexibilities
from railgrip.contact.modified_fastsim_2013 import SlopeReduction, softened
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import friction_force
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.laboratory.fastsim_strips import (
    ACROSS,
    ALONG,
    BOUND,
    EDGE,
    TRACTION,
    Y,
    march_row,
    set_out,
    sum_up,
    work_space,
)  # fmt: skip
from railgrip.laboratory.inputs import FloatArray, refuse_bad_values

BOUNDS = ("parabolic", "elliptic")


class FastsimMap(NamedTuple):
    """What happens in each cell: rows from the leading to the trailing edge, columns strips.

    Parameters
    ----------
    x, y : ndarray
        Centres of the cells, x in the direction of rolling, y to its left [m].
    bound : ndarray
        Greatest traction, friction times pressure [Pa].
    traction_x, traction_y : ndarray
        Traction of the rail on the wheel, with the sign of the forces [Pa].
    slip_x, slip_y : ndarray
        Slip of wheel on rail over the speed of the train, with the sign of the creepages [-].
    is_slipping : ndarray of bool
        Where friction does not hold.
    forces : CreepForce
        Sum over all cells.
    """

    x: FloatArray
    y: FloatArray
    bound: FloatArray
    traction_x: FloatArray
    traction_y: FloatArray
    slip_x: FloatArray
    slip_y: FloatArray
    is_slipping: NDArray[np.bool_]
    forces: CreepForce


def fastsim_map(
    contact: RollingContact,
    rail: RailFriction,
    speed: float,
    creepage: Creepage,
    *,
    cells: int = CELLS,
    bound: str = "parabolic",
    reduction: SlopeReduction | None = None,
) -> FastsimMap:
    """Map of one patch under creepages and spin.

    Parameters
    ----------
    contact : RollingContact
        The contact.
    rail : RailFriction
        State of the rail; its friction at the slip speed of the centre holds in the whole patch.
    speed : float
        Speed of the train, > 0 [m/s].
    creepage : Creepage
        Longitudinal and lateral creepage and spin.
    cells : int
        Strips, and cells in each, 2 … 2000.
    bound : {"parabolic", "elliptic"}
        Shape of the traction bound.
    reduction : SlopeReduction, optional
        For modified FASTSIM.

    Returns
    -------
    FastsimMap
        Maps of shape (cells, cells), and the forces: the bits of `fastsim_on_grid`.

    Raises
    ------
    RailgripError
        ``traction bound 'elliptical' unknown; …``; for a load, a speed or creepages out of range.

    Notes
    -----
    See `railgrip.contact.fastsim_grid`. Cells are narrow at the edges; draw them with the
    coordinates given. Slip is what the sticking traction would have risen by more than it did,
    times the flexibility of its direction, over the length of the step: the mean over the step
    from the cell in front.

    Examples
    --------
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> patch = fastsim_map(base, rail, 20.0, Creepage(0.001, 0.0, 0.0))
    >>> bool(patch.is_slipping[0, 25]), bool(patch.is_slipping[-1].all())
    (False, True)
    """
    _refuse_bad_input(contact, speed, creepage, cells, bound)
    is_elliptic = bound == "elliptic"
    limit = friction_force(contact, rail, speed, creepage)
    flexible = flexibilities(contact)
    if reduction is not None:
        flexible = softened(contact, limit, creepage, reduction)
    maps = np.empty((7, cells, cells))
    is_slipping = np.empty((cells, cells), dtype=np.bool_)
    forces = march(
        contact, limit, flexible, creepage, is_elliptic, work_space(cells), maps, is_slipping
    )
    x, y, limits, traction_x, traction_y, slip_x, slip_y = maps
    return FastsimMap(
        x, y, limits, traction_x, traction_y, slip_x, slip_y, is_slipping, CreepForce(*forces)
    )


@entry
def march(
    contact: Any, limit: float, flexible: Any, creepage: Any, is_elliptic: bool,
    work: Any, maps: Any, is_slipping: Any,
) -> CreepForce:  # fmt: skip
    """Fill the caller's maps (x, y, bound, traction x, y, slip x, y) and return the forces."""
    set_out(work, contact, limit, flexible, creepage, is_elliptic)
    cells = np.uint64(work.shape[1])
    half = 0.5 * math.pi / work.shape[1]
    turn_cos, turn_sin = math.cos(2.0 * half), math.sin(2.0 * half)
    cos, sin, front = math.cos(half), math.sin(half), 1.0
    for i in range(cells):
        step, middle = front - cos, 0.5 * (front + cos)
        for j in range(cells):
            maps[3, i, j] = work[TRACTION, j] * work[ALONG, j]
            maps[4, i, j] = work[TRACTION, j] * work[ACROSS, j]
        march_row(work, front, cos, sin, is_elliptic)
        for j in range(cells):
            edge, y = work[EDGE, j], work[Y, j]
            greatest = work[BOUND, j] * (sin if is_elliptic else sin * sin)
            traction_x = work[TRACTION, j] * work[ALONG, j]
            traction_y = work[TRACTION, j] * work[ACROSS, j]
            slips = work[TRACTION, j] >= greatest
            length = step * edge
            turn = creepage.spin / flexible.spin
            rise_x = creepage.longitudinal / flexible.longitudinal - turn * y
            rise_y = creepage.lateral / flexible.lateral + turn * edge * middle
            less_x = rise_x - (traction_x - maps[3, i, j]) / length
            less_y = rise_y - (traction_y - maps[4, i, j]) / length
            maps[0, i, j], maps[1, i, j], maps[2, i, j] = edge * cos, y, greatest
            maps[3, i, j], maps[4, i, j] = traction_x, traction_y
            maps[5, i, j] = less_x * flexible.longitudinal if slips else 0.0
            maps[6, i, j] = less_y * flexible.lateral if slips else 0.0
            is_slipping[i, j] = slips
        front = cos
        cos, sin = cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin
    return sum_up(work, contact)


def _refuse_bad_input(
    contact: RollingContact, speed: float, creepage: Creepage, cells: int, bound: str
) -> None:
    for name, value, unit in (("load", contact.load, "N"), ("speed", speed, "m/s")):
        refuse_bad_values(name, np.asarray(value, dtype=np.float64), unit, positive=True)
    for name, value, unit in (
        ("longitudinal creepage", creepage.longitudinal, ""),
        ("lateral creepage", creepage.lateral, ""),
        ("spin", creepage.spin, "1/m"),
    ):
        refuse_bad_values(name, np.asarray(value, dtype=np.float64), unit, positive=False)
    if bound not in BOUNDS:
        raise RailgripError(unknown_name("", "traction bound", bound, BOUNDS))
    if not 2 <= cells <= 2000:
        raise RailgripError(
            Problem("", "the number of cells is out of range", got=f"{cells}", allowed="2 … 2000")
        )
