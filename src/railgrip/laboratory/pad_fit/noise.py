"""How measurements of a stop hang together: an offset, slow noise, fast noise, outliers."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.data import Blocks

OUTLIER = 6.0
"""Residuals beyond so many standard deviations have no weight (Tukey's biweight)."""
LEAST_WEIGHT = 1e-4
_NORMAL = 1.4826


class Noise(NamedTuple):
    """Covariance of the logarithm of friction within a stop.

    Parameters
    ----------
    offset, slow, fast : float
        Standard deviations: of what a whole stop has in common, of noise that dies out over
        `memory`, of what one block has for itself.
    memory : float
        Time constant of the slow noise [s].
    """

    offset: float = 0.03
    slow: float = 0.02
    fast: float = 0.01
    memory: float = 1.0


class Weights(NamedTuple):
    """How much blocks (stop, block) and stops (stop,) count; 1 where nothing is odd."""

    block: FloatArray
    stop: FloatArray


def whitener(noise: Noise, weights: Weights, blocks: Blocks) -> FloatArray:
    """Return for each stop the matrix that makes its residuals independent with variance 1.

    Parameters
    ----------
    noise : Noise
        Covariance.
    weights : Weights
        A block or stop of small weight gets a great variance of its own.
    blocks : Blocks
        For their times.

    Returns
    -------
    ndarray (stop, block, block)
        L⁻¹ of the covariance L Lᵀ, 0 in the padding.
    """
    apart = np.abs(blocks.time[:, :, None] - blocks.time[:, None, :])
    covariance = noise.slow**2 * np.exp(-apart / max(noise.memory, 1e-9))
    covariance += (noise.offset**2 / weights.stop)[:, None, None]
    both = blocks.is_there[:, :, None] & blocks.is_there[:, None, :]
    covariance = np.where(both, covariance, 0.0)
    own = (noise.slow**2 + noise.fast**2) * (1.0 / weights.block - 1.0) + noise.fast**2
    places = np.arange(blocks.time.shape[1])
    # a padded place stands alone with variance 1
    covariance[:, places, places] += np.where(blocks.is_there, own, 1.0)
    inverse = np.linalg.inv(np.linalg.cholesky(covariance))
    return np.where(both, inverse, 0.0)


def noise_of(residuals: FloatArray, blocks: Blocks) -> Noise:
    """Estimate the covariance from residuals, by medians, so that outliers do not count."""
    middle = _medians(residuals, blocks.is_there)
    inner = np.where(blocks.is_there, residuals - middle[:, None], np.nan)
    spread = max(_NORMAL * float(np.nanmedian(np.abs(inner))), 1e-5)
    kept = np.where(np.abs(inner) < 3.5 * spread, inner, np.nan)
    variance = max(float(np.nanmean(kept**2)), 1e-10)
    first, second = (_together(kept, lag) / variance for lag in (1, 2))
    step = float(np.median(np.diff(blocks.time, axis=1)[blocks.is_there[:, 1:]]))
    decay = float(np.clip(second / first if first > 0.05 else 0.05, 0.05, 0.97))
    share = float(np.clip(first / decay, 0.0, 0.98)) if first > 0.05 else 0.0
    # What is correlated looks smaller about its own stop's middle; blocks per memory are many.
    offsets = middle - np.median(middle)
    common = _NORMAL * float(np.median(np.abs(offsets)))
    memory = -step / np.log(decay)
    lasting = np.median(blocks.is_there.sum(axis=1)) * step
    from_slow = variance * min(1.0, share * 2.0 * memory / max(lasting, step))
    offset = np.sqrt(max(common**2 - from_slow, (0.1 * common) ** 2, 1e-10))
    slow, fast = np.sqrt(variance * share), np.sqrt(variance * (1.0 - share))
    return Noise(float(offset), float(max(slow, 1e-6)), float(max(fast, 1e-6)), float(memory))


def weights_of(residuals: FloatArray, noise: Noise, blocks: Blocks) -> Weights:
    """Return how much each block and each stop counts, by Tukey's biweight."""
    middle = _medians(residuals, blocks.is_there)
    inner = (residuals - middle[:, None]) / np.hypot(noise.slow, noise.fast)
    whole = (middle - np.median(middle)) / np.hypot(noise.offset, noise.slow)
    return Weights(np.where(blocks.is_there, _biweight(inner), 1.0), _biweight(whole))


def _biweight(z: FloatArray) -> FloatArray:
    return np.asarray(np.maximum(np.maximum(1.0 - (z / OUTLIER) ** 2, 0.0) ** 2, LEAST_WEIGHT))


def _medians(values: FloatArray, is_there: np.ndarray) -> FloatArray:
    return np.asarray(np.nanmedian(np.where(is_there, values, np.nan), axis=1))


def _together(values: FloatArray, lag: int) -> float:
    products = values[:, lag:] * values[:, :-lag]
    return float(np.nanmean(products)) if np.isfinite(products).any() else 0.0
