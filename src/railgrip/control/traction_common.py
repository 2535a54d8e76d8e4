"""What the traction controllers share: observe, know the train's speed, brake as the ordinary WSP.

They act on motored axles only while the motors are asked and the brake is not. Otherwise the
ordinary protection works, unchanged.
"""

from __future__ import annotations

from railgrip.control.adhesion_kalman import observe_by_kalman
from railgrip.control.axle_alarm import ALARM_SENSOR
from railgrip.control.axle_forces import force_per_pressure, motor_force, pressures
from railgrip.control.axle_protection import protect_axles
from railgrip.control.axle_signals import take_command
from railgrip.control.contract import (
    ALARM,
    AXLE_LOAD,
    BRAKED,
    CYLINDER_PRESSURE,
    DRIVE_DEMAND,
    DUMP_VALVE,
    DYNAMIC_FORCE,
    DYNAMIC_SHARE,
    FILL,
    FRICTION_SHARE,
    FULL_FORCE,
    IS_SLIDING,
    MOTORED,
    REFERENCE_SPEED,
    ROTATING_MASS,
    SANDING,
    TRACTIVE_EFFORT,
    TRACTIVE_POWER,
    VENT,
    FloatArray,
)
from railgrip.control.conventional_parameters import ROTATING_SHARE, SLIP_LOWER, conventional_of
from railgrip.control.conventional_state import DECELERATION, IS_FAULTY, REFERENCE, SLIDES, SPEED
from railgrip.control.conventional_wsp import conventional_initial
from railgrip.control.diameter_compensation import learn_diameters
from railgrip.control.driven_faults import drive_as_neighbours, watch_driven_sensors
from railgrip.control.driving_sights import know_train_speed
from railgrip.control.sanding_request import request_sand
from railgrip.control.slip_band import note_slide, threshold
from railgrip.control.state_layout import axle_base
from railgrip.control.traction_parameters import FORCE_DRIFT, SLIP_GAIN, SPEED_NOISE
from railgrip.control.traction_state import (
    APPLIED_BEFORE,
    BELIEVED_SPEED,
    CLOCK,
    FORCE,
    FORCE_PER_PRESSURE,
    LOAD,
    LOOKING,
    MASS,
    SHARE,
    SHARE_AT_SPIN,
)
from railgrip.control.train_observer import look_at_wheels, observe_train
from railgrip.core.constants import GRAVITY

USUAL_LOAD = 130.0e3
"""Axle load where the vehicle does not tell it, N (illustrative)."""
STANDING = 0.05
"""A wheel slower than this stands: its brake may hold more than the rail, m/s."""
LEAST_SPEED = 0.1
"""Below it power no longer bounds the tractive effort, m/s."""
SPIN_SHARE, SPIN_FLOOR = 0.01, 0.1
"""A wheel faster than the train by more than this share, or this, m/s, spins."""


def traction_initial(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Fill the state at the start: masses and loads, full torque permitted."""
    conventional_initial(parameters, axle_setup, state, measured)
    n_axles = measured.shape[0]
    for axle in range(n_axles):
        base = axle_base(axle)
        load = axle_setup[axle, AXLE_LOAD]
        load = load if load > 1.0e3 else USUAL_LOAD
        mass = axle_setup[axle, ROTATING_MASS]
        state[base + LOAD] = load
        state[base + MASS] = mass if mass > 0.0 else parameters[ROTATING_SHARE] * load / GRAVITY
        full = axle_setup[axle, FULL_FORCE]
        state[base + FORCE_PER_PRESSURE] = force_per_pressure(axle_setup, axle, full)
        state[base + BELIEVED_SPEED] = state[base + SPEED]
        state[base + SHARE] = 1.0
        state[base + SHARE_AT_SPIN] = 1.0


def observe_while_driving(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    dt: float,
) -> None:  # fmt: skip
    """Update wheels, forces of the rails, and reference speed in the state."""
    n_axles = measured.shape[0]
    look_at_wheels(parameters, state, measured, parameters[SLIP_LOWER], dt)
    watch_driven_sensors(parameters, axle_setup, state, measured, dt)
    for axle in range(n_axles):
        _observe_force(parameters, axle_setup, state, measured, axle, dt)
    know_train_speed(parameters, axle_setup, state, measured, dt)
    state[CLOCK] += dt


def _observe_force(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    axle: int, dt: float,
) -> None:  # fmt: skip
    base = axle_base(axle)
    speed = state[base + SPEED]
    mass = state[base + MASS]
    applied = -measured[axle, DYNAMIC_FORCE]
    if axle_setup[axle, BRAKED] > 0.0:
        over = measured[axle, CYLINDER_PRESSURE] - pressures(axle_setup, axle)[0]
        if 0.0 < over < 1.0e7:
            applied -= state[base + FORCE_PER_PRESSURE] * over
    before = state[base + APPLIED_BEFORE]
    state[base + APPLIED_BEFORE] = applied
    if speed < STANDING or state[base + IS_FAULTY] > 0.0:
        state[base + BELIEVED_SPEED] = speed
        state[base + FORCE] = max(applied, 0.0)
        return
    index = parameters[FORCE_DRIFT] / mass * dt * dt / parameters[SPEED_NOISE]
    # speeds come one period late, so the forces of one period ago are put beside them
    state[base + BELIEVED_SPEED], state[base + FORCE] = observe_by_kalman(
        speed, state[base + BELIEVED_SPEED], state[base + FORCE], before, mass,
        index, dt,
    )  # fmt: skip


def demanded_force(
    axle_setup: FloatArray, state: FloatArray, measured: FloatArray, axle: int
) -> float:
    """Return what the driver asks of an axle's motor at its present speed, [N]."""
    speed = state[axle_base(axle) + SPEED]
    effort = motor_force(
        axle_setup[axle, TRACTIVE_EFFORT], axle_setup[axle, TRACTIVE_POWER], speed, LEAST_SPEED
    )
    demand: float = effort * measured[axle, DRIVE_DEMAND]
    return demand


def lead_slip(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    axle: int, aim: float,
) -> float:  # fmt: skip
    """Return the share of the demanded motor force that leads the slip speed to an aim, 0..1.

    Notes
    -----
    F* = F + m_r (a_train + k (w_aim − w)), with the observed force F of the rail: the wheel then
    nears the slip speed aimed at with the time constant 1/k.
    """
    base = axle_base(axle)
    speed = state[base + SPEED]
    demand = demanded_force(axle_setup, state, measured, axle)
    if demand <= 0.0 or speed < STANDING:
        return 1.0
    error = aim - (speed - state[REFERENCE])
    wanted = parameters[SLIP_GAIN] * error - state[DECELERATION]
    force = state[base + FORCE] + state[base + MASS] * wanted
    return float(max(0.0, min(1.0, force / demand)))


def command_motor(
    parameters: FloatArray, state: FloatArray, command: FloatArray,
    axle: int, share: float, dt: float,
) -> None:  # fmt: skip
    """Write the command of one axle while the train is driven."""
    base = axle_base(axle)
    spin_speed = state[base + SPEED] - state[REFERENCE]
    lower = threshold(SPIN_SHARE, SPIN_FLOOR, state[REFERENCE])
    limited = share < 0.999 and spin_speed > lower
    note_slide(state, base, VENT if limited else FILL, spin_speed, lower, dt)
    state[base + SHARE] = share
    is_looking = state[LOOKING] == axle + 1.0
    command[axle, DYNAMIC_SHARE] = 0.0 if is_looking else share
    command[axle, FRICTION_SHARE] = 1.0
    command[axle, DUMP_VALVE] = FILL
    command[axle, SANDING] = request_sand(
        conventional_of(parameters), state, base, state[REFERENCE], dt
    )
    command[axle, IS_SLIDING] = state[base + SLIDES]
    command[axle, ALARM] = ALARM_SENSOR if state[base + IS_FAULTY] > 0.0 else 0.0
    command[axle, REFERENCE_SPEED] = state[REFERENCE]


def brake_conventionally(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    command: FloatArray, dt: float,
) -> None:  # fmt: skip
    """Advance the ordinary protection by one period, and forget what driving had learned."""
    observe_train(parameters, state, measured, parameters[SLIP_LOWER], dt)
    learn_diameters(parameters, state, measured, dt)
    n_axles = measured.shape[0]
    take_command(state, command)
    protect_axles(parameters, state, command, dt)
    for axle in range(n_axles):
        base = axle_base(axle)
        state[base + SHARE] = 1.0
        state[base + BELIEVED_SPEED] = state[base + SPEED]
        state[base + FORCE] = 0.0
    state[LOOKING] = 0.0


def acts_on(axle_setup: FloatArray, state: FloatArray, axle: int) -> bool:
    """Return whether an axle has a motor and its speed is believed."""
    is_sound = state[axle_base(axle) + IS_FAULTY] == 0.0
    return bool(axle_setup[axle, MOTORED] > 0.0 and is_sound)


def agree(axle_setup: FloatArray, state: FloatArray, command: FloatArray, n_axles: int) -> None:
    """Let motors of wheels that are not believed follow the others, and every sander work at once.

    Wheels without a motor never spin, so all sanders work while one driven axle wants sand.
    """
    drive_as_neighbours(axle_setup, state, command, n_axles)
    is_wanted = 0.0
    for axle in range(n_axles):
        is_wanted = max(is_wanted, command[axle, SANDING])
    for axle in range(n_axles):
        command[axle, SANDING] = is_wanted
