"""Closed quantiles of exact cases: the formula of the README, solved to twelve digits."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq
from scipy.special import log_ndtr, logsumexp

LEVELS = (0.5, *(10.0**-n for n in range(1, 10)))


def quantiles(forces: Sequence[float], chances: Sequence[float], spread: float) -> list[float]:
    """Return K at EBCL 0 … 9 of units that may all differ, by summing over every subset."""
    force, q = np.asarray(forces), np.asarray(chances)
    subsets = np.array(list(itertools.product([False, True], repeat=len(force))))
    log_weight = np.where(subsets, np.log(q), np.log1p(-q)).sum(axis=1)
    mean = np.where(subsets, 0.0, force).sum(axis=1)
    deviation = spread * np.sqrt(np.where(subsets, 0.0, force**2).sum(axis=1))
    works = deviation > 0.0

    def log_probability(k: float) -> float:
        return float(logsumexp(log_weight[works] + log_ndtr((k - mean[works]) / deviation[works])))

    return [brentq(lambda k, p=p: log_probability(k) - np.log(p), 1e-3, 2.0, xtol=1e-13)
            for p in LEVELS]  # fmt: skip


def lognormal_quantiles(n: int, q: float, spread: float) -> list[float]:
    """Return quantiles of exp(spread · u) times the share of n units that work."""
    from scipy.stats import binom

    j = np.arange(n)
    log_weight = binom.logpmf(j, n, q)

    def log_probability(k: float) -> float:
        return float(logsumexp(log_weight + log_ndtr(np.log(k * n / (n - j)) / spread)))

    return [brentq(lambda k, p=p: log_probability(k) - np.log(p), 1e-3, 9.0, xtol=1e-13)
            for p in LEVELS]  # fmt: skip


def of_units(n: int, q: float, probability: Callable[[float], float]) -> list[float]:
    """Return quantiles of a result less the share of n equal units that have failed.

    Parameters
    ----------
    probability : callable
        Probability that the result with no unit failed is below a bound.
    """
    from scipy.stats import binom

    weight = binom.pmf(np.arange(n + 1), n, q)

    def log_probability(k: float) -> float:
        return float(np.log(sum(w * probability(k + j / n) for j, w in enumerate(weight)) + 1e-300))

    return [brentq(lambda k, p=p: log_probability(k) - np.log(p), -3.0, 3.0, xtol=1e-13)
            for p in LEVELS]  # fmt: skip


def least_of(mean: ArrayLike, deviation: ArrayLike) -> Callable[[float], float]:
    """Return 1 − Π (1 − Φ((k − m)/s)): the least of independent normal quantities is below k."""
    m, s = np.asarray(mean), np.asarray(deviation)
    return lambda k: float(-np.expm1(log_ndtr(-(k - m) / s).sum()))


def distance_of(n: int, scale: float) -> Callable[[float], float]:
    """Return the probability that 1 − scale · |u|² is below k, u normal in n dimensions."""
    from scipy.stats import chi2

    return lambda k: float(chi2.sf((1.0 - k) / scale, n))


def two_sided(deviation: float) -> Callable[[float], float]:
    """Return the probability that 1 − |x| is below k, x normal with this deviation."""
    from scipy.special import ndtr

    return lambda k: min(1.0, 2.0 * float(ndtr(-(1.0 - k) / deviation)))
