"""Local units of brake control: friction estimate, cylinder pressure, watch over each brake."""

from __future__ import annotations

from typing import Final

from railgrip.control import brake_control_table as t
from railgrip.control.contract import FloatArray
from railgrip.control.disc_temperature import advance_disc
from railgrip.control.friction_estimate import FrictionModel, LimitSet, estimate_friction
from railgrip.control.limit_rules import (
    EMERGENCY_BRAKE,
    N_CONDITIONS,
    N_SET,
    SERVICE,
    limit_set,
    rule_in_force,
)
from railgrip.core.formulas.piecewise_linear import Hinges
from railgrip.core.formulas.two_node_heat import DiscHeat

FAILURE_TIME: Final = 1.5
"""A brake that has not half its pressure for so long counts as failed, s."""
LEAST_LEFT: Final = 0.02
"""Share of the full force below which the friction brake stands by."""


def _hinges(setup: FloatArray, axle: int, at: int) -> Hinges:
    return Hinges(
        setup[axle, at], setup[axle, at + 1], setup[axle, at + 2], setup[axle, at + 3],
        setup[axle, at + 4], setup[axle, at + 5], setup[axle, at + 6], setup[axle, at + 7],
        setup[axle, at + 8],
    )  # fmt: skip


def _clamp(setup: FloatArray, axle: int, pressure: float) -> float:
    nominal = setup[axle, t.CLAMP_PER_PRESSURE] * pressure + setup[axle, t.CLAMP_OFFSET]
    return float(max(nominal, 0.0))


def estimate_axle(
    parameters: FloatArray,
    rules: FloatArray,
    setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    axle: int,
    dt: float,
) -> None:
    """Update the estimate of one axle's friction, and its model of the disc, in the state.

    Parameters
    ----------
    parameters, rules, setup, state, measured : ndarray
        See `brake_control.brake_control_kernel`.
    axle : int
        The axle whose signals stand for its unit.
    dt : float
        Period [s].
    """
    own = t.FIRST_AXLE + axle * t.N_AXLE
    speed = measured[axle, t.WHEEL_SPEED]
    # a sensor that is known to have failed reads NaN
    speed = speed if speed >= 0.0 else measured[0, t.TRAIN_SPEED]
    rubbing = speed * measured[axle, t.BELIEVED_TREAD]
    hot = measured[axle, t.DISC_TEMPERATURE]
    if parameters[t.TEMPERATURE_SOURCE] == t.FROM_MODEL:
        hot = state[own + t.RING]
    clamp = state[own + t.CLAMP]
    brake = EMERGENCY_BRAKE if measured[0, t.EMERGENCY] > 0.0 else SERVICE
    rule = rule_in_force(
        rules, brake, setup[axle, t.PADS], measured[0, t.TRAIN_SPEED], state[t.CLOCK],
        hot, rubbing, clamp,
    )  # fmt: skip
    friction = setup[axle, t.MODEL]
    if rule >= 0:
        model = FrictionModel(
            friction,
            _hinges(setup, axle, t.MODEL + 1),
            _hinges(setup, axle, t.MODEL + 10),
            _hinges(setup, axle, t.MODEL + 19),
        )
        model_set: LimitSet = limit_set(rules, rule, N_CONDITIONS)
        control_set: LimitSet = limit_set(rules, rule, N_CONDITIONS + N_SET)
        friction = estimate_friction(model, model_set, control_set, hot, rubbing, clamp)
    state[own + t.ESTIMATE] = friction
    if parameters[t.TEMPERATURE_SOURCE] == t.FROM_MODEL:
        disc = DiscHeat(
            setup[axle, t.DISC], setup[axle, t.DISC + 1], setup[axle, t.DISC + 2],
            setup[axle, t.DISC + 3], setup[axle, t.DISC + 4], setup[axle, t.DISC + 5],
            setup[axle, t.DISC + 6], setup[axle, t.DISC + 7], setup[axle, t.DISC + 8],
        )  # fmt: skip
        force = _clamp(setup, axle, measured[axle, t.CYLINDER_PRESSURE])
        force *= friction * measured[axle, t.LEARNED_FRICTION] * measured[axle, t.BELIEVED_TREAD]
        ring, hub = advance_disc(
            disc, state[own + t.RING], state[own + t.HUB], force * speed,
            measured[0, t.TRAIN_SPEED], dt,
        )  # fmt: skip
        state[own + t.RING] = ring
        state[own + t.HUB] = hub


def set_pressure(
    parameters: FloatArray,
    setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    axle: int,
    is_passed_on: bool,
) -> float:
    """Write one axle's factors into the command; return 1 where its pressure is at the limit.

    Parameters
    ----------
    parameters, setup, state, measured, command : ndarray
        See `brake_control.brake_control_kernel`; the force factor stands in the command already.
    axle : int
        Number of the axle.
    is_passed_on : bool
        Whether the estimate is used; else the model's reference friction.
    """
    source = int(setup[axle, t.ESTIMATE_AXLE])
    reference = setup[axle, t.MODEL]
    friction = state[t.FIRST_AXLE + source * t.N_AXLE + t.ESTIMATE]
    friction = friction if is_passed_on else reference
    learned = measured[axle, t.LEARNED_FRICTION]
    tread = measured[axle, t.BELIEVED_TREAD]
    full = setup[axle, t.FULL_PRESSURE]
    force = setup[axle, t.FULL_FORCE]
    taken = max(measured[axle, t.DYNAMIC_FORCE], 0.0) / force
    asked = measured[0, t.BRAKE_DEMAND] * command[axle, t.FORCE_FACTOR]
    left = max(asked - taken, LEAST_LEFT)
    if parameters[t.ADAPTS] == t.CHARACTERISTIC:
        pressure = full * left * (reference / (friction * learned))
        pressure = pressure * (setup[axle, t.NOMINAL_TREAD] / tread)
    else:
        clamp = left * force / (friction * learned * tread)
        pressure = (clamp - setup[axle, t.CLAMP_OFFSET]) / setup[axle, t.CLAMP_PER_PRESSURE]
    limit = parameters[t.RESERVE] * full
    bound = min(pressure, limit)
    command[axle, t.PRESSURE_FACTOR] = bound / (full * left)
    command[axle, t.ESTIMATED_FRICTION] = friction * learned
    own = t.FIRST_AXLE + axle * t.N_AXLE
    state[own + t.LEFT] = max(asked - taken, 0.0)
    state[own + t.CLAMP] = _clamp(setup, axle, bound) * setup[axle, t.CLAMP_PER_BLOCK]
    return 1.0 if pressure >= limit else 0.0


def watch_brake(
    setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    axle: int,
    filling: float,
    dt: float,
) -> float:
    """Return 1 if a brake does not get the pressure that was asked for, else 0.

    Parameters
    ----------
    setup, state, measured : ndarray
        See `brake_control.brake_control_kernel`.
    axle : int
        Number of the axle.
    filling : float
        Time after a change of demand in which it may still fill [s].
    dt : float
        Period [s].

    Notes
    -----
    A brake that the wheel-slide protection holds or vents is not blamed.
    """
    own = t.FIRST_AXLE + axle * t.N_AXLE
    clamp = _clamp(setup, axle, measured[axle, t.CYLINDER_PRESSURE])
    wanted = state[own + t.CLAMP] / setup[axle, t.CLAMP_PER_BLOCK]
    is_late = state[t.SINCE_CHANGE] > filling and measured[axle, t.IS_HELD] == 0.0
    is_short = is_late and wanted > 0.0 and clamp < 0.5 * wanted
    clock = state[own + t.FAILED_CLOCK]
    if clock <= FAILURE_TIME:
        state[own + t.FAILED_CLOCK] = clock + dt if is_short else 0.0
    return 1.0 if clock > FAILURE_TIME else 0.0


def achieved_share(setup: FloatArray, state: FloatArray, measured: FloatArray) -> float:
    """Return how much of what sound brakes were asked for they have come to.

    Parameters
    ----------
    setup, state, measured : ndarray
        See `brake_control.brake_control_kernel`.

    Returns
    -------
    float
        Motor forces and clamp forces by pressure over those asked for, 0 … 1.5 [-]; friction does
        not enter.
    """
    achieved = 0.0
    asked = 0.0
    for axle in range(measured.shape[0]):
        own = t.FIRST_AXLE + axle * t.N_AXLE
        is_sound = state[own + t.FAILED_CLOCK] <= FAILURE_TIME
        if setup[axle, t.BRAKED] > 0.0 and is_sound:
            wanted = state[own + t.CLAMP] / setup[axle, t.CLAMP_PER_BLOCK]
            clamp = _clamp(setup, axle, measured[axle, t.CYLINDER_PRESSURE])
            motor = max(measured[axle, t.DYNAMIC_FORCE], 0.0)
            friction = state[own + t.LEFT] * setup[axle, t.FULL_FORCE]
            achieved += motor + friction * min(clamp / max(wanted, 1.0), 1.5)
            asked += motor + friction
    return achieved / asked if asked > 0.0 else 0.0
