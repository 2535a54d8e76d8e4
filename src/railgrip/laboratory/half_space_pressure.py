"""The normal problem of a Hertzian contact, solved on cells of uniform pressure."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.special import elliprd

from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.half_space_grid import convolve, smooth, smoothing, spectrum
from railgrip.laboratory.krylov import gmres

_TOLERANCE = 1e-11
_ROUNDS = 60
_KRYLOV = 120


def hertz_pressure(x: Any, y: Any, width: float, push: Any) -> Any:
    """Pressure in the cells under the load 1, on an ellipse with the semi-axes 1 and `width`.

    Parameters
    ----------
    x, y : ndarray
        Centres of the cells along and across [a].
    width : float
        Semi-axis across over semi-axis along [-].
    push : ndarray
        Influence table zz, for the contact modulus E* = 1/π.

    Returns
    -------
    ndarray (across, along)
        Pressure, 0 outside the patch; it carries the load exactly [load/a²].

    Raises
    ------
    RailgripError
        "the contact region did not settle", where cells change sides without end.

    Notes
    -----
    The gap that makes Hertz's ellipse is ½ [R_D(0, w², 1) x² + R_D(0, 1, w²) y²] in these units,
    R_D Carlson's elliptic integral. In the patch push ∗ p = approach − gap, outside p = 0 and the
    bodies stay apart; cells in tension leave, cells that overlap enter, until none does.

    Checked by tests/unit/laboratory/test_half_space_patch.py against Hertz's ellipsoid.
    """
    square = width * width
    gap = 0.5 * (
        elliprd(0.0, square, 1.0) * (x * x)[None, :] + elliprd(0.0, 1.0, square) * (y * y)[:, None]
    )
    cell = (x[1] - x[0]) * (y[1] - y[0])
    kernel, inverse = spectrum(push), smoothing(push)
    inside = (x * x)[None, :] + (y * y)[:, None] / square < 1.0
    for _ in range(_ROUNDS):
        per_approach, per_gap = (
            _solve(kernel, inverse, inside, wanted) for wanted in (np.ones_like(gap), gap)
        )
        approach = (1.0 / cell + per_gap.sum()) / per_approach.sum()
        pressure = approach * per_approach - per_gap
        pulled = inside & (pressure < 0.0)
        overlap = approach - gap - convolve(kernel, pressure)
        pressed = ~inside & (overlap > 1e-9 * approach)
        if not (pulled.any() or pressed.any()):
            return pressure
        inside = (inside & ~pulled) | (pressed & ~pulled.any())
    raise RailgripError(
        Problem("grid", "the contact region did not settle", cure="another number of cells")
    )


def _solve(kernel: Any, inverse: Any, inside: Any, wanted: Any) -> Any:
    """Return the pressure inside that moves the surface there as wanted."""
    return gmres(
        lambda pressure: convolve(kernel, pressure) * inside,
        lambda moved: smooth(inverse, moved) * inside,
        wanted * inside,
        _TOLERANCE,
        _KRYLOV,
    )
