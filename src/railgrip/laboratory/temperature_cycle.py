"""Temperature of one point that is heated again and again: of the tread, or of the rail.

Each pulse of heat flux q raises the surface of a half-space by 2q√(t/π)/β from its start and lowers
it likewise from its end; the pulses add up.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.heat_pulses import HeatPulses

Array = NDArray[np.float64]

_STEP = 0.5
"""Step of ln s in 1/√t = π^(−1/2) ∫ e^(−ts) s^(−1/2) ds: relative error e^(−π²/step) = 3e-9."""


def pulse_rises(pulses: HeatPulses, effusivity: float, times: ArrayLike) -> Array:
    """Rise of the surface at any times, from all pulses before.

    Parameters
    ----------
    pulses : HeatPulses
        From `wheel_pulses` or `rail_pulses`.
    effusivity : float
        β of the body [W√s/(m²K)].
    times : array_like, shape (m,)
        In any order [s].

    Returns
    -------
    ndarray, shape (m,)
        Rise over the temperature before the first pulse [K].

    Raises
    ------
    RailgripError
        "the effusivity must be positive".

    Notes
    -----
    ΔT(t) = Σ q_n/(β√π) ∫ (t − t')^(−1/2) dt' over the part of pulse n before t. The last two pulses
    are summed as they stand; the ones before through 1/√t as a sum of some fifty exponentials,
    whose amplitudes are carried from pulse to pulse, so that the work grows with n + m and not with
    n · m. Error below 1e-7 of the greatest rise.
    Known wrong when heat spreads sideways, after about b²/κ (7 s for b = 10 mm), or meets the inner
    side of the rim: the growing mean is then too large, see `railgrip.laboratory.wheel_bulk`.
    The single tooth lasts some ms and stays right.

    Checked by tests/reference/temperature_cycle against the plain sum, and by a numerical march.

    Examples
    --------
    >>> once = HeatPulses(0.0, 1e-3, 1e8)
    >>> pulse_rises(once, 13290.0, [1e-3, 4e-3]).round(3).tolist()
    [268.491, 71.942]
    """
    if not 0.0 < effusivity < math.inf:
        raise RailgripError(
            Problem("effusivity", "the effusivity must be positive", got=f"{effusivity}")
        )
    t = np.atleast_1d(np.asarray(times, float))
    last = np.searchsorted(pulses.start, t, side="right") - 1
    rise = np.zeros(t.shape)
    for back in (0, 1):
        n = last - back
        is_there = n >= 0
        n = np.maximum(n, 0)
        roots = np.sqrt(np.maximum(t - pulses.start[n], 0.0))
        roots -= np.sqrt(np.maximum(t - pulses.end[n], 0.0))
        rise += np.where(is_there, 2.0 * pulses.flux[n] * roots, 0.0)
    rise += _history(pulses, t, last - 1)
    return rise / (effusivity * math.sqrt(math.pi))


def _history(pulses: HeatPulses, t: Array, before: NDArray[np.intp]) -> Array:
    """Σ q ∫ (t − t')^(−1/2) dt' over all pulses whose number is below `before`."""
    if pulses.start.size < 3 or before.max() < 1:
        return np.zeros(t.shape)
    steps = np.diff(pulses.start)
    longest = max(float(t.max()), float(pulses.end[-1])) - float(pulses.start[0])
    rates, weights = _exponentials(float(steps.min()), longest)
    # amplitude of each exponential at the start of pulse n, from all pulses before n
    amplitude = np.zeros((pulses.start.size + 1, rates.size))
    for k in range(pulses.start.size - 1):
        length, step = pulses.duration[k], steps[k]
        gained = np.exp(-rates * (step - length)) * -np.expm1(-rates * length) / rates
        amplitude[k + 1] = amplitude[k] * np.exp(-rates * step) + pulses.flux[k] * gained
    n = np.clip(before, 0, pulses.start.size - 1)
    lag = np.maximum(t - pulses.start[n], 0.0)
    carried = amplitude[n] * np.exp(-rates * lag[:, None])
    return np.where(before > 0, carried @ weights, 0.0)


def _exponentials(shortest: float, longest: float) -> tuple[Array, Array]:
    """Rates and weights with Σ w e^(−st) = 1/√t for shortest ≤ t ≤ longest."""
    low, high = math.log(1e-6 / longest), math.log(25.0 / shortest)
    rates = np.exp(np.arange(low, high + _STEP, _STEP))
    weights = _STEP * np.sqrt(rates / math.pi)
    # all slower rates act like one: their weights are a geometric series
    slower = weights[0] / math.expm1(0.5 * _STEP)
    return np.concatenate([[1e-3 * rates[0]], rates]), np.concatenate([[slower], weights])
