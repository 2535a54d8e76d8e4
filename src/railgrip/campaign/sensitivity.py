"""Which variable matters most: Sobol indices by Saltelli's scheme, and a tornado."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from railgrip.campaign.batch import Batches
from railgrip.campaign.sampling import uniform_numbers
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.plan import FloatArray

ENDS = (0.05, 0.95)
"""Quantiles between which a tornado swings each variable."""


class Index(NamedTuple):
    """What a variable does to a figure.

    Attributes
    ----------
    name : str
        The variable; all its columns (vehicles, bogies, axles) together.
    first, first_low, first_high : float
        Share of the variance that it makes alone, with the bootstrap's 95 % interval.
    total, total_low, total_high : float
        Share that it takes part in.
    """

    name: str
    first: float
    first_low: float
    first_high: float
    total: float
    total_low: float
    total_high: float


class Swing(NamedTuple):
    """A figure with one variable at its 5 % and its 95 % quantile, all others at their median."""

    name: str
    low: float
    high: float


def sobol_indices(batches: Batches, figure: str, n: int) -> list[Index]:
    """Return first-order and total indices of every variable, largest total first.

    Parameters
    ----------
    batches : Batches
        The campaign; its variables must not be correlated.
    figure : str
        A kept figure.
    n : int
        Base sample, a power of two; n·(variables + 2) runs are made.

    References
    ----------
    .. [1] A. Saltelli and others, Variance based sensitivity analysis of model output, Comput.
       Phys. Commun. 181 (2010) 259–270.
    """
    from scipy.stats import sobol_indices as indices

    _refuse_correlated(batches)
    if n < 2 or n & (n - 1):
        raise RailgripError(Problem("runs", "must be a power of two", got=f"{n}"))
    drawing = batches.drawing
    labels = [variable.label for variable in batches.campaign.variable]
    seed = batches.campaign.sampling.seed
    both = [*drawing.names, *(f"{name} again" for name in drawing.names)]
    u = uniform_numbers("sobol", seed, both, 0, n, n)
    one, other = u[:, : len(drawing.names)], u[:, len(drawing.names) :]
    mixed = []
    for label in labels:
        changed = one.copy()
        for i, column in enumerate(drawing.columns):
            if column.variable.label == label:
                changed[:, i] = other[:, i]
        mixed.append(_figure(batches, changed, figure))
    a, b, ab = _figure(batches, one, figure), _figure(batches, other, figure), np.array(mixed)
    found = indices(func={"f_A": a[None], "f_B": b[None], "f_AB": ab[:, None]}, n=n)
    spread = found.bootstrap(confidence_level=0.95, n_resamples=499)
    firsts, totals = spread.first_order.confidence_interval, spread.total_order.confidence_interval
    rows = [
        Index(
            label,
            *(float(np.ravel(part)[i]) for part in
              (found.first_order, firsts.low, firsts.high, found.total_order, totals.low,
               totals.high)),
        )
        for i, label in enumerate(labels)
    ]  # fmt: skip
    return sorted(rows, key=lambda row: -row.total)


def tornado(batches: Batches, figure: str) -> tuple[float, list[Swing]]:
    """Return the figure at all medians, and its swing under each variable, widest first."""
    drawing = batches.drawing
    labels = [variable.label for variable in batches.campaign.variable]
    u = np.full((1 + 2 * len(labels), len(drawing.names)), 0.5)
    for i, column in enumerate(drawing.columns):
        row = 1 + 2 * labels.index(column.variable.label)
        u[row, i], u[row + 1, i] = ENDS
    values = _figure(batches, u, figure)
    swings = [
        Swing(label, float(values[1 + 2 * i]), float(values[2 + 2 * i]))
        for i, label in enumerate(labels)
    ]
    return float(values[0]), sorted(swings, key=lambda swing: -abs(swing.high - swing.low))


def _figure(batches: Batches, u: FloatArray, figure: str) -> FloatArray:
    # all with the same number: the same random rail, so that only the draws differ
    number = np.zeros(len(u), dtype=np.int64)
    values = batches.figures(batches.drawing.values(u), number)[figure]
    if not np.isfinite(values).all():
        bad = int((~np.isfinite(values)).sum())
        raise RailgripError(Problem(figure, f"{bad} of {len(values)} runs have none"))
    return np.asarray(values, dtype=float)


def _refuse_correlated(batches: Batches) -> None:
    if batches.campaign.correlation:
        what = "Sobol indices are defined for independent variables"
        raise RailgripError(Problem("correlation", what, cure="the tornado"))
