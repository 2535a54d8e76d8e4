"""Central unit of brake control: what the train is to do, what it does, and the correction."""

from __future__ import annotations

from typing import Final

from railgrip.control import brake_control_table as t
from railgrip.control.contract import FloatArray
from railgrip.control.deceleration_controller import (
    DecelerationGains,
    correct_deceleration,
    limit_jerk,
    stopping_deceleration,
)
from railgrip.core.constants import GRAVITY
from railgrip.core.formulas.elementary import exp_decay

HELD_SHARE: Final = 0.1
"""With so many brakes held by the slide protection, the controller does not correct …"""
HELD_TIME: Final = 3.0
"""… and not until so long after: a slide lets go between two grips, s."""
LETTING_GO: Final = 0.5
"""Time constant with which a slide takes the correction back, s."""
LEAST_ASKED: Final = 0.1
"""Errors are taken relative to at least so much, m/s²."""


def ask(parameters: FloatArray, state: FloatArray, measured: FloatArray, dt: float) -> float:
    """Return the deceleration that the brakes are asked for now, after jerk limit and dead time.

    Parameters
    ----------
    parameters, state, measured : ndarray
        See `brake_control.brake_control_kernel`.
    dt : float
        Period [s].
    """
    demand = measured[0, t.BRAKE_DEMAND]
    if demand != state[t.LAST_DEMAND]:
        # released and applied again is a new braking; a change of stage is none
        state[t.CLOCK] = 0.0 if state[t.LAST_DEMAND] == 0.0 else state[t.CLOCK]
        state[t.SETTLED] = 0.0
        state[t.SINCE_CHANGE] = 0.0
    state[t.LAST_DEMAND] = demand
    state[t.CLOCK] = state[t.CLOCK] + dt if demand > 0.0 else 0.0
    state[t.SINCE_CHANGE] += dt
    state[t.SETTLED] = 1.0 if state[t.SINCE_CHANGE] > parameters[t.SETTLING] else 0.0
    full = parameters[t.FULL_DECELERATION]
    wanted = demand * full
    speed = measured[0, t.TRAIN_SPEED]
    if parameters[t.STOPS] > 0.0 and demand > 0.0:
        resistance = running_resistance(parameters, speed)
        wanted = stopping_deceleration(
            speed, measured[0, t.TO_GO], parameters[t.RESPONSE], state[t.ASKED] + resistance,
            parameters[t.LEAST_STOPPING_SPEED],
        )  # fmt: skip
        wanted = max(0.0, min(wanted - resistance, parameters[t.RESERVE] * full))
    is_emergency = measured[0, t.EMERGENCY] > 0.0
    jerk = parameters[t.JERK_EMERGENCY] if is_emergency else parameters[t.JERK_SERVICE]
    state[t.ASKED] = limit_jerk(state[t.ASKED], wanted, jerk, dt) if demand > 0.0 else 0.0
    count = int(state[t.COUNT])
    state[t.HISTORY + count % t.N_HISTORY] = state[t.ASKED]
    late = int(parameters[t.DEAD_TIME] / dt + 0.5)
    return float(state[t.HISTORY + (count - late) % t.N_HISTORY]) if count >= late else 0.0


def running_resistance(parameters: FloatArray, speed: float) -> float:
    """Return the deceleration by running resistance that is known of the train [m/s²]."""
    linear = parameters[t.RESISTANCE_LINEAR] + parameters[t.RESISTANCE_QUADRATIC] * speed
    return float(parameters[t.RESISTANCE_CONSTANT] + linear * speed)


def gradient_force(parameters: FloatArray, measured: FloatArray) -> float:
    """Return the deceleration that brakes give more because of the gradient [m/s²]."""
    uphill = GRAVITY * measured[0, t.GRADIENT] * parameters[t.GRADIENT_COMPENSATION]
    return float(max(-uphill, 0.0) if measured[0, t.EMERGENCY] > 0.0 else -uphill)


def correct(
    parameters: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    asked: float,
    achieved: float,
    dt: float,
) -> float:
    """Compare with what is measured; return the correction that the local units get now.

    Parameters
    ----------
    parameters, state, measured : ndarray
        See `brake_control.brake_control_kernel`.
    asked : float
        What the brakes are asked for, from `ask` [m/s²].
    achieved : float
        Share of it that pressures and motors have come to, from `local_units.achieved_share` [-].
    dt : float
        Period [s].
    """
    demand = measured[0, t.BRAKE_DEMAND]
    brakes = asked + gradient_force(parameters, measured)
    # pressures tell how far the brakes have got: filling, or a slide, is not mistaken for friction
    expected = brakes * achieved
    expected += running_resistance(parameters, measured[0, t.TRAIN_SPEED])
    expected += GRAVITY * measured[0, t.GRADIENT]
    # reference less measurement goes through the sensor's filter as a whole
    deviation = expected - measured[0, t.DECELERATION]
    kept = exp_decay(dt / parameters[t.MEASURING_LAG])
    state[t.DEVIATION] = deviation + (state[t.DEVIATION] - deviation) * kept
    deviation = state[t.DEVIATION]
    is_emergency = measured[0, t.EMERGENCY] > 0.0
    threshold = parameters[t.THRESHOLD_EMERGENCY if is_emergency else t.THRESHOLD_SERVICE]
    threshold *= parameters[t.DEGRADED_SHARE] if state[t.N_FAILED] > 0.0 else 1.0
    is_settled = state[t.SETTLED] > 0.0 and demand > 0.0
    if is_settled and abs(deviation) > threshold:
        state[t.IS_PAST] = 1.0
    acts = parameters[t.CONTROLLER] == t.ALWAYS or (
        parameters[t.CONTROLLER] == t.PAST_THRESHOLD and state[t.IS_PAST] > 0.0
    )
    if demand == 0.0:
        state[t.INTEGRAL] = 0.0
        state[t.CORRECTION] = 0.0
        state[t.IS_PAST] = 0.0
    elif acts and is_settled:
        _control(parameters, state, measured, deviation / max(brakes, LEAST_ASKED), dt)
    count = int(state[t.COUNT])
    state[t.BUS + count % t.N_HISTORY] = state[t.CORRECTION]
    late = int(parameters[t.DELAY] / dt + 0.5)
    correction = float(state[t.BUS + (count - late) % t.N_HISTORY]) if count >= late else 0.0
    return correction if demand > 0.0 else 0.0


def _control(
    parameters: FloatArray, state: FloatArray, measured: FloatArray, error: float, dt: float
) -> None:
    held = 0.0
    for axle in range(measured.shape[0]):
        held += measured[axle, t.IS_HELD]
    is_held = held > HELD_SHARE * measured.shape[0]
    state[t.HELD_CLOCK] = HELD_TIME if is_held else max(state[t.HELD_CLOCK] - dt, 0.0)
    is_sliding = state[t.HELD_CLOCK] > 0.0
    # the rail decides then, not the pads: it lets go what it has learned from them
    error = 0.0 if is_sliding else error
    state[t.INTEGRAL] *= exp_decay(dt / LETTING_GO) if is_sliding else 1.0
    is_bound = state[t.SHARE_LIMITED] >= 1.0
    gains = DecelerationGains(
        parameters[t.PROPORTIONAL], parameters[t.INTEGRAL_GAIN],
        parameters[t.GREATEST_CORRECTION], parameters[t.CORRECTION_RATE],
    )  # fmt: skip
    integral, correction = correct_deceleration(
        gains, state[t.INTEGRAL], state[t.CORRECTION], error, 0.0 if is_bound else 1.0, 1.0, dt
    )
    state[t.INTEGRAL] = integral
    state[t.CORRECTION] = correction
