"""Closed-form gains, error and lag of the adhesion observer against the Riccati equation."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are

from railgrip.control.adhesion_kalman import kalata_gains, observe_by_kalman

DT = 0.01
MASS = 2400.0


def riccati(index: float) -> tuple[np.ndarray, np.ndarray]:
    """Gain and error covariance after a measurement, in units of the noise and the period."""
    step = np.array([[1.0, 1.0], [0.0, 1.0]])
    noise = index**2 * np.array([[0.25, 0.5], [0.5, 1.0]])
    look = np.array([[1.0, 0.0]])
    before = solve_discrete_are(step.T, look.T, noise, np.eye(1))
    gain = before @ look.T / (look @ before @ look.T + 1.0)
    return gain[:, 0], (np.eye(2) - gain @ look) @ before


@pytest.mark.parametrize("index", [0.01, 0.05, 0.125, 0.5, 2.0, 10.0])
def test_the_gains_are_those_of_the_riccati_equation(index: float) -> None:
    assert kalata_gains(index) == pytest.approx(tuple(riccati(index)[0]), rel=1e-8)


def followed(force: np.ndarray, index: float, noise: float = 0.0, seed: int = 1) -> np.ndarray:
    """Return what is observed of a wheel that 20 kN drive against these mean forces."""
    random = np.random.default_rng(seed).normal(0.0, noise, len(force)) if noise else 0.0 * force
    speed = np.cumsum((20e3 - force) / MASS * DT)
    believed, found = (0.0, force[0]), np.empty(len(force))
    for i, measured in enumerate(speed + random):
        believed = observe_by_kalman(measured, *believed, 20e3, MASS, index, DT)
        found[i] = believed[1]
    return found


@pytest.mark.parametrize("index", [0.05, 0.125, 0.5])
def test_a_steady_rise_is_followed_with_the_lag_of_theory(index: float) -> None:
    """Tolerance 1e-6: what is left of the transient after 20 s. A lag of half a period shows."""
    alpha, beta = kalata_gains(index)
    rate = 1.0e3
    time = np.arange(2000) * DT
    # the mean force of a period that ends at `time`
    error = rate * time[-1] - followed(rate * (time - 0.5 * DT), index)[-1]
    assert error / rate == pytest.approx((alpha / beta - 0.5) * DT, rel=1e-6)


def test_the_noise_of_the_force_is_that_of_theory() -> None:
    """60 000 samples of a constant force; the filter forgets in 0.1 s, so 4 % is four sigma.

    A constant force has no process noise: the variance is that of the noise through the filter,
    by the Lyapunov sum of its impulse response, not the covariance that the filter believes in.
    """
    index, noise = 0.125, 0.02
    found = followed(np.full(60_000, 8e3), index, noise)[1000:]
    pulse = np.zeros(2000)
    answer = np.empty(2000)
    pulse[0] = 1.0
    believed = (0.0, 0.0)
    for i, measured in enumerate(pulse):
        believed = observe_by_kalman(measured, *believed, 0.0, MASS, index, DT)
        answer[i] = believed[1]
    assert found.std() == pytest.approx(noise * np.sqrt((answer**2).sum()), rel=0.04)
    assert found.mean() == pytest.approx(8e3, rel=1e-2)


def test_a_force_that_walks_is_found_as_closely_as_theory_says() -> None:
    """With the model's own noise the error has the Riccati equation's covariance, within 4 %."""
    index, noise = 0.125, 0.02
    rate = index * noise / DT**2  # m/s³
    random = np.random.default_rng(5)
    jerk = random.normal(0.0, rate, 60_000)
    pull = np.concatenate(([0.0], np.cumsum(jerk * DT)))  # -F/m at the period's ends
    mean = 0.5 * (pull[:-1] + pull[1:])
    found = followed(-MASS * mean, index, noise, seed=6)
    error = (found / MASS + pull[1:])[1000:]
    believed = np.sqrt(riccati(index)[1][1, 1]) * noise / DT
    assert error.std() == pytest.approx(believed, rel=0.04)
