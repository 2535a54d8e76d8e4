"""Fewer points, the same peaks."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Thinner:
    """Thin traces to about `most` points, keeping the peaks.

    Each stretch of samples becomes two: its least and its greatest value, in their order. So a
    vent pulse or a short lock stays visible, displaced by less than the stretch.

    Parameters
    ----------
    samples : int
        How many there are.
    most : int
        How many there may be; nothing changes where there are no more.

    Examples
    --------
    >>> thin = Thinner(8, 4)
    >>> thin(np.array([0.0, 0, 9, 0, 1, 1, 1, 1])).tolist()
    [0.0, 9.0, 1.0, 1.0]
    """

    def __init__(self, samples: int, most: int) -> None:
        self.stretch = 1 if samples <= most else -(-samples // max(1, most // 2))

    def axis(self, x: Array) -> Array:
        """Thin an axis: the start and the middle of each stretch."""
        if self.stretch == 1:
            return x
        return _joined(self._cut(x)[..., [0, self.stretch // 2]])

    def __call__(self, values: Array) -> Array:
        """Thin a trace, or traces with time last."""
        if self.stretch == 1:
            return values
        cut = self._cut(values)
        low = np.where(np.isnan(cut), np.inf, cut).argmin(axis=-1)
        high = np.where(np.isnan(cut), -np.inf, cut).argmax(axis=-1)
        places = np.stack([np.minimum(low, high), np.maximum(low, high)], axis=-1)
        return _joined(np.take_along_axis(cut, places, axis=-1))

    def _cut(self, values: Array) -> Array:
        short = -values.shape[-1] % self.stretch
        padding = [(0, 0)] * (values.ndim - 1) + [(0, short)]
        whole = np.pad(values, padding, mode="edge")
        return whole.reshape(*values.shape[:-1], -1, self.stretch)


def _joined(pairs: Array) -> Array:
    shape: tuple[Any, ...] = (*pairs.shape[:-2], -1)
    return pairs.reshape(shape)
