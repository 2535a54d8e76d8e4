"""A lane takes a run: parameters, then the state of a train that rolls freely on fresh rail."""

from __future__ import annotations

import math
from typing import Any

from railgrip.compiler import compiled
from railgrip.control import contract as ctl
from railgrip.engine import layout as at
from railgrip.engine.driveline import begin_driveline
from railgrip.engine.rail import enter_cells, field_before, lay_rail
from railgrip.engine.records import kinetic_energy
from railgrip.engine.sensing import note_brake_command


@compiled
def begin_run(L: int, S: Any, memory: Any, plan: Any, overrides: Any, k: int, run: int) -> None:
    """Put lane k at the start of a run."""
    n_axles = plan.formation.vehicle_of_axle.shape[0]
    for i in range((1 + n_axles) * at.N_VARS):
        S[i * L + k] = 0.0
    for block in range(1 + n_axles):
        first = block * at.N_VARS + at.FIRST_PARAMETER
        for i in range(plan.parameters.shape[1]):
            S[(first + i) * L + k] = plan.parameters[block, i]
    for i in range(overrides.target.shape[0]):
        block = overrides.target[i] // at.N_PARAMETERS
        place = overrides.target[i] % at.N_PARAMETERS
        S[(block * at.N_VARS + at.FIRST_PARAMETER + place) * L + k] = overrides.value[run, i]
    S[at.RUN * L + k] = float(run)
    S[at.NUMBER * L + k] = float(overrides.number[run])
    S[at.STOP_TIME * L + k] = -1.0
    S[at.BRAKE_TIME * L + k] = -1.0
    S[at.TRAIN_SPEED * L + k] = S[at.INITIAL_SPEED * L + k]
    S[at.POSITION * L + k] = S[at.START_POSITION * L + k]
    _begin_rail(L, S, memory, plan.way, n_axles, k)
    for axle in range(n_axles):
        _begin_axle(L, S, plan, k, axle)
    note_brake_command(L, S, plan.timing, k)
    S[at.KINETIC_START * L + k] = kinetic_energy(L, S, n_axles, k)
    for vehicle in range(plan.formation.vehicle_front.shape[0]):
        memory.reservoirs[vehicle * L + k] = plan.formation.reservoir_pressure[vehicle]
    if plan.driver.every > 0:
        S[at.DRIVE_DEMAND * L + k] = 1.0  # it stands, and is about to move
    for axle in range(plan.driver.discs.shape[0]):
        _begin_warm(L, S, plan.driver.discs, k, axle)
    _begin_control(L, S, memory, n_axles, k)


@compiled
def _begin_rail(L: int, S: Any, memory: Any, way: Any, n_axles: int, k: int) -> None:
    energy, factor, sand = memory.ring_energy, memory.ring_factor, memory.ring_sand
    front = S[at.POSITION * L + k]
    rear = front - S[at.TRAIN_LENGTH * L + k]
    first = math.floor((rear - way.origin) / way.cell_length) - 3
    # the field forgets where it began: begun far behind, it is the same for any train and start
    first -= way.cells_to_forget
    S[at.RAIL_FRONT * L + k] = float(first - 1)
    S[at.FIELD * L + k] = field_before(way, int(S[at.NUMBER * L + k]), first)
    ahead = math.floor((front - way.origin) / way.cell_length) + 3
    lay_rail(L, S, energy, factor, sand, way, k, ahead)
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        place = (front - S[b + at.OFFSET * L + k] - way.origin) / way.cell_length - 0.5
        # two cells back: entering then reads both cells that the wheel stands between
        S[b + at.CELL * L + k] = math.floor(place) - 2.0
    enter_cells(L, S, energy, factor, sand, way, n_axles, 0.0, k)
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        place = (front - S[b + at.OFFSET * L + k] - way.origin) / way.cell_length - 0.5
        share = place - S[b + at.CELL * L + k]
        for i in range(at.N_FRICTION):
            behind = S[b + (at.BEHIND_FRICTION + i) * L + k]
            step = S[b + (at.AHEAD_FRICTION + i) * L + k] - behind
            S[b + (at.FOUND_FRICTION + i) * L + k] = behind + share * step


@compiled
def _begin_axle(L: int, S: Any, plan: Any, k: int, axle: int) -> None:
    b = (1 + axle) * at.N_VARS * L + k
    speed = S[at.TRAIN_SPEED * L + k]
    believed = speed * S[b + at.BELIEVED_RATIO * L]
    S[b + at.WHEEL_SPEED * L] = speed
    begin_driveline(L, S, b, speed, plan.timing.tick)
    S[b + at.SPEED_BEFORE * L] = speed
    S[b + at.RING_TEMPERATURE * L] = S[b + at.START_TEMPERATURE * L]
    S[b + at.HUB_TEMPERATURE * L] = S[b + at.START_TEMPERATURE * L]
    S[b + at.RING_MIDDLE * L] = S[b + at.START_TEMPERATURE * L]
    S[b + at.HUB_MIDDLE * L] = S[b + at.START_TEMPERATURE * L]
    S[b + at.GREATEST_TEMPERATURE * L] = S[b + at.START_TEMPERATURE * L]
    S[b + at.MEASURED_SPEED * L] = believed
    S[b + at.IS_FILL * L] = 1.0
    S[b + at.DYNAMIC_SHARE * L] = 1.0
    S[b + at.FRICTION_SHARE * L] = 1.0
    S[b + at.FORCE_FACTOR * L] = 1.0
    S[b + at.PRESSURE_FACTOR * L] = 1.0
    S[b + at.SENSED_TEMPERATURE * L] = S[b + at.START_TEMPERATURE * L]
    S[b + at.RESERVOIR_PRESSURE * L] = plan.formation.reservoir_pressure[
        plan.formation.vehicle_of_axle[axle]
    ]
    for i in range(at.MAX_DELAY):
        S[b + (at.SPEED_HISTORY + i) * L] = believed
        S[b + (at.VALVE_HISTORY + i) * L] = ctl.FILL


@compiled
def _begin_warm(L: int, S: Any, discs: Any, k: int, axle: int) -> None:
    """Let an axle's disc be as warm as the leg before left it."""
    b = (1 + axle) * at.N_VARS * L + k
    S[b + at.RING_TEMPERATURE * L] = S[b + at.RING_MIDDLE * L] = discs[axle, 0]
    S[b + at.HUB_TEMPERATURE * L] = S[b + at.HUB_MIDDLE * L] = discs[axle, 1]
    S[b + at.GREATEST_TEMPERATURE * L] = S[b + at.SENSED_TEMPERATURE * L] = discs[axle, 0]


@compiled
def _begin_control(L: int, S: Any, memory: Any, n_axles: int, k: int) -> None:
    for i in range(memory.controller_state.shape[1]):
        memory.controller_state[k, i] = 0.0
    for i in range(memory.monitor_state.shape[1]):
        memory.monitor_state[k, i] = 0.0
    for i in range(memory.brake_state.shape[1]):
        memory.brake_state[k, i] = 0.0
    for i in range(memory.driver_state.shape[1]):
        memory.driver_state[k, i] = 0.0
    for i in range(memory.demand_history.shape[1]):
        memory.demand_history[k, i] = 0.0
    for axle in range(n_axles):
        memory.alarm[k, axle] = 0.0
    for axle in range(n_axles):
        for i in range(ctl.N_COMMAND):
            memory.command[k, i, axle] = 0.0
        for i in range(ctl.N_MEASURED):
            memory.measured[k, i, axle] = 0.0
        measured = S[((1 + axle) * at.N_VARS + at.MEASURED_SPEED) * L + k]
        memory.measured[k, ctl.WHEEL_SPEED, axle] = measured
        memory.command[k, ctl.DYNAMIC_SHARE, axle] = 1.0
        memory.command[k, ctl.FRICTION_SHARE, axle] = 1.0
        memory.command[k, ctl.REFERENCE_SPEED, axle] = S[at.TRAIN_SPEED * L + k]
