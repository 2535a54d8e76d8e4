"""What an axle under temperature control is led to: from its speed and the observed force to F*."""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_state import ACCELERATION, REFERENCE, SPEED
from railgrip.control.slip_band import threshold
from railgrip.control.state_layout import axle_base
from railgrip.control.temperature_parameters import TemperatureOnly, temperature_of
from railgrip.control.temperature_state import (
    BRAKE_FORCE,
    CONTINUOUS_BRAKE,
    FACTOR,
    FORCE_TARGET,
    FRICTION,
    LOAD,
    MASS,
    MOVING,
    SLIP_LIMIT,
    STILL,
    TRAIN_ACCELERATION,
)
from railgrip.control.temperature_targets import (
    admissible_power,
    force_target,
    friction_speed,
    per_fastest,
    signed_slip,
    slip_target,
)
from railgrip.core.formulas.choosing import choose

SLIDE_SHARE, SLIDE_FLOOR = 0.01, 0.15
"""A wheel slower than the train by more than this share, or this, m/s, slides."""
BRAKING: Final = -1.0
DRIVING: Final = 1.0


class Moment(NamedTuple):
    """What is the same for all axles in one step.

    Parameters
    ----------
    reference, acceleration : float
        Reference speed [m/s] and acceleration of the train, signed [m/s²].
    factor : float
        On the admissible rises.
    still, moving : float
        Squares of the heat conductance of one body at rest [W²/K²], and for each m/s and N of load.
    demand : float
        Of the brake, 0..1.
    lower : float
        Slip speed beyond which a wheel slides, [m/s].
    """

    reference: float
    acceleration: float
    factor: float
    still: float
    moving: float
    demand: float
    lower: float


def moment(state: FloatArray, demand: float) -> Moment:
    """Return what is the same for all axles."""
    reference = state[REFERENCE]
    return Moment(
        reference=reference,
        acceleration=state[TRAIN_ACCELERATION],
        factor=state[FACTOR],
        still=state[STILL],
        moving=state[MOVING],
        demand=demand,
        lower=threshold(SLIDE_SHARE, SLIDE_FLOOR, reference),
    )


class Targets(NamedTuple):
    """What temperature control reckons for one axle, driving positive.

    Parameters
    ----------
    friction : float
        Force of the rail as observed, [N].
    slip, slip_target : float
        s* and s_soll.
    power : float
        Friction power aimed at, both contacts, [W].
    friction_speed : float
        That power over the observed force, before any bound, [m/s].
    force : float
        F*, what brakes and motor shall apply, [N].
    """

    friction: float
    slip: float
    slip_target: float
    power: float
    friction_speed: float
    force: float


def aim(
    parameters: TemperatureOnly, now: Moment, state: FloatArray, base: int, demand: float,
    whole: float, is_continuous: bool,
) -> Targets:  # fmt: skip
    """Return F* and all that it is reckoned from, for a signed demand [N]."""
    wheel = state[base + SPEED]
    friction = state[base + FRICTION]
    fastest = max(wheel, now.reference)
    per_speed = per_fastest(parameters, fastest)
    slip = signed_slip(wheel, now.reference, per_speed)
    relative = state[base + ACCELERATION] - now.acceleration
    foreseen = choose(is_continuous, slip, slip + parameters.valve_lead * relative * per_speed)
    load = state[base + LOAD]
    power = admissible_power(
        parameters, now.still, now.moving * load, wheel, now.reference, now.factor
    )
    speed = friction_speed(parameters, power, friction, load)
    sign = choose(demand > 0.0, DRIVING, BRAKING)
    wanted = slip_target(speed, per_speed, state[base + SLIP_LIMIT], sign)
    excess = choose(is_continuous, parameters.excess_gain, parameters.valve_excess_gain)
    force = force_target(
        parameters, foreseen, wanted, friction, now.acceleration, state[base + MASS], whole,
        excess, demand, fastest,
    )  # fmt: skip
    return Targets(friction, slip, wanted, power, speed, force)


def targets(parameters: FloatArray, state: FloatArray, axle: int, sign: float = BRAKING) -> Targets:
    """Return the reckoning of one axle after a step, to be logged or drawn.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    axle : int
        Of the train, from 0.
    sign : float
        `BRAKING` or `DRIVING`.

    Examples
    --------
    >>> import numpy as np
    >>> from railgrip.control.state_layout import state_size
    >>> from railgrip.control.temperature_parameters import TemperatureParameters
    >>> state = np.zeros(state_size(2))
    >>> state[axle_base(1) + LOAD] = 100e3
    >>> targets(np.array(TemperatureParameters()), state, 1).force
    0.0
    """
    base = axle_base(axle)
    found = aim(
        temperature_of(parameters), moment(state, 0.0), state, base, sign,
        state[base + BRAKE_FORCE], state[base + CONTINUOUS_BRAKE] > 0.0,
    )  # fmt: skip
    return Targets(*map(float, found._replace(force=state[base + FORCE_TARGET])))
