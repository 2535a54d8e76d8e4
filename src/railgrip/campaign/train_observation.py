"""What a train's own measurements tell of its brakes and of the rail.

Speeds, cylinder pressures, motor forces and the deceleration are on board of any train. Newton's
law for the whole train gives the friction of each vehicle's pads as far as the vehicles brake
differently; the observer that the controllers use then gives the adhesion of each axle.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.train_measurements import Array, Measurements, check
from railgrip.control.adhesion_window import observe_friction
from railgrip.control.conventional_state import DYNAMIC, SPEED
from railgrip.control.state_layout import axle_base, state_size
from railgrip.control.temperature_state import FORCE_BEFORE, FRICTION, MASS, N_WINDOW
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.simulate import nominal_numbers
from railgrip.scenario import Scenario

WINDOW = 0.1
"""Over so long the adhesion is averaged, s, as in the controllers."""
SLOPE = 0.5
"""Over so long accelerations are averaged for the balance of the train, s."""
COMMON, EACH = 0.15, 0.08
"""What is known before: pads scatter by so much together, and from vehicle to vehicle (relative
standard deviations; 3 to 5 % and 5 to 8 % are usual, unverified: these leave room)."""
DRIFT, DRIFT_STRETCHES = 0.06, 6.0
"""Friction drifts with speed, heat and the rigging's hysteresis: by so much (relative standard
deviation), correlated over so many stretches."""


class TrainObservation(NamedTuple):
    """What the measurements tell.

    Attributes
    ----------
    friction, friction_error : ndarray (vehicle)
        Mean pad friction of each vehicle, weighted by its clamp force; its standard deviation.
    common, common_error : float
        Of the whole train.
    adhesion : ndarray (axle, time)
        Adhesion used, force of the rail over the static load of the axle; it lags by half of
        `WINDOW`.
    is_sliding : ndarray of bool (axle, time)
        Where the wheel is slower than the train by more than 3 %.
    """

    friction: Array
    friction_error: Array
    common: float
    common_error: float
    adhesion: Array
    is_sliding: NDArray[np.bool_]


def observe(
    scenario: Scenario, *stops: Measurements, deceleration_error: float = 0.02
) -> TrainObservation:
    """Estimate pad friction of each vehicle, and the adhesion of each axle in the last stop.

    Parameters
    ----------
    scenario : Scenario
        For what is known of the train: masses, rigging, resistance.
    *stops : Measurements
        Of one stop or of several. Stops in which one vehicle's brake is cut out tell it from the
        others.
    deceleration_error : float
        Standard deviation of the measured deceleration over `SLOPE`, [m/s²].

    Returns
    -------
    TrainObservation

    Raises
    ------
    RailgripError
        ``time: must be evenly spaced``; ``wheel_speed: has 12 axles; allowed: 16``.

    Notes
    -----
    For the train M D + Σ m_r (−ẇ) = Σ_v μ_v X_v + Σ F_motor + R(v), with X the clamp force times
    its lever, axle by axle. It is solved for the μ_v by Bayes's rule: what the vehicles have in
    common and what sets each apart start with the scatter that is usual, friction may drift during
    a stop, and as much is learned as the data hold. Where all vehicles brake alike only the mean is
    learned, and `friction_error` says so. Known wrong when: the line is not level (its gradient
    counts as friction).

    For the axle F = (∫F* dt − m_r Δw)/Δt, `railgrip.control.adhesion_window` (f8).

    Examples
    --------
    >>> from railgrip.campaign.train_measurements import measurements_of
    >>> import railgrip as rg
    >>> scenario = rg.load("dry_emergency")
    >>> found = observe(scenario, measurements_of(rg.simulate(scenario)))
    >>> round(found.common, 2)
    0.36
    """
    numbers = nominal_numbers(scenario)
    for measured in stops:
        check(measured, scenario.train.n_axles)
    levers = [_lever(numbers, measured) for measured in stops]
    balances = [
        _balance(scenario, measured, numbers, lever)
        for measured, lever in zip(stops, levers, strict=True)
    ]
    error = deceleration_error * float(numbers["TRAIN_MASS"])
    friction, covariance = _bayes(balances, error)
    braked = np.concatenate([rows for rows, _ in balances]).sum(axis=0)
    share = braked / braked.sum()
    vehicle = np.array([place.vehicle for place in scenario.train.axles()])
    measured, lever = stops[-1], levers[-1]
    applied = -(friction[vehicle][:, None] * lever + measured.dynamic_force)
    load = numbers["STATIC_LOAD"]
    force = _rail_force(measured, applied, numbers["ROTATING_MASS"])
    speed = np.maximum(measured.train_speed, 0.1)
    return TrainObservation(
        friction,
        np.sqrt(np.diag(covariance)),
        float(share @ friction),
        float(np.sqrt(share @ covariance @ share)),
        np.abs(force) / load[:, None],
        measured.wheel_speed < 0.97 * speed,
    )


def _lever(numbers: dict[str, Any], measured: Measurements) -> Array:
    """Return the force that a friction of 1 would give at the tread (axle, time), [N]."""
    pressure = measured.brake_cylinder_pressure
    clamp = numbers["CLAMP_PER_PRESSURE"][:, None] * pressure + numbers["CLAMP_OFFSET"][:, None]
    return np.asarray(numbers["TREAD_PER_CLAMP"][:, None] * np.maximum(clamp, 0.0))


def _balance(
    scenario: Scenario, measured: Measurements, numbers: dict[str, Any], lever: Array
) -> tuple[Array, Array]:
    """Return for each stretch the vehicles' X (stretch, vehicle) and what their pads gave, [N]."""
    step = float(measured.time[1] - measured.time[0])
    wide = max(1, round(SLOPE / step))
    wheel, train = measured.wheel_speed, measured.train_speed
    turning = numbers["ROTATING_MASS"] @ (wheel[:, :-wide] - wheel[:, wide:]) / (wide * step)
    resistance = (
        numbers["RESISTANCE_CONSTANT"]
        + numbers["RESISTANCE_LINEAR"] * train
        + numbers["RESISTANCE_QUADRATIC"] * train**2
    )
    known = _mean(measured.dynamic_force.sum(axis=0) + resistance, wide)
    given = numbers["TRAIN_MASS"] * _mean(measured.deceleration, wide) + turning - known
    vehicle = np.array([place.vehicle for place in scenario.train.axles()])
    each = [_mean(lever[vehicle == v].sum(axis=0), wide) for v in range(int(vehicle.max()) + 1)]
    rows = np.stack(each, axis=1)
    moving = (_mean(train, wide) > 1.0) & (rows.sum(axis=1) > 0.0)
    # stretches that overlap would tell the same twice
    return rows[moving][::wide], given[moving][::wide]


def _bayes(balances: list[tuple[Array, Array]], noise: float) -> tuple[Array, Array]:
    """Return mean and covariance of the vehicles' friction, once the stretches are known."""
    rows = np.concatenate([rows for rows, _ in balances])
    given = np.concatenate([given for _, given in balances])
    if not len(rows):
        raise RailgripError(Problem("stops", "the friction brake never works in them"))
    n, whole = rows.shape[1], rows.sum(axis=1)
    start = float(given @ whole / (whole @ whole))
    before = start**2 * (COMMON**2 * np.ones((n, n)) + EACH**2 * np.eye(n))
    place = np.concatenate([np.arange(len(given)) for _, given in balances])
    stop = np.repeat(np.arange(len(balances)), [len(given) for _, given in balances])
    alike = np.exp(-np.abs(np.subtract.outer(place, place)) / DRIFT_STRETCHES)
    alike *= np.equal.outer(stop, stop)
    drift = (start * DRIFT) ** 2 * np.outer(whole, whole) * alike
    scatter = rows @ before @ rows.T + drift + noise**2 * np.eye(len(rows))
    gain = np.linalg.solve(scatter, rows @ before).T
    return start + gain @ (given - rows @ np.full(n, start)), before - gain @ rows @ before


def _mean(values: Array, wide: int) -> Array:
    """Return the mean between samples so far apart, from each sample on (trapezoids)."""
    total = np.concatenate(([0.0], np.cumsum(0.5 * (values[1:] + values[:-1]))))
    return np.asarray((total[wide:] - total[:-wide]) / wide)


def _rail_force(measured: Measurements, applied: Array, rotating: Array) -> Array:
    """Return the force of the rail on each axle, by the controllers' observer (f8), [N]."""
    step = float(measured.time[1] - measured.time[0])
    n_axles, n_samples = applied.shape
    force = np.zeros_like(applied)
    most = min(max(1, round(WINDOW / step)), N_WINDOW - 1)
    state = np.zeros(state_size(n_axles))
    bases = [axle_base(axle) for axle in range(n_axles)]
    for base, mass, pull in zip(bases, rotating, applied, strict=True):
        state[base + MASS] = mass
        state[base + FORCE_BEFORE] = pull[0]
    for sample in range(n_samples):
        for axle, base in enumerate(bases):
            state[base + SPEED] = measured.wheel_speed[axle, sample]
            state[base + DYNAMIC] = -applied[axle, sample]
        observe_friction(state, n_axles, sample, most, step)
        force[:, sample] = [state[base + FRICTION] for base in bases]
    return force
