"""What the data say of each influence before any shape is asked for: an additive fit of hats."""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np
from scipy.stats import f as f_distribution

from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.data import INFLUENCES, Blocks
from railgrip.laboratory.pad_fit.fitting import Fit, fit_law
from railgrip.laboratory.pad_fit.laws import Lags
from railgrip.laboratory.pad_fit.shape import LEAST_GAP, Placed, Shape, hats

KNOTS = 7
BINS = 60
_CANDIDATES = {1: 40, 2: 26, 3: 15, 4: 12}


class Additive(NamedTuple):
    """log μ = a + Σ g_i(x_i), each g_i straight lines through knots; linear in its parameters.

    Parameters
    ----------
    knots : dict
        Influence → where its curve is told, ascending.
    lags : Lags
        Of the sensors, all as given.
    """

    knots: dict[str, FloatArray]
    lags: Lags = Lags()

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each parameter."""
        inner = [f"{name}_{k}" for name, xs in self.knots.items() for k in range(1, len(xs))]
        return ("level", *inner)

    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Least and greatest of each parameter: none."""
        n = len(self.names)
        return np.full(n, -np.inf), np.full(n, np.inf)

    def inputs(self, name: str, blocks: Blocks) -> FloatArray:
        """Return an influence as it was when the friction was measured."""
        k = INFLUENCES.index(name)
        shift = self.lags.given[k] - self.lags.friction
        return np.asarray(blocks.values[k] + shift * blocks.slopes[k])

    def columns(self, blocks: Blocks) -> FloatArray:
        """Return the hats of all influences, the first of each left out."""
        found = [np.ones((*blocks.time.shape, 1))]
        found += [hats(xs, self.inputs(f, blocks))[..., 1:] for f, xs in self.knots.items()]
        return np.concatenate(found, axis=-1)

    def log_friction(self, theta: FloatArray, blocks: Blocks) -> tuple[FloatArray, FloatArray]:
        """Logarithm of the friction (stop, block), and its derivative to each parameter."""
        columns = self.columns(blocks)
        return columns @ theta, columns

    def part(self, name: str) -> slice:
        """Return where the parameters of an influence stand."""
        begin = 1
        for other, xs in self.knots.items():
            if other == name:
                return slice(begin, begin + len(xs) - 1)
            begin += len(xs) - 1
        raise KeyError(name)


def range_of(name: str, blocks: Blocks) -> tuple[float, float]:
    """Return the range of an influence without its outermost thousandths."""
    values = blocks.values[INFLUENCES.index(name)][blocks.is_there]
    low, high = np.quantile(values, [0.002, 0.998])
    return float(low), float(high)


def additive_fit(names: list[str], blocks: Blocks, lags: Lags) -> Fit:
    """Fit curves of all named influences at once.

    Parameters
    ----------
    names : list of str
        Influences that vary.
    blocks : Blocks
        Of at least two stops.
    lags : Lags
        Of the sensors.

    Returns
    -------
    Fit
        Of an `Additive` law.
    """
    knots = {}
    for name in names:
        values = blocks.values[INFLUENCES.index(name)][blocks.is_there]
        # knots in equal parts of the data: none stands where nothing was measured
        places = np.quantile(values, np.linspace(0.002, 0.998, KNOTS))
        low, high = places[0], places[-1]
        kept = np.concatenate([[True], np.diff(places) > 0.02 * (high - low)])
        knots[name] = places[kept] if kept.sum() > 1 else np.array([low, high])
    law = Additive(knots, lags)
    return fit_law(law, blocks, np.zeros(len(law.names)), rounds=2)


def chance_of_no_effect(name: str, fit: Fit, stops: int) -> float:
    """Return how probable a curve like this is if the influence has no effect (Wald, by stop)."""
    law = fit.law
    assert isinstance(law, Additive)
    part = law.part(name)
    curve, covariance = fit.theta[part], fit.covariance[part, part]
    n = len(curve)
    freedom = max(stops - n, 2)
    statistic = curve @ np.linalg.pinv(covariance, hermitian=True) @ curve / n
    return float(f_distribution.sf(statistic * freedom / max(stops - 1, 1), n, freedom))


def first_guess(placed: Placed, name: str, fit: Fit, blocks: Blocks) -> FloatArray:
    """Return parameters of a shape that follow the additive curve of its influence.

    All choices of break points on a grid are tried; the parameters of the best are returned.
    """
    law = fit.law
    assert isinstance(law, Additive)
    x = law.inputs(name, blocks)[blocks.is_there]
    curve = np.concatenate([[0.0], fit.theta[law.part(name)]])
    own = hats(law.knots[name], x) @ curve
    heights = np.exp(own + fit.residuals[blocks.is_there])
    edges = np.linspace(placed.low, placed.high, BINS + 1)
    bin_of = np.clip(np.searchsorted(edges, x) - 1, 0, BINS - 1)
    counts = np.bincount(bin_of, minlength=BINS)
    full = counts > 0
    means = np.bincount(bin_of, heights, BINS)[full] / counts[full]
    centres = np.bincount(bin_of, x, BINS)[full] / counts[full]
    root = np.sqrt(np.minimum(counts[full], np.median(counts[full])))
    best, found = np.inf, np.empty(0)
    for places in _choices(placed):
        shares = hats(places, centres) * root[:, None]
        values, *_ = np.linalg.lstsq(shares, means * root, rcond=None)
        miss = float(np.sum((shares @ values - means * root) ** 2))
        if miss < best and (values > 0.05).all():
            best, found = miss, placed.numbers(places, np.clip(values / values[0], 0.06, 19.0))
    return (
        found if len(found) else placed.numbers(next(iter(_choices(placed))), np.ones(_n(placed)))
    )


def _n(placed: Placed) -> int:
    return len(placed.shape.at) or placed.shape.points


def _choices(placed: Placed) -> list[FloatArray]:
    shape: Shape = placed.shape
    if not shape.free_points:
        return [placed.places(np.empty(0))]
    inner = LEAST_GAP * (placed.high - placed.low)
    grid = np.linspace(placed.low + inner, placed.high - inner, _CANDIDATES[shape.free_points])
    gaps = [np.diff(one, prepend=0.0) for one in combinations(grid, shape.free_points)]
    return [placed.places(one) for one in gaps]
