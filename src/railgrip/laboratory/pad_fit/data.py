"""Measured stops as flat arrays, and what stands for a stop in the fit: its blocks."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from railgrip.laboratory.inputs import FloatArray

INFLUENCES = ("temperature", "speed", "clamp_force")
"""What pad friction depends on, in the order of the columns of all arrays."""

UNITS = {"temperature": "°C", "speed": "m/s", "clamp_force": "N"}
BLOCKS_PER_STOP = 32
MOST_SCATTER = 0.03
"""Of the clamp force within a block, in shares of its mean."""


class PadStops(NamedTuple):
    """Samples of many stops, one after another; SI, temperatures in °C.

    Parameters
    ----------
    stop : ndarray of int (sample,)
        Number of the stop, from 0, ascending.
    time : ndarray (sample,)
        Ascending within a stop [s].
    friction : ndarray (sample,)
        Friction coefficient of the pad, > 0 [-].
    temperature, speed, clamp_force : ndarray (sample,)
        Disc temperature [°C], rubbing speed [m/s], clamp force [N]; NaN throughout where it was
        not measured.
    """

    stop: np.ndarray
    time: FloatArray
    friction: FloatArray
    temperature: FloatArray
    speed: FloatArray
    clamp_force: FloatArray

    def influence(self, name: str) -> FloatArray:
        """Return one of the three influences by its name."""
        values: FloatArray = getattr(self, name)
        return values


class Blocks(NamedTuple):
    """Short pieces of stops, each with one value: (stop, block) arrays, padded at the end.

    Parameters
    ----------
    is_there : ndarray of bool (stop, block)
        False in the padding, where all values are harmless.
    time, log_friction : ndarray (stop, block)
        Mean time [s]; logarithm of the friction, the mean of the middle half of its samples.
    values : ndarray (influence, stop, block)
        Mean temperature, speed, clamp force; NaN throughout where not measured.
    slopes : ndarray (influence, stop, block)
        Their change per second.
    spacing : float
        Time between two samples, the median [s].
    """

    is_there: np.ndarray
    time: FloatArray
    log_friction: FloatArray
    values: FloatArray
    slopes: FloatArray
    spacing: float

    @property
    def stops(self) -> int:
        """How many stops there are."""
        return len(self.time)

    def of(self, stops: np.ndarray) -> Blocks:
        """Return some of the stops."""
        return Blocks(
            self.is_there[stops],
            self.time[stops],
            self.log_friction[stops],
            self.values[:, stops],
            self.slopes[:, stops],
            self.spacing,
        )


def blocks_of(stops: PadStops, per_stop: int = BLOCKS_PER_STOP) -> Blocks:
    """Cut each stop into blocks of equal count of samples and average each.

    Noise of a stop is correlated, so that many samples a second say little more than one; a block
    keeps what they say, and the mean of its middle half does not see single outliers.

    Parameters
    ----------
    stops : PadStops
        At least one sample.
    per_stop : int
        Greatest number of blocks of a stop; the lengths of blocks differ by one sample at most.

    Returns
    -------
    Blocks
        Of stops in their order.

    Notes
    -----
    Slopes are central differences of the blocks' means. For a sensor with a first-order lag τ this
    is what is needed: mean(T) = mean(T_m) + τ (T_m(end) − T_m(start))/duration, exactly.

    Examples
    --------
    >>> n = np.arange(8)
    >>> one = PadStops(n * 0, n * 0.1, np.full(8, 0.37), 20.0 + n, 15.0 - n, np.full(8, 25e3))
    >>> blocks_of(one, 2).values[0].tolist()
    [[21.5, 25.5]]
    """
    counts = np.bincount(stops.stop)
    begins = np.concatenate([[0], np.cumsum(counts)[:-1]])
    inside = np.arange(len(stops.stop)) - begins[stops.stop]
    blocks_in = np.minimum(counts, per_stop)
    block = (inside * blocks_in[stops.stop]) // counts[stops.stop]
    place = stops.stop * per_stop + block
    shape = (len(counts), per_stop)
    samples = np.bincount(place, minlength=shape[0] * per_stop).reshape(shape)
    is_there = samples > 0

    def mean(values: FloatArray) -> FloatArray:
        sums = np.bincount(place, weights=values, minlength=samples.size).reshape(shape)
        return np.where(is_there, sums / np.maximum(samples, 1), 0.0)

    time = mean(stops.time)
    values = np.stack([mean(stops.influence(name)) for name in INFLUENCES])
    middle = _mean_of_middle_half(np.log(stops.friction), place, samples)
    slopes = np.stack([_slopes(time, one, is_there) for one in values])
    steps = np.diff(stops.time)[np.diff(stops.stop) == 0]
    spacing = float(np.median(steps)) if len(steps) else 0.0
    force = values[INFLUENCES.index("clamp_force")]
    scatter = mean((stops.clamp_force - force.ravel()[place]) ** 2)
    # a block over a step of the force has the friction of neither side
    mixed = scatter > (MOST_SCATTER * force) ** 2
    return packed(Blocks(is_there & ~mixed, time, middle, values, slopes, spacing))


def packed(blocks: Blocks) -> Blocks:
    """Return the blocks with those that are there first in each stop."""
    order = np.argsort(~blocks.is_there, axis=1, kind="stable")
    rows = np.arange(blocks.stops)[:, None]
    return Blocks(
        blocks.is_there[rows, order],
        blocks.time[rows, order],
        blocks.log_friction[rows, order],
        blocks.values[:, rows, order],
        blocks.slopes[:, rows, order],
        blocks.spacing,
    )


def _mean_of_middle_half(values: FloatArray, place: np.ndarray, samples: np.ndarray) -> FloatArray:
    ordered = np.lexsort((values, place))
    counts = samples.ravel()
    begins = np.concatenate([[0], np.cumsum(counts)[:-1]])
    owner = place[ordered]
    rank = np.arange(len(values)) - begins[owner]
    quarter = (counts // 4)[owner]
    kept = (rank >= quarter) & (rank < counts[owner] - quarter)
    sums = np.bincount(owner[kept], weights=values[ordered][kept], minlength=len(counts))
    number = np.bincount(owner[kept], minlength=len(counts))
    means = np.where(number > 0, sums / np.maximum(number, 1), 0.0)
    return np.asarray(means.reshape(samples.shape))


def _slopes(time: FloatArray, values: FloatArray, is_there: np.ndarray) -> FloatArray:
    """Return central differences inside a stop, parabolas through three blocks at its ends."""
    found = np.zeros(values.shape)
    for row, (t, y, there) in enumerate(zip(time, values, is_there, strict=True)):
        n = int(there.sum())
        if n >= 2:
            found[row, :n] = np.gradient(y[:n], t[:n], edge_order=2 if n > 2 else 1)
    return found
