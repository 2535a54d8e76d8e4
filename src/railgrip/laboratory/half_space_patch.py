"""The Hertzian patch on a grid: its cells, their pressure, and how they push each other.

All is said for one normal size: the semi-axis along the track is 1, the load is 1, the shear
modulus 1/π. A patch then depends on the shape of the ellipse and Poisson's ratio only, and serves
a whole sweep over creepage, friction, load and speed.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from railgrip.laboratory.half_space_grid import influence, smoothing, spectrum
from railgrip.laboratory.half_space_pressure import hertz_pressure

MARGIN = 2
"""Columns and rows left free on each side of the ellipse, into which the patch may grow."""


class HalfSpacePatch(NamedTuple):
    """One ellipse, divided into cells.

    Parameters
    ----------
    x, y : ndarray (along), (across)
        Centres of the cells; rolling goes towards +x [a].
    dx, dy : float
        Size of a cell [a].
    pressure : ndarray (across, along)
        Pressure in the cells, 0 outside the patch; it carries the load 1 [load/a²].
    is_inside : ndarray (across, along)
        Which cells belong to the patch.
    now : tuple
        Kernel of the displacement by tractions.
    before : tuple
        Kernel of the same particles' displacement one cell of rolling ago, by the tractions then.
    steady : tuple
        `now` less `before`: what slips in steady rolling.
    smoothing : ndarray
        About the inverse of `now`, for the preconditioner.
    self_now, self_steady : float
        What a cell does to itself in these kernels, mean of xx and yy [a].
    """

    x: Any
    y: Any
    dx: float
    dy: float
    pressure: Any
    is_inside: Any
    now: Any
    before: Any
    steady: Any
    smoothing: Any
    self_now: float
    self_steady: float


def half_space_patch(a: float, b: float, poisson: float, columns: int, rows: int) -> HalfSpacePatch:
    """Divide the ellipse into cells, with two columns and rows beyond it on each side.

    Parameters
    ----------
    a, b : float
        Semi-axes along and across the track, > 0; only their ratio matters [m].
    poisson : float
        Poisson's ratio, 0 … ½ [-].
    columns, rows : int
        Cells along and across; the ellipse takes `columns` − 4 by `rows` − 4 of them [-].

    Returns
    -------
    HalfSpacePatch
        Kept for the next call with the same shape and grid.

    Notes
    -----
    The pressure is not Hertz's ellipsoid sampled, but the solution of the normal problem on the
    same cells: the load is exact, and the patch is the one that the cells can represent. CONTACT
    does the same by default, which is what makes results on equal grids comparable.

    Examples
    --------
    >>> patch = half_space_patch(7.191978e-3, 5.409966e-3, 0.28, 48, 48)
    >>> int(patch.is_inside.sum()), round(float(patch.pressure.sum() * patch.dx * patch.dy), 9)
    (1532, 1.0)
    """
    return _patch(float(f"{b / a:.12g}"), poisson, columns, rows)


@lru_cache(maxsize=16)
def _patch(width: float, poisson: float, columns: int, rows: int) -> HalfSpacePatch:
    dx, dy = 2.0 / (columns - 2 * MARGIN), 2.0 * width / (rows - 2 * MARGIN)
    x = (np.arange(columns) - 0.5 * (columns - 1)) * dx
    y = (np.arange(rows) - 0.5 * (rows - 1)) * dy
    table = influence(rows, columns, dx, dy, poisson)
    pressure = hertz_pressure(x, y, width, table[3] / (1.0 - poisson))
    now = table[:3]
    before = np.zeros_like(now)
    before[:, :, :-1] = now[:, :, 1:]
    own = now[:, rows, columns] - before[:, rows, columns]
    return HalfSpacePatch(
        x=x,
        y=y,
        dx=dx,
        dy=dy,
        pressure=pressure,
        is_inside=pressure > 0.0,
        now=spectrum(now),
        before=spectrum(before),
        steady=spectrum(now - before),
        smoothing=smoothing(now),
        self_now=0.5 * float(now[0, rows, columns] + now[2, rows, columns]),
        self_steady=0.5 * float(own[0] + own[2]),
    )
