"""Distributions of one quantity, each as a function of a standard normal number.

A normal number u stands for the probability Φ(u); a quantity takes the value of its distribution
at that probability. So one importance sampling in normal numbers serves every distribution, also
far out in the tails.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri

from railgrip.campaign.distribution_kinds import Empirical
from railgrip.core.errors import Problem

FloatArray = NDArray[np.float64]

NEEDS: Final[dict[str, tuple[str, ...]]] = {
    "normal": ("mean", "deviation"),
    "lognormal": ("mean", "deviation"),
    "uniform": ("low", "high"),
    "triangular": ("low", "mode", "high"),
    "empirical": (),
}
"""Distribution → the numbers it needs; a normal one may also be cut off at low and high."""


def problems_of_numbers(kind: str, given: dict[str, float]) -> list[Problem]:
    """Return what is impossible about a distribution, one problem for each fault."""
    allowed = {*NEEDS[kind], *(("low", "high") if kind == "normal" else ())}
    found = [Problem(name, f"is needed for distribution '{kind}'") for name in NEEDS[kind]
             if name not in given]  # fmt: skip
    found += [
        Problem(name, f"does not belong to distribution '{kind}'", allowed=", ".join(NEEDS[kind]))
        for name in given
        if name not in allowed
    ]
    if found:
        return found
    if given.get("deviation", 1.0) <= 0.0:
        found.append(Problem("deviation", "must be above 0", got=f"{given['deviation']:g}"))
    if kind == "lognormal" and given["mean"] <= 0.0:
        found.append(Problem("mean", "must be above 0 for lognormal", got=f"{given['mean']:g}"))
    if not given.get("low", -math.inf) < given.get("high", math.inf):
        got = f"{given['low']:g} and {given['high']:g}"
        found.append(Problem("high", "must be above low", got=got))
    if kind == "triangular" and not found and not given["low"] <= given["mode"] <= given["high"]:
        found.append(Problem("mode", "must lie between low and high", got=f"{given['mode']:g}"))
    if kind == "normal" and not found and ("low" in given or "high" in given):
        inside = ndtr((given.get("high", math.inf) - given["mean"]) / given["deviation"]) - ndtr(
            (given.get("low", -math.inf) - given["mean"]) / given["deviation"]
        )
        if inside < 1e-6:
            found.append(Problem("low", "cuts off nearly everything", got=f"{inside:.1e} is left"))
    return found


def of_sample(sample: tuple[float, ...], normals: FloatArray) -> FloatArray:
    """Return the values of a measured sample at standard normal numbers.

    Between the sorted values linearly; beyond the least and the greatest there is nothing, however
    rare: what was never measured does not happen.

    Examples
    --------
    >>> of_sample((1.0, 3.0, 2.0), np.array([0.0, -9.0])).tolist()
    [2.0, 1.0]
    """
    ordered: FloatArray = Empirical(values=sample).ppf(ndtr(normals))
    return ordered


def value(kind: str, given: dict[str, float], normals: FloatArray) -> FloatArray:
    """Return the values of a distribution at standard normal numbers.

    Parameters
    ----------
    kind : str
        One of `NEEDS`.
    given : dict
        Its numbers; for ``lognormal`` mean and standard deviation of the value itself.
    normals : array
        Standard normal numbers.

    Returns
    -------
    values : array
        Rising with the normals, in the unit of the numbers given.

    Examples
    --------
    >>> value("uniform", {"low": 0.0, "high": 4.0}, np.array([0.0])).item()
    2.0
    """
    if kind == "lognormal":
        variance = math.log1p((given["deviation"] / given["mean"]) ** 2)
        grown: FloatArray = np.exp(math.sqrt(variance) * normals - 0.5 * variance)
        return given["mean"] * grown
    if kind == "uniform":
        share: FloatArray = ndtr(normals)
        return given["low"] + (given["high"] - given["low"]) * share
    if kind == "triangular":
        return _triangular(given["low"], given["mode"], given["high"], normals)
    mean, deviation = given["mean"], given["deviation"]
    if "low" in given or "high" in given:
        low = (given.get("low", -math.inf) - mean) / deviation
        high = (given.get("high", math.inf) - mean) / deviation
        normals = _truncated(low, high, normals)
    return mean + deviation * normals


def _truncated(low: float, high: float, normals: FloatArray) -> FloatArray:
    """Return standard normal numbers that are kept between two bounds."""
    below, above = ndtr(low), ndtr(-high)
    p = below + ndtr(normals) * (1.0 - below - above)
    q = above + ndtr(-normals) * (1.0 - below - above)
    # from whichever tail is the smaller, so that no digit is lost
    kept: FloatArray = np.clip(np.where(p < 0.5, ndtri(p), -ndtri(q)), low, high)
    return kept


def _triangular(low: float, mode: float, high: float, normals: FloatArray) -> FloatArray:
    width, rising = high - low, mode - low
    p, q = ndtr(normals), ndtr(-normals)
    values: FloatArray = np.where(
        p * width < rising,
        low + np.sqrt(p * width * rising),
        high - np.sqrt(q * width * (high - mode)),
    )
    return values
