"""Linear equations that are known by their product only: GMRES (Saad and Schultz 1986).

SciPy's own calls the multi-threaded BLAS for each short dot product, which on a shared machine
costs more than the equations. Here all sums stay on one core.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

Operator = Callable[[Any], Any]


def gmres(
    product: Operator, precondition: Operator, wanted: Any, accuracy: float, most: int
) -> Any:
    """Solve product(x) = wanted, as well as `most` steps allow.

    Parameters
    ----------
    product, precondition : callable
        The matrix, and about its inverse, applied to an array like `wanted`.
    wanted : ndarray
        Right-hand side, of any shape.
    accuracy : float
        Greatest norm of what is left, over that of `wanted` [-].
    most : int
        Greatest number of steps; each keeps one array [-].

    Returns
    -------
    ndarray
        The solution, or the best that `most` steps found.

    Notes
    -----
    Preconditioned from the right, so that the true residual is minimised; Gram–Schmidt twice.

    References
    ----------
    .. [1] Y. Saad, M. H. Schultz, GMRES, SIAM J. Sci. Stat. Comput. 7 (1986) 856–869.

    Examples
    --------
    >>> stiff = np.array([1.0, 10.0, 100.0])
    >>> gmres(lambda x: stiff * x, lambda x: x, np.ones(3), 1e-12, 10).round(6).tolist()
    [1.0, 0.1, 0.01]
    """
    shape, size = wanted.shape, length(wanted)
    if size == 0.0:
        return np.zeros(shape)
    basis = np.empty((most + 1, wanted.size))
    basis[0] = wanted.ravel() / size
    triangle = np.zeros((most, most))
    turns: list[tuple[float, float]] = []
    left = [size]
    for step in range(most):
        image = product(precondition(basis[step].reshape(shape))).ravel()
        column, image = _orthogonal(basis[: step + 1], image)
        rest = length(image)
        for row, (cosine, sine) in enumerate(turns):
            upper, lower = column[row], column[row + 1]
            column[row : row + 2] = cosine * upper + sine * lower, cosine * lower - sine * upper
        radius = math.hypot(column[step], rest)
        if radius == 0.0:
            break
        turns.append((column[step] / radius, rest / radius))
        column[step] = radius
        triangle[: step + 1, step] = column[: step + 1]
        left[step:] = [turns[-1][0] * left[step], -turns[-1][1] * left[step]]
        if abs(left[-1]) <= accuracy * size or rest == 0.0:
            break
        basis[step + 1] = image / rest
    count = len(turns)
    weights = np.zeros(count)
    for row in range(count - 1, -1, -1):
        known = float((triangle[row, row + 1 : count] * weights[row + 1 :]).sum())
        weights[row] = (left[row] - known) / triangle[row, row]
    return precondition(_sum(weights, basis[:count]).reshape(shape))


def length(field: Any) -> float:
    """Return the Euclidean norm of an array of any shape, of numbers of any size."""
    top = float(np.abs(field).max())
    if not 0.0 < top < math.inf:
        return top
    flat = field.ravel() / top
    return top * math.sqrt(float(np.einsum("i,i->", flat, flat)))


def _orthogonal(basis: Any, image: Any) -> tuple[list[float], Any]:
    """Return the parts of the image along the basis, a place more, and what is left of it."""
    first = np.einsum("ij,j->i", basis, image)
    image = image - _sum(first, basis)
    second = np.einsum("ij,j->i", basis, image)
    return [*(first + second).tolist(), 0.0], image - _sum(second, basis)


def _sum(weights: Any, basis: Any) -> Any:
    return np.einsum("i,ij->j", weights, basis)
