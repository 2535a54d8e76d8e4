"""What is kept of a run: one line of outcomes, and its traces if they are asked for."""

from __future__ import annotations

from typing import Any

from railgrip.compiler import compiled
from railgrip.control import contract as ctl
from railgrip.core.status import RunStatus
from railgrip.engine import layout as at
from railgrip.engine.driveline import shaft_torque
from railgrip.engine.sensing import drive_demand, driver_demand

STOPPED = int(RunStatus.STOPPED)


TRAIN_OUTCOMES = (
    "status", "initial_speed", "stopping_distance", "stopping_time", "build_up_time",
    "slide_activity", "energy_kinetic_initial", "energy_kinetic_final", "energy_contact",
    "energy_brake", "energy_dynamic", "energy_track_brake", "energy_resistance",
    "energy_gradient", "energy_rail", "air_used", "energy_traction", "covered_distance",
    "final_speed", "correction_effort", "energy_driveline", "end_position", "end_time",
)  # fmt: skip
"""Columns of Outcome.train."""
AXLE_OUTCOMES = (
    "axle_slid_distance", "axle_slid_energy", "axle_locked_time", "axle_longest_lock",
    "axle_greatest_slip", "axle_slide_time", "axle_greatest_disc_temperature",
    "axle_locked_slide", "axle_valve_cycles", "axle_greatest_spin", "axle_spin_time",
    "axle_greatest_flash", "axle_longest_fast_lock", "axle_mean_adhesion",
)  # fmt: skip
"""Columns of Outcome.axle."""
TRAIN_TRACES = (
    "train_speed", "train_position", "acceleration", "reference_speed", "brake_demand",
    "track_brake_force", "drive_demand", "wsp_state", "brake_correction",
)  # fmt: skip
"""Columns of Outcome.trace_train."""
AXLE_TRACES = (
    "wheel_speed", "measured_speed", "contact_force", "wheel_load", "rail_friction",
    "friction_ratio", "friction_decay", "adhesion_reduction", "slip_reduction", "cleaning",
    "brake_cylinder_pressure", "supply_pressure", "dump_valve", "clamp_force", "pad_friction",
    "brake_force", "dynamic_force", "disc_temperature", "hub_temperature", "is_sliding", "alarm",
    "flash_temperature", "slip_range", "wsp_alarm", "estimated_friction",
    "unit_reference_speed", "unit_state",
    "motor_speed", "driveline_torque",
)  # fmt: skip
"""Columns of Outcome.trace_axle."""


@compiled
def kinetic_energy(L: int, S: Any, n_axles: int, k: int) -> float:
    """Return the kinetic energy of train, wheels and motors."""
    energy = 0.5 * S[at.TRAIN_MASS * L + k] * S[at.TRAIN_SPEED * L + k] ** 2
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L + k
        motor = S[b + at.MOTOR_MASS * L]
        wheelset = S[b + at.ROTATING_MASS * L] - motor
        energy += 0.5 * wheelset * S[b + at.WHEEL_SPEED * L] ** 2
        energy += 0.5 * motor * S[b + at.MOTOR_SPEED * L] ** 2
    return float(energy)


@compiled
def record(L: int, S: Any, memory: Any, plan: Any, out: Any, n_axles: int, k: int) -> None:
    """Write the present state into the run's traces."""
    run = int(S[at.RUN * L + k])
    tick = int(S[at.TICK * L + k])
    row = tick // plan.timing.trace_every
    if run >= out.trace_train.shape[0] or tick % plan.timing.trace_every != 0:
        return
    if row >= out.trace_train.shape[1]:
        return
    train = out.trace_train[run, row]
    train[0] = S[at.TRAIN_SPEED * L + k]
    train[1] = S[at.POSITION * L + k]
    train[2] = -S[at.LAST_DECELERATION * L + k]
    train[3] = memory.command[k, ctl.REFERENCE_SPEED, 0]
    timing = plan.timing
    train[4], _ = driver_demand(
        tick, timing.demand_tick, timing.demand_level, timing.demand_emergency
    )
    train[5] = S[at.TRACK_BRAKE_FORCE * L + k]
    train[6] = drive_demand(tick, timing.drive_tick, timing.drive_level)
    if plan.driver.every > 0:
        train[4], train[6] = S[at.DRIVER_DEMAND * L + k], S[at.DRIVE_DEMAND * L + k]
    train[7] = memory.command[k, ctl.WSP_STATE, 0]
    train[8] = S[at.BRAKE_CORRECTION * L + k]
    for axle in range(n_axles):
        line = out.trace_axle[run, row, axle]
        _record_axle(L, S, memory.command[k].T[axle], line, plan, axle, k)
        line[1] = memory.measured[k, ctl.WHEEL_SPEED, axle]
    n_vehicles = out.trace_vehicle.shape[2]
    for vehicle in range(n_vehicles):
        out.trace_vehicle[run, row, vehicle] = memory.reservoirs[vehicle * L + k]


@compiled
def _record_axle(L: int, S: Any, command: Any, row: Any, plan: Any, axle: int, k: int) -> None:
    b = (1 + axle) * at.N_VARS * L + k
    row[0] = S[b + at.WHEEL_SPEED * L]
    row[2] = S[b + at.CONTACT_FORCE * L]
    row[3] = (
        S[b + at.STATIC_LOAD * L] + S[b + at.LOAD_TRANSFER * L] * S[at.PITCH_DECELERATION * L + k]
    )
    for i in range(at.N_FRICTION):
        row[4 + i] = S[b + (at.FOUND_FRICTION + i) * L]
    row[9] = S[b + at.CLEANING * L]
    row[10] = S[b + at.CYLINDER_PRESSURE * L]
    row[11] = S[b + at.SUPPLY_PRESSURE * L]
    is_vent = S[b + at.IS_VENT * L]
    row[12] = 2.0 * is_vent + (1.0 - is_vent) * (1.0 - S[b + at.IS_FILL * L])
    row[13] = S[b + at.CLAMP_FORCE * L]
    row[14] = S[b + at.PAD_FRICTION * L]
    row[15] = S[b + at.BRAKE_IMPULSE * L] / plan.timing.tick
    row[16] = S[b + at.DYNAMIC_FORCE * L]
    row[17] = S[b + at.RING_TEMPERATURE * L]
    row[18] = S[b + at.HUB_TEMPERATURE * L]
    row[19] = command[ctl.IS_SLIDING]
    row[20] = S[b + at.ALARM * L]
    row[21] = S[b + at.FLASH_RISE * L]
    row[22] = command[ctl.SLIP_RANGE]
    row[23] = command[ctl.ALARM]
    row[24] = S[b + at.ESTIMATED_FRICTION * L]
    row[25] = command[ctl.REFERENCE_SPEED]
    row[26] = command[ctl.WSP_STATE]
    row[27] = S[b + at.MOTOR_SPEED * L]
    row[28] = shaft_torque(L, S, b)


@compiled
def finish_run(L: int, S: Any, plan: Any, out: Any, n_axles: int, k: int, status: int) -> None:
    """Write a run's line of outcomes."""
    run = int(S[at.RUN * L + k])
    row = out.train[run]
    row[0] = status
    row[1] = S[at.BRAKE_SPEED * L + k]
    row[2] = S[at.STOP_POSITION * L + k] - S[at.BRAKE_POSITION * L + k]
    row[3] = S[at.STOP_TIME * L + k] - S[at.BRAKE_TIME * L + k]
    row[5] = S[at.SLIDE_ACTIVE * L + k] / max(S[at.ACTIVE_TIME * L + k], 1e-9)
    row[6] = S[at.KINETIC_START * L + k]
    row[7] = kinetic_energy(L, S, n_axles, k)
    row[11] = S[at.TRACK_BRAKE_ENERGY * L + k]
    row[12] = S[at.RESISTANCE_ENERGY * L + k]
    row[13] = S[at.GRADIENT_ENERGY * L + k]
    row[17] = S[at.POSITION * L + k] - S[at.START_POSITION * L + k]
    row[18] = S[at.TRAIN_SPEED * L + k]
    watched = S[at.EFFORT_TIME * L + k]
    row[19] = S[at.EFFORT_SUM * L + k] / watched
    row[21] = S[at.POSITION * L + k]
    row[22] = S[at.TICK * L + k] * plan.timing.tick
    build_up = 0.0
    full = 0.0
    contact = 0.0
    brake = 0.0
    dynamic = 0.0
    traction = 0.0
    driveline = 0.0
    air = 0.0
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L + k
        full += S[b + at.FULL_FORCE * L]
        build_up += S[b + at.FULL_FORCE * L] * S[b + at.BUILD_UP_TIME * L]
        contact += S[b + at.SLID_ENERGY * L]
        brake += S[b + at.BRAKE_ENERGY * L]
        dynamic += S[b + at.DYNAMIC_ENERGY * L]
        traction += S[b + at.TRACTION_ENERGY * L]
        driveline += S[b + at.DRIVELINE_ENERGY * L]
        air += S[b + at.AIR_USED * L]
        line = out.axle[run, axle]
        line[0] = S[b + at.SLID_DISTANCE * L]
        line[1] = S[b + at.SLID_ENERGY * L]
        line[2] = S[b + at.LOCKED_TIME * L]
        line[3] = S[b + at.LONGEST_LOCK * L]
        line[4] = S[b + at.GREATEST_SLIP * L]
        line[5] = S[b + at.SLIDE_TIME * L]
        line[6] = S[b + at.GREATEST_TEMPERATURE * L]
        line[7] = S[b + at.LOCKED_SLIDE * L]
        line[8] = S[b + at.VALVE_CYCLES * L]
        line[9] = S[b + at.GREATEST_SPIN * L]
        line[10] = S[b + at.SPIN_TIME * L]
        line[11] = S[b + at.GREATEST_FLASH * L]
        line[12] = S[b + at.LONGEST_FAST_LOCK * L]
        line[13] = S[b + at.ADHESION_SUM * L] / watched
    row[4] = build_up / max(full, 1e-9)
    row[8] = contact
    row[9] = brake
    row[10] = dynamic
    row[14] = S[at.RAIL_ENERGY * L + k]
    row[15] = air
    row[16] = traction
    row[20] = driveline
    if status != STOPPED or S[at.BRAKE_TIME * L + k] < 0.0:
        row[2] = float("nan")
        row[3] = float("nan")
