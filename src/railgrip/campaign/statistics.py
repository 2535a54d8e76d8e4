"""What runs amount to, with 95 % confidence intervals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.plan import FloatArray

CONFIDENCE = 0.95
_AT_ONCE = 2_000_000
"""Resampled numbers that are held at a time: memory does not grow with their number."""


class Estimate(NamedTuple):
    """A number with its confidence interval.

    Attributes
    ----------
    value, low, high : float
        Estimate and interval; NaN or infinite where the runs do not tell.
    """

    value: float
    low: float
    high: float

    @property
    def width(self) -> float:
        """The greater distance of a bound from the estimate."""
        return max(self.high - self.value, self.value - self.low)


def mean(values: FloatArray, confidence: float = CONFIDENCE) -> Estimate:
    """Return the mean with Student's interval.

    Examples
    --------
    >>> [round(number, 3) for number in mean(np.array([1.0, 2.0, 3.0, 4.0]))]
    [2.5, 0.446, 4.554]
    """
    from scipy.special import stdtrit

    n = len(values)
    middle = float(np.mean(values)) if n else float("nan")
    if n < 2:
        return Estimate(middle, -np.inf, np.inf)
    score = float(stdtrit(n - 1, 0.5 + confidence / 2))
    half = score * float(np.std(values, ddof=1)) / n**0.5
    return Estimate(middle, middle - half, middle + half)


def proportion(hits: int, runs: int, confidence: float = CONFIDENCE) -> Estimate:
    """Return a probability with its exact binomial interval (Clopper and Pearson).

    Examples
    --------
    None of 1000: the rule of three gives 0.3 %, two-sided 0.37 %.

    >>> [round(number, 5) for number in proportion(0, 1000)]
    [0.0, 0.0, 0.00368]

    References
    ----------
    .. [1] C. J. Clopper, E. S. Pearson, Biometrika 26 (1934) 404–413.
    """
    from scipy.special import betaincinv

    if runs < 1:
        return Estimate(float("nan"), 0.0, 1.0)
    tail = (1.0 - confidence) / 2
    low = float(betaincinv(hits, runs - hits + 1, tail)) if hits else 0.0
    high = float(betaincinv(hits + 1, runs - hits, 1.0 - tail)) if hits < runs else 1.0
    return Estimate(hits / runs, low, high)


def quantile(values: FloatArray, level: float, confidence: float = CONFIDENCE) -> Estimate:
    """Return a quantile with an interval between order statistics, free of any distribution.

    Where there are too few runs for a bound, it is infinite.

    Notes
    -----
    The number of runs below the true quantile is binomial (n, level); the bounds are the order
    statistics whose ranks it keeps between with at least the confidence.

    References
    ----------
    .. [1] H. A. David, H. N. Nagaraja, Order Statistics, 3rd ed. 2003, section 7.1.

    Examples
    --------
    >>> found = quantile(np.arange(1.0, 1001.0), 0.9)
    >>> found.low < 900 < found.high
    True
    """
    from scipy.stats import binom

    ordered = np.sort(values)
    n = len(ordered)
    tail = (1.0 - confidence) / 2
    low = int(binom.ppf(tail, n, level))
    low -= int(binom.cdf(low - 1, n, level) > tail)
    high = int(binom.isf(tail, n, level)) + 1
    return Estimate(
        float(np.quantile(ordered, level)) if n else float("nan"),
        float(ordered[low - 1]) if 1 <= low <= n else -np.inf,
        float(ordered[high - 1]) if high <= n else np.inf,
    )


def exceedance(values: FloatArray, thresholds: FloatArray) -> list[Estimate]:
    """Return how often each threshold is exceeded, with exact binomial intervals."""
    ordered = np.sort(values)
    above = len(ordered) - np.searchsorted(ordered, thresholds, side="right")
    return [proportion(int(hits), len(ordered)) for hits in above]


def bootstrap(
    columns: Sequence[FloatArray],
    statistic: Callable[..., Any],
    *,
    resamples: int = 499,
    seed: int = 1,
    confidence: float = CONFIDENCE,
) -> Estimate:
    """Return any statistic of runs with its percentile interval over resampled runs.

    Choose it where there is no exact interval; it needs some dozens of runs in the tail that it is
    asked about.

    Parameters
    ----------
    columns : sequence of array (run)
        One column, or several over the same runs, which are resampled together.
    statistic : callable
        Takes the columns and ``axis``, as ``numpy.mean`` does.
    resamples : int
        How often runs are drawn anew, with replacement.
    seed : int
        Of that drawing.
    confidence : float
        Of the interval.

    References
    ----------
    .. [1] B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap, 1993, chapter 13.

    Examples
    --------
    >>> found = bootstrap([np.arange(100.0)], np.mean)
    >>> found.low < 49.5 < found.high
    True
    """
    from scipy.stats import bootstrap as resampled

    runs = len(columns[0])
    if runs < 2:
        value = float(statistic(*columns, axis=-1)) if runs else float("nan")
        return Estimate(value, -np.inf, np.inf)
    found = resampled(
        tuple(columns), statistic, n_resamples=resamples, paired=True, vectorized=True,
        method="percentile", batch=max(1, _AT_ONCE // runs), confidence_level=confidence,
        random_state=np.random.default_rng(seed),
    ).confidence_interval  # fmt: skip
    return Estimate(float(statistic(*columns, axis=-1)), float(found.low), float(found.high))


def difference(one: FloatArray, other: FloatArray, confidence: float = CONFIDENCE) -> Estimate:
    """Return the mean of other − one over runs that share their draws, paired."""
    if one.shape != other.shape:
        raise RailgripError(
            Problem("", "designs must have the same runs to be compared",
                    f"{len(one)} and {len(other)}")
        )  # fmt: skip
    both = np.isfinite(one) & np.isfinite(other)
    return mean(other[both] - one[both], confidence)


def quantile_difference(one: FloatArray, other: FloatArray, level: float) -> Estimate:
    """Return how much higher a quantile is in `other`, over runs that share their draws.

    There is no exact interval for it: that of the paired bootstrap.

    Examples
    --------
    >>> one = np.arange(1000.0)
    >>> [round(number, 6) for number in quantile_difference(one, one + 2.0, 0.99)]
    [2.0, 2.0, 2.0]
    """
    both = np.isfinite(one) & np.isfinite(other)

    def over(one: FloatArray, other: FloatArray, axis: int) -> Any:
        return np.quantile(other, level, axis=axis) - np.quantile(one, level, axis=axis)

    return bootstrap([one[both], other[both]], over)


def judged(until: Any, values: FloatArray) -> Estimate:
    """Return what a campaign's `until` asks about."""
    finite = values[np.isfinite(values)]
    if until.statistic == "quantile":
        return quantile(finite, until.level)
    if until.statistic == "exceedance":
        return proportion(int((finite > until.threshold).sum()), len(finite))
    return mean(finite)
