"""Search of the peak of the adhesion curve: the slope is observed, the slip target follows it.

The target is moved to and fro a little. How the observed force answers, relative to both means, is
the slope of the curve; a scalar Kalman filter with the slope as a random walk finds it. Where the
curve still rises the target grows, where it falls the target shrinks.
"""

from __future__ import annotations

import math

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_state import DECELERATION, REFERENCE
from railgrip.control.traction_parameters import (
    DITHER,
    DITHER_TIME,
    FORCE_ERROR,
    OBSERVER_LAG,
    SEARCH_MARGIN,
    SEARCH_MEAN_TIME,
    SEARCH_RATE,
    SEARCH_SLOPE,
    SLOPE_DRIFT,
    SPEED_FORWARD,
    TARGET_GREATEST,
    TARGET_GREATEST_SHARE,
    TARGET_LEAST,
    TARGET_LEAST_SHARE,
)
from railgrip.control.traction_state import (
    CLOCK,
    DOUBT_OF_SLOPE,
    FORCE,
    MEAN_FORCE,
    MEAN_SLIP,
    SLIP_LAG,
    SLOPE,
    TARGET,
)

FARTHEST = 1.0
"""A slip that differs by more than this share from its mean tells nothing of the slope there."""


FORWARD_ABOVE = 2.0
"""Least speed over which a gain of speed is taken, where the target moves with it, m/s."""


def observe_slope(
    slope: float, variance: float, slip_change: float, force_change: float,
    force_error: float, drift: float, dt: float,
) -> tuple[float, float]:  # fmt: skip
    """Return slope and its variance after one more observation: a scalar Kalman filter.

    Parameters
    ----------
    slope, variance : float
        What the last call returned.
    slip_change, force_change : float
        Of slip speed and force against their means, as shares of these.
    force_error : float
        Standard deviation of the force around the curve, share.
    drift : float
        Of the slope, a random walk, [1/√s].
    dt : float
        Period, [s].

    Examples
    --------
    >>> found = 0.0, 1.0
    >>> for i in range(1000):
    ...     change = 0.3 * math.sin(0.04 * i)
    ...     found = observe_slope(*found, change, -0.2 * change, 0.05, 0.0, 0.01)
    >>> round(found[0], 2)
    -0.2
    """
    variance += drift * drift * dt
    gain = variance * slip_change / (slip_change * slip_change * variance + force_error**2)
    slope += gain * (force_change - slip_change * slope)
    return slope, variance * (1.0 - gain * slip_change)


def seek_peak(
    parameters: FloatArray, state: FloatArray, base: int, slip: float, is_held: bool,
    dt: float,
) -> None:  # fmt: skip
    """Update the slope and the slip target of one axle in the state.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    base : int
        Where the axle's values begin.
    slip : float
        Slip speed of the wheel, driving positive, [m/s].
    is_held : bool
        Whether the torque is limited and the wheel slips: only then the curve shows.
    dt : float
        Period, [s].
    """
    force = state[base + FORCE]
    lag = state[base + SLIP_LAG]
    lag += dt / (parameters[OBSERVER_LAG] + dt) * (slip - lag)
    state[base + SLIP_LAG] = lag
    if not is_held:
        state[base + MEAN_SLIP] = lag
        state[base + MEAN_FORCE] = force
        return
    blend = dt / (parameters[SEARCH_MEAN_TIME] + dt)
    mean_slip = state[base + MEAN_SLIP] + blend * (lag - state[base + MEAN_SLIP])
    mean_force = state[base + MEAN_FORCE] + blend * (force - state[base + MEAN_FORCE])
    state[base + MEAN_SLIP] = mean_slip
    state[base + MEAN_FORCE] = mean_force
    if mean_slip > 0.0 and mean_force > 0.0:
        change = (lag - mean_slip) / mean_slip
        if abs(change) < FARTHEST:
            state[base + SLOPE], state[base + DOUBT_OF_SLOPE] = observe_slope(
                state[base + SLOPE], state[base + DOUBT_OF_SLOPE], change,
                (force - mean_force) / mean_force,
                parameters[FORCE_ERROR], parameters[SLOPE_DRIFT], dt,
            )  # fmt: skip
    pull = (state[base + SLOPE] - parameters[SEARCH_MARGIN]) / parameters[SEARCH_SLOPE]
    pull = max(-1.0, min(1.0, pull))
    gain = max(-state[DECELERATION], 0.0) / max(state[REFERENCE], FORWARD_ABOVE)
    rate = parameters[SEARCH_RATE] * pull + parameters[SPEED_FORWARD] * gain
    state[base + TARGET] *= 1.0 + rate * dt
    _bound(parameters, state, base)


def _bound(parameters: FloatArray, state: FloatArray, base: int) -> None:
    reference = state[REFERENCE]
    least = max(parameters[TARGET_LEAST], parameters[TARGET_LEAST_SHARE] * reference)
    most = parameters[TARGET_GREATEST] + parameters[TARGET_GREATEST_SHARE] * reference
    state[base + TARGET] = max(least, min(most, state[base + TARGET]))


def slip_aimed_at(parameters: FloatArray, state: FloatArray, base: int, axle: int) -> float:
    """Return the target with its dither, each axle at another time of it, [m/s]."""
    turns = state[CLOCK] / parameters[DITHER_TIME] + 0.25 * axle
    aim: float = state[base + TARGET] * (1.0 + parameters[DITHER] * math.sin(2.0 * math.pi * turns))
    return aim
