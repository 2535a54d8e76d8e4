"""One axle under temperature control: from its speed to the shares of brake and motor."""

from __future__ import annotations

from railgrip.control.axle_forces import motor_force, pressure_for, pressures
from railgrip.control.axle_protection import axle_alarm
from railgrip.control.contract import (
    ALARM,
    BRAKE_DEMAND,
    BRAKED,
    BRAKING_EFFORT,
    CONTINUOUS,
    CYLINDER_PRESSURE,
    DRIVE_DEMAND,
    DUMP_VALVE,
    DYNAMIC_FORCE,
    DYNAMIC_SHARE,
    FILL,
    FRICTION_SHARE,
    HOLD,
    IS_SLIDING,
    MOTORED,
    SANDING,
    TRACTIVE_EFFORT,
    VENT,
    FloatArray,
)
from railgrip.control.conventional_parameters import (
    DYNAMIC_LEAST_FORCE,
    INHIBIT_SPEED,
)
from railgrip.control.conventional_state import (
    ACCELERATION,
    FREED_AXLE,
    IS_FAULTY,
    REFERENCE,
    SLIDES,
    SPEED,
    axle_base,
)
from railgrip.control.pressure_following import follow_pressure
from railgrip.control.safety_timer import watch_release
from railgrip.control.sanding_request import request_sand
from railgrip.control.slip_band import note_slide, threshold
from railgrip.control.temperature_parameters import (
    EXCESS_GAIN,
    LEAST_SPEED,
    VALVE_EXCESS_GAIN,
    VALVE_LEAD,
)
from railgrip.control.temperature_state import (
    BRAKE_FORCE,
    FACTOR,
    FORCE_TARGET,
    FRICTION,
    FRICTION_SPEED,
    LOAD,
    MASS,
    MOVING,
    POWER_TARGET,
    SLIP,
    SLIP_TARGET,
    STILL,
    TRAIN_ACCELERATION,
    own_base,
    train_base,
)
from railgrip.control.temperature_targets import (
    admissible_power,
    force_target,
    friction_speed,
    signed_slip,
    slip_target,
)

SLIDE_SHARE, SLIDE_FLOOR = 0.01, 0.15
"""A wheel slower than the train by more than this share, or this, m/s, slides."""
LIMITED = 0.999
"""Share of the demand below which a force counts as limited."""


def aim(
    parameters: FloatArray, state: FloatArray, n_axles: int, axle: int, demand: float, whole: float,
    is_continuous: bool,
) -> float:  # fmt: skip
    """Return F*, signed, and leave all that it was reckoned from in the state, [N]."""
    train = train_base(n_axles)
    own = own_base(n_axles, axle)
    base = axle_base(axle)
    wheel, reference = state[base + SPEED], state[REFERENCE]
    fastest = max(wheel, reference)
    slip = signed_slip(parameters, wheel, reference)
    relative = state[base + ACCELERATION] - state[train + TRAIN_ACCELERATION]
    foreseen = slip
    if not is_continuous:
        foreseen += parameters[VALVE_LEAD] * relative / max(fastest, parameters[LEAST_SPEED])
    power = admissible_power(
        parameters, state[own + STILL], state[own + MOVING], wheel, reference, state[train + FACTOR]
    )
    speed = friction_speed(parameters, power, state[own + FRICTION], state[own + LOAD])
    wanted = slip_target(parameters, speed, fastest, 1.0 if demand > 0.0 else -1.0)
    state[own + SLIP] = slip
    state[own + POWER_TARGET] = power
    state[own + FRICTION_SPEED] = speed
    state[own + SLIP_TARGET] = wanted
    excess = parameters[EXCESS_GAIN] if is_continuous else parameters[VALVE_EXCESS_GAIN]
    return force_target(
        parameters, foreseen, wanted, state[own + FRICTION], state[train + TRAIN_ACCELERATION],
        state[own + MASS], whole, excess, demand, fastest,
    )  # fmt: skip


def drive_axle(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    command: FloatArray, axle: int, dt: float,
) -> None:  # fmt: skip
    """Write the command of one axle while the train is driven."""
    n_axles = measured.shape[0]
    base = axle_base(axle)
    own = own_base(n_axles, axle)
    effort = motor_force(
        axle_setup, axle, state[base + SPEED], TRACTIVE_EFFORT, parameters[LEAST_SPEED]
    )
    demand = effort * measured[axle, DRIVE_DEMAND]
    share = 1.0
    state[own + FORCE_TARGET] = demand
    if demand > 0.0 and state[base + IS_FAULTY] == 0.0:
        force = aim(parameters, state, n_axles, axle, demand, effort, True)
        state[own + FORCE_TARGET] = force
        share = min(1.0, force / demand)
    command[axle, DYNAMIC_SHARE] = share
    command[axle, FRICTION_SHARE] = 1.0
    command[axle, DUMP_VALVE] = FILL
    spin_speed = state[base + SPEED] - state[REFERENCE]
    lower = threshold(SLIDE_SHARE, SLIDE_FLOOR, state[REFERENCE])
    limited = share < LIMITED and spin_speed > lower
    note_slide(state, base, VENT if limited else FILL, spin_speed, lower, dt)
    command[axle, SANDING] = request_sand(parameters, state, base, dt)
    command[axle, IS_SLIDING] = state[base + SLIDES]
    command[axle, ALARM] = axle_alarm(state, base)


def brake_axle(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    command: FloatArray, axle: int, dt: float,
) -> None:  # fmt: skip
    """Write the command of one axle while the train is braked, or rolls."""
    n_axles = measured.shape[0]
    base = axle_base(axle)
    own = own_base(n_axles, axle)
    reference = state[REFERENCE]
    asked = measured[axle, BRAKE_DEMAND] * state[own + BRAKE_FORCE]
    force = asked
    is_protected = (
        state[base + IS_FAULTY] == 0.0 and reference >= parameters[INHIBIT_SPEED] and asked > 0.0
    )
    if is_protected:
        whole = state[own + BRAKE_FORCE]
        is_continuous = axle_setup[axle, CONTINUOUS] > 0.0
        force = -aim(parameters, state, n_axles, axle, -asked, whole, is_continuous)
        if state[FREED_AXLE] == axle + 1.0:
            force = 0.0
    slip_speed = reference - state[base + SPEED]
    lower = threshold(SLIDE_SHARE, SLIDE_FLOOR, reference)
    limited = force < LIMITED * asked
    note_slide(state, base, VENT if limited and slip_speed > lower else FILL, slip_speed, lower, dt)
    # an axle that its motor brakes is not released, whatever its cylinder says
    by_motor = measured[axle, DYNAMIC_FORCE] > parameters[DYNAMIC_LEAST_FORCE]
    stood = HOLD if limited and not by_motor else FILL
    if watch_release(parameters, state, base, measured, axle, stood, dt):
        force = asked
    state[own + FORCE_TARGET] = -force
    _apply(parameters, axle_setup, state, measured, command, axle, asked, force, dt)
    command[axle, SANDING] = request_sand(parameters, state, base, dt)
    command[axle, IS_SLIDING] = state[base + SLIDES]
    command[axle, ALARM] = axle_alarm(state, base)


def _apply(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    command: FloatArray, axle: int, asked: float, force: float, dt: float,
) -> None:  # fmt: skip
    """Let the motor take what it can of the force, and the friction brake the rest."""
    n_axles = measured.shape[0]
    base = axle_base(axle)
    own = own_base(n_axles, axle)
    command[axle, DYNAMIC_SHARE] = 1.0
    command[axle, FRICTION_SHARE] = 1.0
    dynamic = max(measured[axle, DYNAMIC_FORCE], 0.0)
    is_limited = force < LIMITED * asked
    if axle_setup[axle, MOTORED] > 0.0 and is_limited:
        able = motor_force(
            axle_setup, axle, state[base + SPEED], BRAKING_EFFORT, parameters[LEAST_SPEED]
        )
        able = min(able, asked)
        command[axle, DYNAMIC_SHARE] = min(1.0, force / able) if able > 0.0 else 0.0
    rest = max(force - dynamic, 0.0)
    if axle_setup[axle, CONTINUOUS] > 0.0 or axle_setup[axle, BRAKED] == 0.0:
        left = asked - dynamic
        if is_limited:
            command[axle, FRICTION_SHARE] = min(1.0, rest / left) if left > 0.0 else 0.0
        command[axle, DUMP_VALVE] = FILL
    elif not is_limited:
        command[axle, DUMP_VALVE] = FILL
    else:
        wanted = pressure_for(axle_setup, state, own, axle, rest)
        supply = pressures(axle_setup, axle)[1] * measured[axle, BRAKE_DEMAND]
        pressure = measured[axle, CYLINDER_PRESSURE]
        command[axle, DUMP_VALVE] = follow_pressure(
            parameters, state, own, pressure, wanted, supply, dt
        )
