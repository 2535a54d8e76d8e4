"""Which law a pad follows: cross-validation over whole stops."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.data import INFLUENCES, Blocks
from railgrip.laboratory.pad_fit.fitting import Fit, fit_law, minimise, residuals_of
from railgrip.laboratory.pad_fit.identify import Identified
from railgrip.laboratory.pad_fit.laws import Law, Product, Quadratic
from railgrip.laboratory.pad_fit.noise import whitener

FOLDS = 5
MODELS = {"I": ("speed",), "II": ("temperature", "speed"), "III": INFLUENCES}
"""The source's models: which functions each has."""


class Score(NamedTuple):
    """How well a law foretells stops that it was not fitted to.

    Attributes
    ----------
    name : str
        ``constant``, ``I``, ``II``, ``III``, ``quadratic``, ``quadratic_previous``.
    parameters : int
        How many numbers it has.
    error : float
        Root of the mean squared log μ that it misses in stops left out, offsets included.
    error_within : float
        The same with the offset of each stop taken out.
    behind : float
        Mean over stops of the loss of log-likelihood against the best law.
    behind_error : float
        Standard error of it, from stop to stop; 0 for the best.
    is_chosen : bool
        The law with the fewest parameters that is not behind by more than two standard errors.
    """

    name: str
    parameters: int
    error: float
    error_within: float
    behind: float
    behind_error: float
    is_chosen: bool


def laws_of(found: Identified) -> dict[str, tuple[Law, FloatArray]]:
    """Return the laws that these stops can tell, each with a first guess."""
    law = found.fit.law
    assert isinstance(law, Product)
    numbers, lags = law.parts(found.fit.theta)
    laws: dict[str, tuple[Law, FloatArray]] = {}
    level = np.array([float(np.median(found.blocks.log_friction[found.blocks.is_there]))])
    laws["constant"] = (Product({}, law.lags), level)
    for name, parts in MODELS.items():
        functions = {f: placed for f, placed in law.functions.items() if f in parts}
        if functions and set(functions) != set(getattr(laws.get("II", laws.get("I", (None,)))[0],
                                                       "functions", {})):  # fmt: skip
            one = Product(functions, law.lags)
            inner = [numbers[f] for f in functions]
            late = [lags[INFLUENCES.index(f)] for f in one.fitted_lags]
            laws[name] = (one, np.concatenate([level, *inner, late]))
    scales = [0.0, 0.0, 0.0]
    for k in range(3):
        values = found.blocks.values[k][found.blocks.is_there]
        if np.isfinite(values).all() and np.ptp(values) > 1e-3 * abs(values.mean()):
            scales[k] = float(np.abs(values).max())
    known = law.lags._replace(given=(lags[0], lags[1], lags[2]), fitted=())
    for name, back in (("quadratic", 0.0), ("quadratic_previous", 1.0)):
        quadratic = Quadratic((scales[0], scales[1], scales[2]), known, back)
        laws[name] = (quadratic, _regressed(quadratic, found.blocks))
    return laws


def _regressed(law: Quadratic, blocks: Blocks) -> FloatArray:
    columns = law.columns(blocks)[blocks.is_there]
    friction = np.exp(blocks.log_friction[blocks.is_there])
    return np.asarray(np.linalg.lstsq(columns, friction, rcond=None)[0])


def compare_laws(found: Identified, folds: int = FOLDS) -> list[Score]:
    """Compare constant friction, the products and the quadratic laws on stops left out.

    Parameters
    ----------
    found : Identified
        Of at least `folds` stops.
    folds : int
        Into how many parts the stops are dealt; each is foretold from all others.

    Returns
    -------
    list of Score
        Simplest first.

    Notes
    -----
    Log-likelihoods have the covariance within a stop that belongs to the law with the least
    residuals, for all laws the same: what is left is r'V⁻¹r/2. Neighbouring samples are no
    independent test of each other, so whole stops are left out.
    """
    laws = laws_of(found)
    fits = {name: fit_law(law, found.blocks, start) for name, (law, start) in laws.items()}
    best_fit = min(fits.values(), key=_spread)
    white = whitener(best_fit.noise, best_fit.weights, found.blocks)
    losses, squares, inner = {}, {}, {}
    for name, fit in fits.items():
        losses[name], squares[name], inner[name] = _left_out(fit, found.blocks, white, folds)
    best = min(losses, key=lambda name: float(losses[name].mean()))
    behind = {name: one - losses[best] for name, one in losses.items()}
    stops = found.blocks.stops
    errors = {name: float(one.std(ddof=1) / np.sqrt(stops)) for name, one in behind.items()}
    ordered = sorted(laws, key=lambda name: len(laws[name][0].names))
    near = [name for name in ordered if float(behind[name].mean()) <= 2.0 * errors[name]]
    return [
        Score(name, len(laws[name][0].names), squares[name], inner[name],
              float(behind[name].mean()), errors[name], name == near[0])
        for name in ordered
    ]  # fmt: skip


def _spread(fit: Fit) -> float:
    noise = fit.noise
    return noise.offset**2 + noise.slow**2 + noise.fast**2


def _left_out(
    fit: Fit, blocks: Blocks, white: FloatArray, folds: int
) -> tuple[FloatArray, float, float]:
    """Return the loss of each stop, and the root mean squares with and without its offset."""
    numbers = np.arange(blocks.stops)
    losses = np.zeros(blocks.stops)
    missed = np.zeros(blocks.time.shape)
    for fold in range(min(folds, blocks.stops)):
        out = numbers % folds == fold
        theta = minimise(fit.law, fit.theta, blocks.of(~out), white[~out])
        missed[out] = residuals_of(fit.law, theta, blocks.of(out))
        losses[out] = 0.5 * np.sum((white[out] @ missed[out][..., None]) ** 2, axis=(1, 2))
    there = blocks.is_there
    counts = there.sum(axis=1)
    middle = missed.sum(axis=1) / counts
    within = np.where(there, missed - middle[:, None], 0.0)
    root = float(np.sqrt(np.mean(missed[there] ** 2)))
    return losses, root, float(np.sqrt(np.mean(within[there] ** 2)))
