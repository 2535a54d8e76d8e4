"""How cells on a half-space push each other, as convolutions by fast Fourier transform."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import fft

from railgrip.compiler import entry
from railgrip.contact.half_space import rectangle_influence


def influence(rows: int, columns: int, dx: float, dy: float, poisson: float) -> Any:
    """Displacement of a cell by a unit load on a cell so many columns and rows away.

    Parameters
    ----------
    rows, columns : int
        Cells across and along the track [-].
    dx, dy : float
        Size of a cell [m].
    poisson : float
        Poisson's ratio [-].

    Returns
    -------
    ndarray (4, 2 rows + 1, 2 columns + 1)
        xx, xy, yy, zz of `rectangle_influence`, no distance in the middle [m].
    """
    table = np.empty((4, 2 * rows + 1, 2 * columns + 1))
    _fill(table, rows, columns, dx, dy, poisson)
    return table


def _fill_plain(table: Any, rows: int, columns: int, dx: float, dy: float, poisson: float) -> None:
    for i in range(2 * rows + 1):
        for j in range(2 * columns + 1):
            push = rectangle_influence((j - columns) * dx, (i - rows) * dy, dx, dy, poisson)
            table[0, i, j] = push.xx
            table[1, i, j] = push.xy
            table[2, i, j] = push.yy
            table[3, i, j] = push.zz


_fill = entry(_fill_plain)


def spectrum(table: Any) -> Any:
    """Return the transform of an influence table for `convolve`, zeros around it."""
    rows, columns = (table.shape[-2] - 1) // 2, (table.shape[-1] - 1) // 2
    height, width = (fft.next_fast_len(2 * count, real=True) for count in (rows, columns))
    turned = np.zeros((*table.shape[:-2], height, width))
    turned[..., :rows, :columns] = table[..., rows:-1, columns:-1]
    turned[..., :rows, -columns:] = table[..., rows:-1, :columns]
    turned[..., -rows:, :columns] = table[..., :rows, columns:-1]
    turned[..., -rows:, -columns:] = table[..., :rows, :columns]
    return fft.rfft2(turned), (height, width)


def convolve(kernel: Any, load: Any) -> Any:
    """Return the displacement by tractions (2, across, along), or by a pressure (across, along)."""
    transform, size = kernel
    rows, columns = load.shape[-2:]
    loads = fft.rfft2(load, s=size)
    if load.ndim == 2:
        return fft.irfft2(transform * loads, s=size)[:rows, :columns]
    return fft.irfft2(_mixed(transform, loads), s=size)[:, :rows, :columns]


def smoothing(table: Any) -> Any:
    """Return what turns displacements back into loads on a grid that repeats itself.

    It is the preconditioner's: nearly the inverse of `convolve`, in the middle of the patch.
    """
    rows, columns = (table.shape[-2] - 1) // 2, (table.shape[-1] - 1) // 2
    across = np.fft.fftfreq(rows, 1.0 / rows).astype(int) + rows
    along = np.fft.fftfreq(columns, 1.0 / columns).astype(int) + columns
    transform = fft.rfft2(table[..., across[:, None], along[None, :]]).real
    if table.ndim == 2:
        return 1.0 / transform
    xx, xy, yy = transform
    return np.stack([yy, -xy, xx]) / (xx * yy - xy * xy)


def smooth(inverse: Any, displacement: Any) -> Any:
    """Return about the loads behind a displacement; `inverse` from `smoothing`."""
    size = displacement.shape[-2:]
    moved = fft.rfft2(displacement)
    if displacement.ndim == 2:
        return fft.irfft2(inverse * moved, s=size)
    return fft.irfft2(_mixed(inverse, moved), s=size)


def _mixed(matrix: Any, vector: Any) -> Any:
    """Product of the symmetric 2 × 2 matrix (xx, xy, yy) with a vector, at each frequency."""
    xx, xy, yy = matrix
    out = np.empty_like(vector)
    out[0] = xx * vector[0] + xy * vector[1]
    out[1] = xy * vector[0] + yy * vector[1]
    return out
