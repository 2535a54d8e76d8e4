"""The curve of a creep table: a quadratic spline over a bounded variable, and its look-up."""

from __future__ import annotations

import numpy as np

from railgrip.laboratory.inputs import FloatArray

LEAST_FORCE = 1e-100
"""Floor of slope times creepage, so that a wheel that does not creep divides nothing by zero."""


def cell_of(place: float, cells: float) -> np.uint64:
    """Number of the cell that holds a place from 0 to `cells`; the nearest where none does.

    Examples
    --------
    >>> [int(cell_of(place, 4.0)) for place in (-1.0, 2.5, 4.0, float("nan"))]
    [0, 2, 3, 3]
    """
    # in this order NaN becomes a place within the table
    held = place if place < cells - 1.0 else cells - 1.0
    held = held if held > 0.0 else 0.0
    # 32 bits: any processor converts these several at a time; unsigned: no place lies in front
    return np.uint64(np.uint32(np.int32(held)))


def spline_value(first: float, middle: float, last: float, t: float) -> float:
    """Value of a quadratic spline in a cell, with its three coefficients, at t = 0 … 1.

    Examples
    --------
    >>> spline_value(0.0, 1.0, 2.0, 0.5)
    1.0
    """
    bend = 0.5 * (first - middle - middle + last)
    return 0.5 * (first + middle) + t * ((middle - first) + t * bend)


def chord_by_table(table: FloatArray, limit: float, slope: float, creepage: float) -> float:
    """Creep force over creepage, by a table of one curve.

    Choose it inside kernels: a look-up without search or branch. From Python, `CreepTable` reads
    more easily.

    Parameters
    ----------
    table : ndarray (cells + 2)
        Coefficients of the curve, from `spline_coefficients`.
    limit : float
        Friction force μQ, ≥ 0 [N].
    slope : float
        Initial slope of linear theory C = G a b C11 [N per unit creepage].
    creepage : float
        Magnitude of the longitudinal creepage, ≥ 0 [-].

    Returns
    -------
    float
        F/s ≥ 0, so that F ≤ μQ [N per unit creepage]; NaN where an argument is.

    Notes
    -----
    With f = C s/(μQ) and u = f/(1 + f) the table holds χ(u) = F/(μQ u). It is the law's initial
    slope over C at u = 0 and 1 at u = 1, and smooth between them; so F/s = C χ/(1 + f) is as exact
    for a small creepage as for a large one. It is computed with y = 1/f, which is zero, not
    infinite, where there is no friction. χ is a quadratic spline with even knots: continuous with
    its first derivative, and so is the chord.

    Examples
    --------
    >>> float(chord_by_table(np.ones(6), 30e3, 15e6, 0.002))
    7500000.0
    """
    cells = float(table.shape[0] - 2)
    y = limit / max(slope * creepage, LEAST_FORCE)
    u = 1.0 / (1.0 + y)
    cell = cell_of(u * cells, cells)
    chi = spline_value(
        table[cell],
        table[cell + np.uint64(1)],
        table[cell + np.uint64(2)],
        u * cells - np.float64(cell),
    )
    return slope * (y * min(u * chi, 1.0))


def sample_places(cells: int) -> FloatArray:
    """Places u where a spline of so many cells takes its values: both ends, the middles of cells.

    Examples
    --------
    >>> sample_places(2).tolist()
    [0.0, 0.25, 0.75, 1.0]
    """
    middles = (np.arange(cells) + 0.5) / cells
    return np.concatenate([[0.0], middles, [1.0]])


def places_between(cells: int) -> FloatArray:
    """Places u where a spline is farthest from a smooth curve: at (1 ± 1/√3)/2 of each cell.

    Examples
    --------
    >>> places_between(1).round(4).tolist()
    [0.2113, 0.7887]
    """
    aside = 0.5 / np.sqrt(3.0)
    both = np.arange(cells)[:, None] + np.array([0.5 - aside, 0.5 + aside])
    places: FloatArray = both.ravel() / cells
    return places


def spline_coefficients(values: FloatArray) -> FloatArray:
    """Coefficients of the quadratic spline that takes the values at `sample_places`.

    Parameters
    ----------
    values : ndarray (cells + 2)
        χ at the places, finite.

    Returns
    -------
    ndarray (cells + 2)
        Coefficients.

    Notes
    -----
    c_0 + c_1 = 2 χ_0; c_i−1 + 6 c_i + c_i+1 = 8 χ_i; c_n + c_n+1 = 2 χ_n+1: solved by elimination,
    in a fixed order, so that a table has the same bits on every machine.

    Examples
    --------
    >>> spline_coefficients(np.array([1.0, 1.0, 1.0, 1.0])).round(12).tolist()
    [1.0, 1.0, 1.0, 1.0]
    """
    given = values.tolist()
    last = len(given) - 1
    # each c is `known` − `share` times the next one
    known, share = [2.0 * given[0]], [1.0]
    for value in given[1:-1]:
        pivot = 6.0 - share[-1]
        known.append((8.0 * value - known[-1]) / pivot)
        share.append(1.0 / pivot)
    found = [(2.0 * given[last] - known[-1]) / (1.0 - share[-1])]
    for here, weight in zip(reversed(known), reversed(share), strict=True):
        found.append(here - weight * found[-1])
    return np.array(found[::-1])
