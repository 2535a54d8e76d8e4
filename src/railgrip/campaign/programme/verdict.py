"""From the figures of a test's runs to a verdict, its margin and how sure it is."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

KEPT, MISSED, NOT_APPLICABLE = "kept", "missed", "not applicable"
CONFIDENCE = 0.95


class Held(NamedTuple):
    """One limit, and how the valid runs stood against it.

    Attributes
    ----------
    verdict : str
        ``kept``, ``missed``, ``not applicable`` (no run has the figure).
    value : float
        What was judged: the worst run's figure, or the mean, SI.
    margin : float
        Distance to the limit over the limit, positive when kept; to a limit of zero, in SI.
    worst : int
        Which of the runs comes nearest to the limit, or passes it furthest; -1 for none.
    share_least : float
        With 95 % confidence at least this share of all such runs keeps it (Clopper–Pearson); for
        a mean: the probability that the true mean keeps it (Student).
    """

    verdict: str
    value: float
    margin: float
    worst: int
    share_least: float


def hold(values: Array, least: float | None, greatest: float | None, judged: str = "each") -> Held:
    """Hold the figures of the valid runs against a limit.

    Parameters
    ----------
    values : ndarray (run)
        SI; NaN where a run has none.
    least, greatest : float, optional
        SI.
    judged : str
        ``each`` or ``mean``.

    Examples
    --------
    Ten locks of at most 0.3 s against 0.4 s: kept, by a quarter. Ten runs prove little of the
    eleventh:

    >>> held = hold(np.linspace(0.1, 0.3, 10), None, 0.4)
    >>> held.verdict, round(held.margin, 2), round(held.share_least, 2)
    ('kept', 0.25, 0.74)
    """
    known = np.flatnonzero(~np.isnan(values))
    if not len(known):
        return Held(NOT_APPLICABLE, math.nan, math.nan, -1, math.nan)
    margins = np.array([_margin(float(values[i]), least, greatest) for i in known])
    worst = int(known[np.argmin(margins)])
    if judged == "mean":
        mean = float(values[known].mean())
        margin = _margin(mean, least, greatest)
        return Held(KEPT if margin >= 0.0 else MISSED, mean, margin, worst,
                    _sure_of_mean(values[known], least, greatest))  # fmt: skip
    margin = float(margins.min())
    sure = share_at_least(int((margins >= 0.0).sum()), len(known))
    return Held(KEPT if margin >= 0.0 else MISSED, float(values[worst]), margin, worst, sure)


def run_margin(value: float, least: float | None, greatest: float | None) -> float:
    """Return the margin of a single run, as `Held.margin`; NaN where it has no figure."""
    return math.nan if math.isnan(value) else _margin(value, least, greatest)


def share_at_least(kept: int, of: int) -> float:
    """Return the share of all runs that keeps a limit, at least so with 95 % confidence.

    References
    ----------
    .. [1] C. Clopper, E. Pearson, The use of confidence or fiducial limits illustrated in the case
       of the binomial, Biometrika 26 (1934) 404–413.

    Examples
    --------
    >>> round(share_at_least(59, 59), 3)
    0.95
    """
    from scipy.stats import beta

    return float(beta.ppf(1.0 - CONFIDENCE, kept, of - kept + 1)) if kept else 0.0


def mean_interval(values: Array) -> tuple[float, float]:
    """Return the two-sided 95 % interval of the mean (Student); NaN for a single value.

    Examples
    --------
    >>> [round(end, 2) for end in mean_interval(np.array([1.0, 2.0, 3.0]))]
    [-0.48, 4.48]
    """
    from scipy.stats import t

    known = values[np.isfinite(values)]
    if len(known) < 2:
        return math.nan, math.nan
    half = float(t.ppf(0.5 + CONFIDENCE / 2, len(known) - 1))
    half *= float(known.std(ddof=1)) / math.sqrt(len(known))
    return float(known.mean()) - half, float(known.mean()) + half


def _margin(value: float, least: float | None, greatest: float | None) -> float:
    margins = []
    if greatest is not None:
        margins.append((greatest - value) / (abs(greatest) or 1.0))
    if least is not None:
        margins.append((value - least) / (abs(least) or 1.0))
    return min(margins)


def _sure_of_mean(values: Array, least: float | None, greatest: float | None) -> float:
    from scipy.stats import t

    n = len(values)
    if n < 2 or not np.isfinite(values).all():
        return math.nan
    error = float(values.std(ddof=1)) / math.sqrt(n)
    mean = float(values.mean())
    if error == 0.0:
        return 1.0 if _margin(mean, least, greatest) >= 0.0 else 0.0
    below = float(t.cdf((greatest - mean) / error, n - 1)) if greatest is not None else 1.0
    above = float(t.cdf((mean - least) / error, n - 1)) if least is not None else 1.0
    return max(0.0, below + above - 1.0)
