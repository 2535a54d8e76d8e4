"""Quantiles of a weighted sample, with intervals from its own variance.

The probability of a result below a bound is a sum of weights. An interval for a quantile is the set
of bounds that the sample does not contradict: those whose probability differs from the asked one by
no more than the standard errors allow. It is not symmetric, and it grows by itself where few
results lie, as in a gap between the modes.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from railgrip.campaign.rare.failures import FailureStates
from railgrip.campaign.rare.proposal import Sample

FloatArray = NDArray[np.float64]

CONFIDENCE = 0.95
"""Of every interval; the simultaneous ones hold all levels at once with it."""


RESOLVED = 100.0
"""A level that rests on fewer effective runs is not resolved: its intervals stay open. So few mean
that the proposal missed where the rare runs lie, and then their own variance cannot be trusted."""


class Curve(NamedTuple):
    """Probability that a result is at most a bound, over all bounds that occurred.

    Attributes
    ----------
    bound : (points,)
        Rising results.
    probability : (points,)
        Estimate, without the states that were left out.
    error : (points,)
        Its standard error.
    effective : (points,)
        Number of equally weighted runs that would tell as much.
    """

    bound: FloatArray
    probability: FloatArray
    error: FloatArray
    effective: FloatArray


class Interval(NamedTuple):
    """Where a quantile lies: interval of its own, interval that holds with all others, weight."""

    value: float
    low: float
    high: float
    low_all: float
    high_all: float
    effective: float


def curve(result: FloatArray, sample: Sample, states: FailureStates) -> Curve:
    """Return the distribution of the results of a sample.

    Parameters
    ----------
    result : (runs,)
        What each run gave; larger is better.
    sample : Sample
        The runs, with weights.
    states : FailureStates
        Gives the exact probability of each number of failed units, which the sum of the weights
        only estimates; the difference corrects the estimate (a control variate).

    Notes
    -----
    The variance is that of independent runs within each component. Where runs are spread more
    evenly than that, the intervals are somewhat too wide, never too narrow.
    """
    bound = np.unique(result)
    probability, variance = np.zeros(len(bound)), np.zeros(len(bound))
    counts = states.n_failed[sample.state]
    for count in np.unique(counts):
        exact = float(states.weight[states.n_failed == count].sum())
        part, own = _of_one_count(bound, result, sample, counts == count, exact)
        probability += part
        variance += own
    error = np.sqrt(np.maximum(variance, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        effective = np.where(error > 0.0, (probability / error) ** 2, np.inf)
    return Curve(bound, np.maximum.accumulate(probability), error, effective)


def _of_one_count(
    bound: FloatArray, result: FloatArray, sample: Sample, here: NDArray[np.bool_], exact: float
) -> tuple[FloatArray, FloatArray]:
    """Return probability and variance for one number of failed units."""
    first, variance, shared = (np.zeros(len(bound)) for _ in range(3))
    total, spread = 0.0, 0.0
    for number in np.unique(sample.component[here]):
        own = sample.component == number
        order = np.argsort(result[own])
        weight, n = sample.weight[own][order], int(own.sum())
        reached = np.searchsorted(result[own][order], bound, side="right")
        sums = np.concatenate(([0.0], np.cumsum(weight)))
        squares = np.concatenate(([0.0], np.cumsum(weight**2)))
        a, b, per = sums[reached], squares[reached], n / (n - 1)
        first += a
        variance += per * (b - a * a / n)
        shared += per * (b - a * sums[-1] / n)
        total += sums[-1]
        spread += per * (squares[-1] - sums[-1] ** 2 / n)
    if spread <= 1e-20 * exact**2:
        return first, variance
    regression = np.clip(shared / spread, 0.0, 1.0)
    corrected = first - regression * (total - exact)
    left = variance - 2.0 * regression * shared + regression**2 * spread
    return np.clip(corrected, 0.0, exact), np.maximum(left, 0.0)


def intervals(found: Curve, probabilities: FloatArray, left_out: float) -> list[Interval]:
    """Return the quantile and its intervals for each probability.

    Parameters
    ----------
    found : Curve
        From `curve`.
    probabilities : (levels,)
        Which quantiles.
    left_out : float
        Probability of the failure states that were not run; they may lie anywhere.
    """
    each, every = CONFIDENCE, 1.0 - (1.0 - CONFIDENCE) / len(probabilities)
    rows = []
    for p in probabilities:
        value = _crossing(found.bound, found.probability + 0.5 * left_out, p)
        low, high = _band(found, p, each, left_out)
        low_all, high_all = _band(found, p, every, left_out)
        at = min(int(np.searchsorted(found.bound, value)), len(found.bound) - 1)
        effective = float(found.effective[at])
        if effective < RESOLVED:
            low = low_all = -np.inf
            high = high_all = np.inf
        rows.append(Interval(value, low, high, low_all, high_all, effective))
    return rows


def _band(found: Curve, p: float, confidence: float, left_out: float) -> tuple[float, float]:
    """Return the outermost bounds that the sample does not contradict."""
    freedom = np.clip(found.effective, 2.0, 1e6)
    reach = stdtrit(freedom, 0.5 + 0.5 * confidence) * found.error
    upper = found.probability + reach + left_out
    lower = found.probability - reach
    above, below = np.flatnonzero(upper >= p), np.flatnonzero(lower <= p)
    last = len(found.bound) - 1
    low = found.bound[above[0] - 1] if len(above) and above[0] > 0 else -np.inf
    high = found.bound[below[-1] + 1] if len(below) and below[-1] < last else np.inf
    if not len(below):
        high = found.bound[0]
    if not len(above):
        low = found.bound[-1]
    return float(low), float(high)


def _crossing(bound: FloatArray, probability: FloatArray, p: float) -> float:
    """Return where a rising curve reaches p, between the points."""
    at = int(np.searchsorted(probability, p))
    if at == 0 or at >= len(bound):
        return float(bound[min(at, len(bound) - 1)])
    step = probability[at] - probability[at - 1]
    share = (p - probability[at - 1]) / step if step > 0.0 else 1.0
    return float(bound[at - 1] + share * (bound[at] - bound[at - 1]))
