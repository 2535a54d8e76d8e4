"""Robust least squares with residuals that hang together within a stop, and honest intervals."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.data import Blocks
from railgrip.laboratory.pad_fit.laws import Law
from railgrip.laboratory.pad_fit.noise import Noise, Weights, noise_of, weights_of, whitener

MOST_STEPS = 60
HALVINGS = 6
LEAST_HALVED = 12
"""Fewer stops cannot be halved and fitted."""
ROUNDS = 3
"""How often noise and weights are estimated anew from the residuals."""


class Fit(NamedTuple):
    """A law fitted to blocks.

    Attributes
    ----------
    law : Law
        What was fitted.
    theta : ndarray (parameter,)
        Its parameters.
    covariance : ndarray (parameter, parameter)
        Of them, clustered by stop.
    naive : ndarray (parameter, parameter)
        The same as if all blocks were independent: far too small, for comparison only.
    residuals : ndarray (stop, block)
        log of measured over fitted friction; 0 in the padding.
    noise : Noise
        Covariance within a stop.
    weights : Weights
        How much blocks and stops counted.
    """

    law: Law
    theta: FloatArray
    covariance: FloatArray
    naive: FloatArray
    residuals: FloatArray
    noise: Noise
    weights: Weights


def fit_law(
    law: Law, blocks: Blocks, start: FloatArray, rounds: int = ROUNDS, *, intervals: bool = False
) -> Fit:
    """Fit a law by generalised least squares, noise and outliers found on the way.

    Parameters
    ----------
    law : Law
        What to fit.
    blocks : Blocks
        Of at least two stops.
    start : ndarray (parameter,)
        First guess.
    rounds : int
        How often noise and weights are estimated anew.
    intervals : bool
        Whether halves of the stops are fitted too, for the errors of break points; see `halved`.

    Returns
    -------
    Fit
        With the covariance of the parameters clustered by stop.

    Notes
    -----
    Residuals r = log μ − log μ̂ of a stop have the covariance V of `Noise`; r'V⁻¹r is made least.
    Blocks and stops far out get a variance of their own (Tukey's biweight). Whether or not V is
    right, the covariance of the parameters is the sandwich B (Σ g_i g_iᵀ) B over stops, with
    g_i = J_iᵀ (I − J_i B J_iᵀ)⁻¹ r_i: nearly what leaving one stop out would give (CR3).

    References
    ----------
    .. [1] R. M. Bell, D. F. McCaffrey, Bias reduction in standard errors for linear regression
       with multi-stage samples, Survey Methodology 28 (2002) 169–181, eqs. 8 and 12.
    .. [2] A. C. Cameron, D. L. Miller, A practitioner's guide to cluster-robust inference, Journal
       of Human Resources 50 (2015) 317–372, section VI.B.
    """
    low, high = law.bounds()
    theta = _inside(start, low, high)
    noise = Noise()
    weights = Weights(np.ones(blocks.time.shape), np.ones(blocks.stops))
    for _ in range(rounds):
        residuals = residuals_of(law, theta, blocks)
        noise = noise_of(residuals, blocks)
        weights = weights_of(residuals, noise, blocks)
        theta = minimise(law, theta, blocks, whitener(noise, weights, blocks))
    residuals = residuals_of(law, theta, blocks)
    covariance = clustered(law, theta, blocks, whitener(noise, weights, blocks))
    if intervals and blocks.stops >= LEAST_HALVED:
        covariance = halved(law, theta, blocks, whitener(noise, weights, blocks), covariance)
    naive = independent(law, theta, blocks)
    return Fit(law, theta, covariance, naive, residuals, noise, weights)


def _inside(start: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
    room = np.where(np.isfinite(high - low), 1e-6 * (high - low), 0.0)
    return np.clip(start, low + room, high - room)


def residuals_of(law: Law, theta: FloatArray, blocks: Blocks) -> FloatArray:
    """Return log of measured over fitted friction, 0 in the padding."""
    fitted, _ = law.log_friction(theta, blocks)
    return np.where(blocks.is_there, blocks.log_friction - fitted, 0.0)


def minimise(
    law: Law, start: FloatArray, blocks: Blocks, white: FloatArray, enough: float = 1e-6
) -> FloatArray:
    """Return the parameters that make the whitened residuals least (Levenberg–Marquardt).

    Steps are cut at the bounds; a residual that bends where a break point passes a block makes
    the sum of squares rough on the scale of single blocks, which damped steps walk over.
    """
    low, high = law.bounds()
    theta, damping = start, 1e-3
    missed, columns = _whitened(law, theta, blocks, white)
    for _ in range(MOST_STEPS):
        whitened = (white @ columns).reshape(-1, len(theta))
        normal, gradient = whitened.T @ whitened, whitened.T @ missed
        scale = np.diag(normal).copy() + 1e-12 * np.trace(normal)
        while True:
            step = np.linalg.solve(normal + damping * np.diag(scale), gradient)
            trial = np.clip(theta + step, low, high)
            tried, others = _whitened(law, trial, blocks, white)
            gained = float(missed @ missed - tried @ tried)
            if gained > 0.0 or damping > 1e6:
                break
            damping *= 8.0
        if gained <= 0.0:
            return theta
        theta, missed, columns = trial, tried, others
        damping = max(damping / 5.0, 1e-9)
        if gained < enough:
            return theta
    return theta


def _whitened(
    law: Law, theta: FloatArray, blocks: Blocks, white: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return whitened residuals (all blocks), and the columns of the Jacobian, not whitened."""
    fitted, columns = law.log_friction(theta, blocks)
    residuals = np.where(blocks.is_there, blocks.log_friction - fitted, 0.0)
    # the whitener is 0 in the padding, whatever stands there
    return (white @ residuals[..., None]).ravel(), columns


def _columns(law: Law, theta: FloatArray, blocks: Blocks) -> FloatArray:
    _, columns = law.log_friction(theta, blocks)
    return np.where(blocks.is_there[..., None], columns, 0.0)


def clustered(law: Law, theta: FloatArray, blocks: Blocks, white: FloatArray) -> FloatArray:
    """Return the covariance of the parameters from the scatter between stops (CR3)."""
    columns = white @ _columns(law, theta, blocks)
    residuals = (white @ residuals_of(law, theta, blocks)[..., None])[..., 0]
    flat = columns.reshape(-1, len(theta))
    bread = np.linalg.pinv(flat.T @ flat, hermitian=True)
    hat = columns @ bread @ columns.transpose(0, 2, 1)
    size = hat.shape[-1]
    scaled = np.linalg.solve(np.eye(size) * (1 + 1e-9) - hat, residuals[..., None])[..., 0]
    scores = np.einsum("ibp,ib->ip", columns, scaled)
    share = (blocks.stops - 1) / blocks.stops
    return np.asarray(share * bread @ (scores.T @ scores) @ bread)


def halved(
    law: Law, theta: FloatArray, blocks: Blocks, white: FloatArray, covariance: FloatArray
) -> FloatArray:
    """Return the covariance, widened where fits to halves of the stops scatter more.

    A break point bends the sum of squares anew at every block it passes, so that its errors are
    greater than slopes at the optimum tell. A half of the stops has twice the variance of all, half
    of which it shares with them: θ_half − θ scatters as θ does.
    """
    random = np.random.default_rng(blocks.stops)
    moved = []
    for _ in range(HALVINGS):
        order = random.permutation(blocks.stops)
        for half in np.array_split(order, 2):
            some = np.zeros(blocks.stops, dtype=bool)
            some[half] = True
            moved.append(minimise(law, theta, blocks.of(some), white[some], 0.02) - theta)
    scatter = np.mean(np.square(moved), axis=0)
    variance = np.maximum(np.diag(covariance), 1e-300)
    widening = np.sqrt(np.maximum(scatter / variance, 1.0))
    return np.asarray(covariance * widening[:, None] * widening[None, :])


def independent(law: Law, theta: FloatArray, blocks: Blocks) -> FloatArray:
    """Return the covariance of the parameters as if every block were a measurement by itself."""
    columns = _columns(law, theta, blocks).reshape(-1, len(theta))
    residuals = residuals_of(law, theta, blocks)
    variance = float(residuals[blocks.is_there].var())
    return np.asarray(variance * np.linalg.pinv(columns.T @ columns, hermitian=True))
