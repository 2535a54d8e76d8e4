"""From the numbers of a fit to those of a pad: friction, break points, factors, slopes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.stats import t as student

from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.data import UNITS
from railgrip.laboratory.pad_fit.fitting import Fit
from railgrip.laboratory.pad_fit.laws import Product
from railgrip.laboratory.pad_fit.shape import Placed, hats

REFERENCE = {"temperature": 100.0, "speed": 15.0, "clamp_force": 25e3}
"""Where all factors are 1, as in the source's figure 1."""
LEAST_STOPS = 6
"""Fewer stops say nothing of the scatter between stops."""


class Parameter(NamedTuple):
    """One number of a pad with its 95 % interval, NaN where the stops are too few.

    Attributes
    ----------
    name : str
        E.g. ``reference_friction``, ``temperature_point_1``, ``speed_factor_2``, ``speed_slope_1``.
    value, low, high : float
        SI, temperatures in °C.
    unit : str
        Of them; ``""`` for plain numbers.
    is_fixed : bool
        True where it was not found but given, or is 1 by definition.
    """

    name: str
    value: float
    low: float
    high: float
    unit: str
    is_fixed: bool = False


def parameters_of(
    fit: Fit, stops: int, reference: dict[str, float], *, naive: bool = False
) -> list[Parameter]:
    """Return the numbers of a pad with their 95 % intervals.

    Parameters
    ----------
    fit : Fit
        Of a `Product` law.
    stops : int
        How many stops it was fitted to.
    reference : dict
        Influence → where its factor is 1.
    naive : bool
        Intervals as if all blocks were independent; for comparison only.

    Returns
    -------
    list of Parameter
        Reference friction, then point, factor and slope of each function, then lags.

    Notes
    -----
    Intervals are the value ± t(0.975, stops − 1) standard errors, carried from the fitted numbers
    by the first derivative.
    """
    law = fit.law
    assert isinstance(law, Product)
    values, names, units = _derived(law, fit.theta, reference)
    spread = _jacobian(law, fit.theta, reference)
    covariance = fit.naive if naive else fit.covariance
    errors = np.sqrt(np.maximum(np.einsum("ap,pq,aq->a", spread, covariance, spread), 0.0))
    enough = stops >= LEAST_STOPS or naive
    reach = student.ppf(0.975, stops - 1) if enough else np.nan
    found = []
    for name, unit, value, error, row in zip(names, units, values, errors, spread, strict=True):
        scale = abs(value) or 1.0
        is_fixed = bool((np.abs(row) * (1 + np.abs(fit.theta)) < 1e-6 * scale).all())
        half = 0.0 if is_fixed else float(reach * error)
        found.append(Parameter(name, float(value), float(value - half), float(value + half), unit,
                               is_fixed))  # fmt: skip
    return found


def curve_points(
    placed: Placed, numbers: FloatArray, reference: float
) -> list[tuple[float, float]]:
    """Return the points of a function, normalised to 1 at the reference."""
    places, values = placed.places(numbers), placed.values(numbers)
    at_reference = float(hats(places, np.array([reference]))[0] @ values)
    return [(float(x), float(y / at_reference)) for x, y in zip(places, values, strict=True)]


def _derived(
    law: Product, theta: FloatArray, reference: dict[str, float]
) -> tuple[FloatArray, list[str], list[str]]:
    numbers, _ = law.parts(theta)
    friction = float(np.exp(theta[0]))
    values: list[float] = []
    names: list[str] = []
    units: list[str] = []
    for name, placed in law.functions.items():
        places, heights = placed.places(numbers[name]), placed.values(numbers[name])
        at_reference = float(hats(places, np.array([reference[name]]))[0] @ heights)
        friction *= at_reference
        factors = heights / at_reference
        slopes = np.diff(factors) / np.diff(places)
        unit = UNITS[name]
        per = {"°C": "1/K"}.get(unit, f"1/({unit})" if "/" in unit else f"1/{unit}")
        for kind, row, of in (("point", places, unit), ("factor", factors, ""),
                              ("slope", slopes, per)):  # fmt: skip
            values += row.tolist()
            names += [f"{name}_{kind}_{k + 1}" for k in range(len(row))]
            units += [of] * len(row)
    for k, name in enumerate(law.fitted_lags):
        values.append(float(theta[len(theta) - len(law.fitted_lags) + k]))
        names.append(f"{name}_lag")
        units.append("s")
    return np.array([friction, *values]), ["reference_friction", *names], ["", *units]


def _jacobian(law: Product, theta: FloatArray, reference: dict[str, float]) -> FloatArray:
    rows = []
    for k in range(len(theta)):
        step = 1e-6 * max(abs(theta[k]), 1e-3)
        ends = [theta.copy(), theta.copy()]
        ends[0][k] -= step
        ends[1][k] += step
        below, above = (_derived(law, end, reference)[0] for end in ends)
        rows.append((above - below) / (2 * step))
    return np.array(rows).T
