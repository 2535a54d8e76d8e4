"""A patch held at one temperature on a moving half-space, by square elements of constant flux."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

_NEAR = 3


class HeldPatch(NamedTuple):
    """Flux of each element [λ·K/a], for a rise of 1 K, and where they lie; lengths over a."""

    x: np.ndarray
    y: np.ndarray
    flux: np.ndarray
    size: tuple[float, float]
    peclet: float

    def conductance(self, ratio: float) -> float:
        """Heat flow over λ·a·rise, put right for the stairs of the rim.

        It grows with the area to the power ½ at rest and ¾ when fast.
        """
        element = self.size[0] * self.size[1]
        stairs = np.pi * ratio / (self.x.size * element)
        power = 0.5 if self.peclet == 0.0 else 0.7
        return float(self.flux.sum() * element * stairs**power)

    def rise(self, x: float) -> float:
        """Rise of the surface beyond the patch, on its middle strip."""
        return float(_far(x - self.x, -self.y, self.size, self.peclet) @ self.flux)


def held_patch(ratio: float, peclet: float, count: int) -> HeldPatch:
    """Solve for an ellipse of b/a = ratio with count elements along and across."""
    hx, hy = 2.0 / count, 2.0 * ratio / count
    along = (np.arange(count) + 0.5) * hx - 1.0
    x, y = np.meshgrid(along, ratio * along)
    inside = x**2 + (y / ratio) ** 2 < 1.0
    x, y = x[inside], y[inside]
    lags = np.arange(1 - count, count)
    table = _far((lags * hx)[:, None], (lags * hy)[None, :], (hx, hy), peclet)
    for i in range(-_NEAR, _NEAR + 1):
        for j in range(-_NEAR, _NEAR + 1):
            table[i + count - 1, j + count - 1] = _near(i * hx, j * hy, (hx, hy), peclet)
    columns = np.rint((x[:, None] - x) / hx).astype(int) + count - 1
    rows = np.rint((y[:, None] - y) / hy).astype(int) + count - 1
    flux = np.linalg.solve(table[columns, rows], np.ones(x.size))
    return HeldPatch(x, y, flux, (hx, hy), peclet)


def _kernel(x: np.ndarray, y: np.ndarray, peclet: float) -> np.ndarray:
    """Rise at (x, y) behind a point source, over its heat/(λ a)."""
    r = np.hypot(x, y)
    return np.asarray(np.exp(-peclet * (r - x)) / (2.0 * np.pi * r))


def _far(x: np.ndarray, y: np.ndarray, size: tuple[float, float], peclet: float) -> np.ndarray:
    node, weight = np.polynomial.legendre.leggauss(8)
    total = sum(
        u * w * _kernel(x - 0.5 * p * size[0], y - 0.5 * q * size[1], peclet)
        for p, u in zip(node, weight, strict=True)
        for q, w in zip(node, weight, strict=True)
    )
    return np.asarray(0.25 * size[0] * size[1] * total)


def _near(x: float, y: float, size: tuple[float, float], peclet: float) -> float:
    """The middles of 400 × 400 parts never meet the point itself."""
    part = (np.arange(400) + 0.5) / 400 - 0.5
    fine = _kernel(x - size[0] * part[:, None], y - size[1] * part, peclet)
    return float(size[0] * size[1] * fine.mean())
