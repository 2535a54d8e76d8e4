"""One axle under temperature control: from its speed to the shares of brake and motor."""

from __future__ import annotations

from railgrip.control.axle_alarm import axle_alarm
from railgrip.control.axle_forces import motor_force, pressure_for
from railgrip.control.axle_protection import freed_place
from railgrip.control.axle_signals import give_command, note_signals
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
    DYNAMIC,
    DYNAMIC_PERMITTED,
    IS_BRAKED,
    IS_FAULTY,
    IS_MOTORED,
    PRESSURE,
    SLIDES,
    SPEED,
    VALVE,
)
from railgrip.control.pressure_following import follow_pressure
from railgrip.control.safety_timer import watch_release
from railgrip.control.sanding_request import request_sand
from railgrip.control.side_by_side import give
from railgrip.control.slip_band import note_slide
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups
from railgrip.control.temperature_aim import Moment, aim, moment
from railgrip.control.temperature_parameters import TemperatureOnly, temperature_of
from railgrip.control.temperature_state import (
    BRAKE_FORCE,
    CONTINUOUS_BRAKE,
    EFFORT_OF_MOTOR,
    FORCE_TARGET,
    FRICTION_PERMITTED,
    FULL,
    POWER_OF_MOTOR,
)
from railgrip.core.formulas.choosing import choose

LIMITED = 0.999
"""Share of the demand below which a force counts as limited."""


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
        force = aim(own, now, state, base, demand, effort, True).force
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
    # three short passes: what a longer one needs of parameters has no room in the registers
    for group in range(groups(n_axles)):
        for i in range(GROUP):
            base = group_base(group) + i
            _aim_at(ordinary, own, now, state, base, base == freed)
    for group in range(groups(n_axles)):
        for i in range(GROUP):
            _watch(ordinary, now, state, group_base(group) + i, dt)
    for group in range(groups(n_axles)):
        for i in range(GROUP):
            _apply(own, now, state, group_base(group) + i, dt)
        give(command, group * GROUP, FRICTION_SHARE, state, group_base(group) + FRICTION_PERMITTED)
    give_command(state, command)


def _aim_at(
    ordinary: ConventionalParameters, parameters: TemperatureOnly, now: Moment, state: FloatArray,
    base: int, is_freed: bool,
) -> None:  # fmt: skip
    """Put into the state the force that one axle is led with, as the temperature allows."""
    asked = now.demand * state[base + BRAKE_FORCE]
    works = (now.reference >= ordinary.inhibit_speed) & (asked > 0.0)
    is_protected = works & (state[base + IS_FAULTY] == 0.0)
    is_continuous = state[base + CONTINUOUS_BRAKE] > 0.0
    aimed = aim(parameters, now, state, base, -asked, state[base + BRAKE_FORCE], is_continuous)
    force = choose(is_freed, 0.0, aimed.force)
    state[base + FORCE_TARGET] = choose(is_protected, force, -asked)


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
    note_signals(state, base)


def _share_of(whole: float, force: float) -> float:
    """Return which share of the whole a force is, at most 1; 0 of nothing."""
    is_some = whole > 0.0
    return choose(is_some, min(1.0, force / choose(is_some, whole, 1.0)), 0.0)
