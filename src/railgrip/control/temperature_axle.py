"""One axle under temperature control: from its speed to the shares of brake and motor."""

from __future__ import annotations

from typing import NamedTuple

from railgrip.control.axle_alarm import axle_alarm
from railgrip.control.axle_forces import motor_force, pressure_for
from railgrip.control.axle_protection import freed_place
from railgrip.control.axle_signals import give, give_command
from railgrip.control.contract import (
    ALARM,
    DRIVE_DEMAND,
    DUMP_VALVE,
    DYNAMIC_SHARE,
    FILL,
    FRICTION_SHARE,
    HOLD,
    IS_SLIDING,
    REFERENCE_SPEED,
    SANDING,
    TRACTIVE_EFFORT,
    TRACTIVE_POWER,
    VENT,
    FloatArray,
)
from railgrip.control.conventional_parameters import ConventionalParameters, conventional_of
from railgrip.control.conventional_state import (
    ACCELERATION,
    DYNAMIC,
    DYNAMIC_PERMITTED,
    IS_BRAKED,
    IS_FAULTY,
    IS_MOTORED,
    PRESSURE,
    REFERENCE,
    SLIDES,
    SPEED,
    VALVE,
)
from railgrip.control.pressure_following import follow_pressure
from railgrip.control.safety_timer import watch_release
from railgrip.control.sanding_request import request_sand
from railgrip.control.slip_band import note_slide, threshold
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups
from railgrip.control.temperature_parameters import TemperatureOnly, temperature_of
from railgrip.control.temperature_state import (
    BRAKE_FORCE,
    CONTINUOUS_BRAKE,
    EFFORT_OF_MOTOR,
    FACTOR,
    FORCE_TARGET,
    FRICTION,
    FRICTION_PERMITTED,
    FRICTION_SPEED,
    FULL,
    LOAD,
    MASS,
    MOVING,
    POWER_OF_MOTOR,
    POWER_TARGET,
    SLIP,
    SLIP_LIMIT,
    SLIP_TARGET,
    STILL,
    TRAIN_ACCELERATION,
)
from railgrip.control.temperature_targets import (
    admissible_power,
    force_target,
    friction_speed,
    signed_slip,
    slip_target,
)
from railgrip.core.formulas.choosing import choose

SLIDE_SHARE, SLIDE_FLOOR = 0.01, 0.15
"""A wheel slower than the train by more than this share, or this, m/s, slides."""
LIMITED = 0.999
"""Share of the demand below which a force counts as limited."""


class Moment(NamedTuple):
    """What is the same for all axles in one step.

    Parameters
    ----------
    reference, acceleration : float
        Reference speed [m/s] and acceleration of the train, signed [m/s²].
    factor : float
        On the admissible rises.
    demand : float
        Of the brake, 0..1.
    lower : float
        Slip speed beyond which a wheel slides, [m/s].
    """

    reference: float
    acceleration: float
    factor: float
    demand: float
    lower: float


def moment(state: FloatArray, demand: float) -> Moment:
    """Return what is the same for all axles."""
    reference = state[REFERENCE]
    return Moment(
        reference=reference,
        acceleration=state[TRAIN_ACCELERATION],
        factor=state[FACTOR],
        demand=demand,
        lower=threshold(SLIDE_SHARE, SLIDE_FLOOR, reference),
    )


def aim(
    parameters: TemperatureOnly, now: Moment, state: FloatArray, base: int, demand: float,
    whole: float, is_continuous: bool, is_protected: bool,
) -> float:  # fmt: skip
    """Return F*, signed, and leave all that it was reckoned from in the state, [N].

    An axle that is not protected leaves nothing there.
    """
    wheel = state[base + SPEED]
    fastest = max(wheel, now.reference)
    slip = signed_slip(parameters, wheel, now.reference)
    relative = state[base + ACCELERATION] - now.acceleration
    lead = parameters.valve_lead * relative / max(fastest, parameters.least_speed)
    foreseen = choose(is_continuous, slip, slip + lead)
    power = admissible_power(
        parameters, state[base + STILL], state[base + MOVING], wheel, now.reference, now.factor
    )
    speed = friction_speed(parameters, power, state[base + FRICTION], state[base + LOAD])
    sign = choose(demand > 0.0, 1.0, -1.0)
    wanted = slip_target(parameters, speed, fastest, state[base + SLIP_LIMIT], sign)
    state[base + SLIP] = choose(is_protected, slip, state[base + SLIP])
    state[base + POWER_TARGET] = choose(is_protected, power, state[base + POWER_TARGET])
    state[base + FRICTION_SPEED] = choose(is_protected, speed, state[base + FRICTION_SPEED])
    state[base + SLIP_TARGET] = choose(is_protected, wanted, state[base + SLIP_TARGET])
    excess = choose(is_continuous, parameters.excess_gain, parameters.valve_excess_gain)
    return force_target(
        parameters, foreseen, wanted, state[base + FRICTION], now.acceleration,
        state[base + MASS], whole, excess, demand, fastest,
    )  # fmt: skip


def drive_axle(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    command: FloatArray, axle: int, dt: float,
) -> None:  # fmt: skip
    """Write the command of one axle while the train is driven."""
    base = axle_base(axle)
    own = temperature_of(parameters)
    now = moment(state, 0.0)
    effort = motor_force(
        axle_setup[axle, TRACTIVE_EFFORT], axle_setup[axle, TRACTIVE_POWER],
        state[base + SPEED], own.least_speed,
    )  # fmt: skip
    demand = effort * measured[axle, DRIVE_DEMAND]
    share = 1.0
    state[base + FORCE_TARGET] = demand
    if demand > 0.0 and state[base + IS_FAULTY] == 0.0:
        force = aim(own, now, state, base, demand, effort, True, True)
        state[base + FORCE_TARGET] = force
        share = min(1.0, force / demand)
    command[axle, DYNAMIC_SHARE] = share
    command[axle, FRICTION_SHARE] = 1.0
    command[axle, DUMP_VALVE] = FILL
    spin_speed = state[base + SPEED] - now.reference
    limited = share < LIMITED and spin_speed > now.lower
    note_slide(state, base, VENT if limited else FILL, spin_speed, now.lower, dt)
    ordinary = conventional_of(parameters)
    command[axle, SANDING] = request_sand(ordinary, state, base, now.reference, dt)
    command[axle, IS_SLIDING] = state[base + SLIDES]
    command[axle, ALARM] = axle_alarm(state, base)
    command[axle, REFERENCE_SPEED] = now.reference


def brake_axles(
    parameters: FloatArray, state: FloatArray, command: FloatArray, demand: float, dt: float
) -> None:
    """Write the command of every axle while the train is braked, or rolls."""
    n_axles = command.shape[0]
    ordinary = conventional_of(parameters)
    own = temperature_of(parameters)
    now = moment(state, demand)
    freed = freed_place(state)
    for group in range(groups(n_axles)):
        # three short passes: of a long one the processor holds only one step at a time
        for i in range(GROUP):
            base = group_base(group) + i
            _aim_at(ordinary, own, now, state, base, base == freed)
        for i in range(GROUP):
            base = group_base(group) + i
            _watch(ordinary, now, state, base, dt)
        for i in range(GROUP):
            base = group_base(group) + i
            _apply(own, now, state, base, dt)
    give_command(state, command)
    give(state, FRICTION_PERMITTED, command, FRICTION_SHARE)


def _aim_at(
    ordinary: ConventionalParameters, parameters: TemperatureOnly, now: Moment, state: FloatArray,
    base: int, is_freed: bool,
) -> None:  # fmt: skip
    """Put into the state the force that one axle is led with, as the temperature allows."""
    whole = state[base + BRAKE_FORCE]
    asked = now.demand * whole
    works = (now.reference >= ordinary.inhibit_speed) & (asked > 0.0)
    is_protected = works & (state[base + IS_FAULTY] == 0.0)
    is_continuous = state[base + CONTINUOUS_BRAKE] > 0.0
    aimed = aim(parameters, now, state, base, -asked, whole, is_continuous, is_protected)
    state[base + FORCE_TARGET] = choose(is_protected, choose(is_freed, 0.0, aimed), -asked)


def _watch(
    ordinary: ConventionalParameters, now: Moment, state: FloatArray, base: int, dt: float
) -> None:
    """Note whether one axle slides and asks for sand; one released for too long gets all force."""
    asked = now.demand * state[base + BRAKE_FORCE]
    force = -state[base + FORCE_TARGET]
    slip_speed = now.reference - state[base + SPEED]
    is_limited = force < LIMITED * asked
    wished = choose(is_limited & (slip_speed > now.lower), VENT, FILL)
    note_slide(state, base, wished, slip_speed, now.lower, dt)
    # an axle that its motor brakes is not released, whatever its cylinder says
    by_motor = state[base + DYNAMIC] > ordinary.dynamic_least_force
    stood = choose(is_limited & (not by_motor), HOLD, FILL)
    must_fill = watch_release(ordinary, state, base, stood, dt)
    state[base + FORCE_TARGET] = -choose(must_fill, asked, force)
    request_sand(ordinary, state, base, now.reference, dt)


def _apply(
    parameters: TemperatureOnly, now: Moment, state: FloatArray, base: int, dt: float
) -> None:
    """Let the motor take what it can of the force, and the friction brake the rest."""
    asked = now.demand * state[base + BRAKE_FORCE]
    force = -state[base + FORCE_TARGET]
    is_limited = force < LIMITED * asked
    effort, power = state[base + EFFORT_OF_MOTOR], state[base + POWER_OF_MOTOR]
    able = min(motor_force(effort, power, state[base + SPEED], parameters.least_speed), asked)
    share = _share_of(able, force)
    by_motor = is_limited & (state[base + IS_MOTORED] > 0.0)
    state[base + DYNAMIC_PERMITTED] = choose(by_motor, share, 1.0)
    dynamic = max(state[base + DYNAMIC], 0.0)
    rest = max(force - dynamic, 0.0)
    share = _share_of(asked - dynamic, rest)
    has_no_valve = (state[base + CONTINUOUS_BRAKE] > 0.0) | (state[base + IS_BRAKED] == 0.0)
    state[base + FRICTION_PERMITTED] = choose(is_limited & has_no_valve, share, 1.0)
    state[base + VALVE] = follow_pressure(
        parameters, state, base, is_limited & (not has_no_valve), state[base + PRESSURE],
        pressure_for(state, base, rest), state[base + FULL] * now.demand, dt,
    )  # fmt: skip


def _share_of(whole: float, force: float) -> float:
    """Return which share of the whole a force is, at most 1; 0 of nothing."""
    is_some = whole > 0.0
    return choose(is_some, min(1.0, force / choose(is_some, whole, 1.0)), 0.0)
