"""Stops of a known pad, measured as badly as on a real train: to try the identification on."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.signal import lfilter

from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.data import PadStops

PadLaw = Callable[[FloatArray, FloatArray, FloatArray], FloatArray]
"""Friction from disc temperature [°C], rubbing speed [m/s] and clamp force [N]."""


class Programme(NamedTuple):
    """A programme of stops and the faults of its measurement.

    Parameters
    ----------
    stops, samples : int
        How many, and of each.
    speed, temperature, clamp_force : tuple of float
        Range of the start of each stop, uniform: rubbing speed [m/s], disc [°C], force [N].
    force_steps : int
        How many levels of force a stop has; 1: constant in the stop.
    disc_heat : float
        Heat capacity of the friction ring [J/K].
    train_force : float
        Clamp force that decelerates the rubbing speed by 1 m/s² at a friction of 1 [N].
    offset, noise, memory : float
        Standard deviation of log μ common to a stop; of its noise; time constant of the noise [s].
    lag : float
        Of the temperature sensor, first order [s].
    outliers : float
        Share of samples that lie off by up to 50 %, most of them in bursts.
    """

    stops: int = 120
    samples: int = 160
    speed: tuple[float, float] = (10.0, 55.0)
    temperature: tuple[float, float] = (20.0, 250.0)
    clamp_force: tuple[float, float] = (8e3, 42e3)
    force_steps: int = 3
    disc_heat: float = 30e3
    train_force: float = 11e3
    offset: float = 0.03
    noise: float = 0.03
    memory: float = 1.0
    lag: float = 2.0
    outliers: float = 0.01


def product_law(
    friction: float,
    temperature: list[tuple[float, float]],
    speed: list[tuple[float, float]],
    clamp_force: list[tuple[float, float]],
) -> PadLaw:
    """Return f0 · f1(T) · f2(v) · f3(F) as a function of arrays."""

    def of(points: list[tuple[float, float]], x: FloatArray) -> FloatArray:
        xs, ys = np.array(points).T
        return np.asarray(np.interp(x, xs, ys))

    return lambda t, v, f: friction * of(temperature, t) * of(speed, v) * of(clamp_force, f)


ORGANIC_POINTS = {
    "temperature": [(150.0, 1.0), (350.0, 0.75)],
    "speed": [(20.0, 1.0), (42.0, 0.88)],
    "clamp_force": [(15e3, 1.08), (33e3, 0.944)],
}
"""An organic pad's fading, as in the shipped pad; force and speed bend inside the programme."""

organic = product_law(0.37, **ORGANIC_POINTS)


def synthetic_stops(law: PadLaw, programme: Programme, *, seed: int) -> PadStops:
    """Return measured stops of a pad whose law is known.

    Parameters
    ----------
    law : callable
        Friction from temperature, speed and force, arrays.
    programme : Programme
        The stops, and how badly they are measured.
    seed : int
        Of all that is random.

    Returns
    -------
    PadStops
        Samples of each stop from the full clamp force to a rubbing speed of 1 m/s.

    Notes
    -----
    The train slows by μ F / train_force, the ring warms by μ F v / disc_heat less a slow cooling;
    the friction that acts is the law's times the stop's offset and noise, and what is measured is
    that, with outliers; the temperature through its lag.

    Examples
    --------
    >>> stops = synthetic_stops(organic, Programme(stops=3, samples=50), seed=1)
    >>> len(stops.time), int(stops.stop[-1])
    (150, 2)
    """
    random = np.random.default_rng(seed)
    n, m = programme.stops, programme.samples
    start, heat = (random.uniform(*one, n) for one in (programme.speed, programme.temperature))
    forces = random.uniform(*programme.clamp_force, (n, programme.force_steps))
    true = _stops(law, programme, start, heat, forces)
    time, speed, warm, force, ideal = true
    step = time[:, 1:2] - time[:, :1]
    slow = _correlated(random, time.shape, np.exp(-step / programme.memory))
    odd = _outliers(random, time.shape, programme.outliers)
    common = programme.offset * random.standard_normal((n, 1))
    measured = ideal * np.exp(common + programme.noise * slow) * odd
    sensed = _lagged(warm, np.exp(-step / max(programme.lag, 1e-9)))
    flat = [
        time,
        measured,
        sensed + 0.5 * random.standard_normal(time.shape),
        np.maximum(speed * (1 + 0.002 * random.standard_normal(time.shape)), 0.0),
        force * (1 + 0.005 * random.standard_normal(time.shape)),
    ]
    return PadStops(np.repeat(np.arange(n), m), *(one.ravel() for one in flat))


def _stops(
    law: PadLaw, programme: Programme, start: FloatArray, heat: FloatArray, forces: FloatArray
) -> list[FloatArray]:
    """Return time, speed, temperature, force and friction of each stop (stop, sample)."""
    n, m = programme.stops, programme.samples
    mean = forces.mean(axis=1)
    rough = law(heat + 60.0, 0.5 * start, mean)
    lasting = (start - 1.0) / (rough * mean / programme.train_force)
    step = lasting / m
    speed, warm, time = start.copy(), heat.copy(), np.zeros(n)
    found: list[list[FloatArray]] = [[] for _ in range(5)]
    for k in range(m):
        force = forces[:, k * programme.force_steps // m]
        friction = law(warm, speed, force)
        for row, value in zip(found, (time, speed, warm, force, friction), strict=True):
            row.append(value)
        power = friction * force * speed
        time = time + step
        speed = np.maximum(speed - step * friction * force / programme.train_force, 0.5)
        warm = warm + step * (power / programme.disc_heat - (warm - 20.0) / 400.0)
    return [np.array(row).T for row in found]


def _correlated(
    random: np.random.Generator, shape: tuple[int, ...], decay: FloatArray
) -> FloatArray:
    white = random.standard_normal(shape)
    white[:, 1:] *= np.sqrt(1.0 - decay**2)
    rows = [lfilter([1.0], [1.0, -d], row) for d, row in zip(decay[:, 0], white, strict=True)]
    return np.array(rows)


def _lagged(values: FloatArray, decay: FloatArray) -> FloatArray:
    """Return a first-order lag of values that run straight between samples."""
    rows = []
    for d, row in zip(decay[:, 0], values, strict=True):
        if d < 1e-12:
            rows.append(row)
            continue
        ratio = (1.0 - d) / -np.log(d)
        ahead, behind = 1.0 - ratio, ratio - d
        first = lfilter([ahead, behind], [1.0, -d], row - row[0]) + row[0]
        rows.append(first)
    return np.array(rows)


def _outliers(random: np.random.Generator, shape: tuple[int, ...], share: float) -> FloatArray:
    """Return factors: 1, and for a share of samples, in bursts of four, something between."""
    begins = random.random(shape) < share / 4.0
    odd = np.zeros(shape, dtype=bool)
    for late in range(4):
        odd[:, late:] |= begins[:, : shape[1] - late]
    return np.where(odd, random.uniform(0.5, 1.5, shape), 1.0)
