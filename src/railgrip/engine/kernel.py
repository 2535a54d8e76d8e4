"""The batch: lanes that run, end, are written down and take the next run.

One run is a batch of one. Time is counted in ticks; nothing here depends on which lane a run has,
on what ran before it, or on how many threads work, so a run gives the same bits in every company.
"""

from __future__ import annotations

import math
from typing import Any

import numba

from railgrip.control.rotation_monitoring import rotation_monitoring
from railgrip.core.status import RunStatus
from railgrip.engine import layout as at
from railgrip.engine.compiler import inlined
from railgrip.engine.rail import enter_cells, heat_rail, lay_sand, line_forces
from railgrip.engine.records import finish_run, record
from railgrip.engine.sensing import driver_demand, gather, obey
from railgrip.engine.start import begin_run
from railgrip.engine.step import plant_step
from railgrip.engine.tick import account, advance_plant, prepare_tick, sense_all

_lanes = numba.njit(forceinline=True, error_model="numpy")
_scalar = numba.njit(error_model="numpy")
_kernel = numba.njit(error_model="numpy", nogil=True, cache=True)

_rotation_monitoring = inlined(rotation_monitoring)

NORMAL_CUBIC_METRE = 1.0e5
"""Air is counted at 1 bar, Pa."""
NEARLY_STANDING = 0.05
"""Below this speed a stop within the coming tick is looked for, m/s."""

RUNNING = int(RunStatus.RUNNING)
STOPPED = int(RunStatus.STOPPED)
END_OF_TRACK = int(RunStatus.END_OF_TRACK)
TIME_LIMIT = int(RunStatus.TIME_LIMIT)
DIVERGED = int(RunStatus.DIVERGED)
CONTROLLER_FAILED = int(RunStatus.CONTROLLER_FAILED)


@_kernel
def step_lanes(S: Any, n_axles: int, brakes: Any, law: int, custom: Any, h: float, when: float) -> None:
    """One plant step of sixteen lanes: the loop that must be packed arithmetic."""
    plant_step(at.LANES, S, n_axles, brakes, law, custom, h, when)


@_kernel
def step_single(S: Any, n_axles: int, brakes: Any, law: int, custom: Any, h: float, when: float) -> None:
    """One plant step of a single run: the same operations in the same order."""
    plant_step(1, S, n_axles, brakes, law, custom, h, when)


@_scalar
def _drive(L: int, S: Any, plan: Any, k: int) -> None:
    """Let the driver act on lane k."""
    timing = plan.timing
    tick = int(S[at.TICK * L + k])
    demand, emergency = driver_demand(timing, tick)
    S[at.DRIVER_DEMAND * L + k] = demand
    S[at.TRACK_BRAKE_ON * L + k] = emergency
    S[at.DYNAMIC_ALLOWED * L + k] = 1.0 if plan.formation.dynamic_in_emergency == 1 else 1.0 - emergency
    if S[at.BRAKE_TIME * L + k] < 0.0 and tick >= timing.first_brake_tick:
        S[at.BRAKE_TIME * L + k] = tick * timing.tick
        S[at.BRAKE_POSITION * L + k] = S[at.POSITION * L + k]
        S[at.BRAKE_SPEED * L + k] = S[at.TRAIN_SPEED * L + k]
        S[at.FIRST_DEMAND * L + k] = demand


@_scalar
def _look_for_stop(L: int, S: Any, plan: Any, k: int) -> None:
    """Locate the stand within the coming tick: with constant deceleration, exactly."""
    if S[at.STOP_TIME * L + k] >= 0.0:
        return
    speed = S[at.TRAIN_SPEED * L + k]
    deceleration = S[at.LAST_DECELERATION * L + k]
    now = S[at.TICK * L + k] * plan.timing.tick
    if speed <= 0.0:
        S[at.STOP_TIME * L + k] = now
        S[at.STOP_POSITION * L + k] = S[at.POSITION * L + k]
    elif speed < NEARLY_STANDING and speed <= deceleration * plan.timing.tick:
        S[at.STOP_TIME * L + k] = now + speed / deceleration
        S[at.STOP_POSITION * L + k] = (
            S[at.POSITION * L + k] + speed * speed / (2.0 * deceleration)
        )


@_scalar
def _status(L: int, S: Any, plan: Any, n_axles: int, k: int) -> int:
    """Return whether lane k goes on, or how it ends."""
    speed = S[at.TRAIN_SPEED * L + k]
    if not math.isfinite(speed) or not math.isfinite(S[at.POSITION * L + k]):
        return DIVERGED
    if S[at.STOP_TIME * L + k] >= 0.0:
        S[at.STAND_TICKS * L + k] += 1.0
        if S[at.STAND_TICKS * L + k] > plan.timing.after_stop:
            return STOPPED
    elif S[at.POSITION * L + k] >= plan.way.end:
        return END_OF_TRACK
    if S[at.CONTROLLER_ERROR * L + k] > 0.0:
        return CONTROLLER_FAILED
    if S[at.TICK * L + k] >= plan.timing.limit:
        return TIME_LIMIT
    return RUNNING


@_scalar
def _leave_behind(
    L: int, S: Any, memory: Any, plan: Any, n_axles: int, k: int, start: float
) -> None:
    """Heat and sand the rail, take the air from the reservoirs."""
    timing = plan.timing
    formation = plan.formation
    for vehicle in range(formation.vehicle_front.shape[0]):
        memory.reservoirs[vehicle * L + k] += (
            formation.reservoir_recharge[vehicle] * timing.tick
            * NORMAL_CUBIC_METRE / formation.reservoir_volume[vehicle]
        )  # fmt: skip
        memory.reservoirs[vehicle * L + k] = min(
            memory.reservoirs[vehicle * L + k], formation.reservoir_pressure[vehicle]
        )
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        heat_rail(L, S, memory, plan.way, b, k, start, S[b + at.SLID_NOW * L + k])
        rise = S[b + at.CYLINDER_PRESSURE * L + k] - S[b + at.PRESSURE_BEFORE * L + k]
        vehicle = formation.vehicle_of_axle[axle] * L + k
        if rise > 0.0:
            volume = rise * S[b + at.CYLINDER_VOLUME * L + k]
            S[b + at.AIR_USED * L + k] += volume / NORMAL_CUBIC_METRE
            memory.reservoirs[vehicle] -= volume / formation.reservoir_volume[
                formation.vehicle_of_axle[axle]
            ]
        S[b + at.RESERVOIR_PRESSURE * L + k] = memory.reservoirs[vehicle]
        if (
            S[b + at.SANDER_FLOW * L + k] > 0.0
            and S[b + at.SAND_TIME * L + k] * timing.tick > timing.sand_delay
            and S[at.TRAIN_SPEED * L + k] > timing.sand_cut_out
        ):
            lay_sand(L, S, memory, plan.way, b, k, timing.tick)


@_scalar
def _monitor(L: int, S: Any, memory: Any, plan: Any, n_axles: int, k: int) -> None:
    """Let wheel rotation monitoring look at the same speeds, apart from the protection."""
    _rotation_monitoring(
        plan.monitor_parameters, memory.monitor_state[k], memory.measured[k], memory.alarm[k],
        plan.timing.tick * plan.timing.control_every,
    )  # fmt: skip
    for axle in range(n_axles):
        S[((1 + axle) * at.N_VARS + at.ALARM) * L + k] = memory.alarm[k, axle]


@_lanes
def begin_tick(L: int, S: Any, memory: Any, plan: Any, n_axles: int, moment: int) -> None:
    """Everything before the controllers: driver, line, rail, sensors."""
    for k in range(L):
        if S[at.RUN * L + k] >= 0.0:
            _drive(L, S, plan, k)
            enter_cells(L, S, memory, plan.way, n_axles, k, plan.timing.tick)
            if plan.way.is_level == 0:
                line_forces(L, S, plan, k, plan.timing.tick)
    sense_all(L, S, plan, n_axles, moment)


@_lanes
def end_tick(
    L: int, S: Any, memory: Any, plan: Any, n_axles: int, moment: int, custom: Any, step: Any
) -> None:
    """Everything after the controllers: valves, plant, and what the train leaves behind."""
    prepare_tick(L, S, plan, n_axles, moment)
    advance_plant(L, S, plan, n_axles, custom, step)
    account(L, S, plan, n_axles)
    for k in range(L):
        if S[at.RUN * L + k] >= 0.0:
            before = 0.5 * (S[at.SPEED_BEFORE_TICK * L + k] + S[at.TRAIN_SPEED * L + k])
            start = S[at.POSITION * L + k] - before * plan.timing.tick
            _leave_behind(L, S, memory, plan, n_axles, k, start)


@_scalar
def _look_after(
    L: int, S: Any, memory: Any, plan: Any, out: Any, n_axles: int, k: int
) -> int:
    """Record lane k and return whether its run goes on, or how it ends."""
    record(L, S, memory, plan, out, n_axles, k)
    _look_for_stop(L, S, plan, k)
    status = _status(L, S, plan, n_axles, k)
    if status != RUNNING:
        finish_run(L, S, plan, out, n_axles, k, status)
    return status


@_scalar
def control_lane(
    L: int, S: Any, memory: Any, plan: Any, n_axles: int, k: int, moment: int,
    controller: Any, initial: Any,
) -> None:  # fmt: skip
    """Let the compiled controller of lane k measure and command, when it is its turn."""
    if int(S[at.TICK * L + k]) % plan.timing.control_every == 0:
        gather(L, S, memory.measured[k], plan, n_axles, k, moment)
        if S[at.TICK * L + k] == 0.0:
            initial(
                plan.controller_parameters, plan.formation.axle_setup,
                memory.controller_state[k], memory.measured[k],
            )  # fmt: skip
        controller(
            plan.controller_parameters, plan.formation.axle_setup, memory.controller_state[k],
            memory.measured[k], memory.command[k], plan.timing.tick * plan.timing.control_every,
        )  # fmt: skip
        _monitor(L, S, memory, plan, n_axles, k)
    obey(L, S, memory.command[k], n_axles, k, moment)


@_lanes
def _run(
    L: int, memory: Any, plan: Any, overrides: Any, out: Any, first: int, last: int,
    controller: Any, initial: Any, custom: Any, step: Any, progress: Any,
) -> None:  # fmt: skip
    S = memory.lanes
    n_axles = plan.parameters.shape[0] - 1
    upcoming = first
    active = 0
    for k in range(L):
        # an idle lane computes along on somebody's numbers; nobody reads them
        begin_run(L, S, memory, plan, overrides, n_axles, k, min(upcoming, last - 1))
        if upcoming < last:
            upcoming += 1
            active += 1
        else:
            S[at.RUN * L + k] = -1.0
    moment = 0
    while active > 0:
        for k in range(L):
            if S[at.RUN * L + k] < 0.0:
                continue
            if _look_after(L, S, memory, plan, out, n_axles, k) == RUNNING:
                continue
            progress[0] += 1
            if upcoming < last:
                begin_run(L, S, memory, plan, overrides, n_axles, k, upcoming)
                _look_after(L, S, memory, plan, out, n_axles, k)
                upcoming += 1
            else:
                S[at.RUN * L + k] = -1.0
                active -= 1
        begin_tick(L, S, memory, plan, n_axles, moment)
        for k in range(L):
            if S[at.RUN * L + k] >= 0.0:
                control_lane(L, S, memory, plan, n_axles, k, moment, controller, initial)
        end_tick(L, S, memory, plan, n_axles, moment, custom, step)
        moment += 1


@_kernel
def run_lanes(
    memory: Any, plan: Any, overrides: Any, out: Any, first: int, last: int,
    controller: Any, initial: Any, custom: Any, progress: Any,
) -> None:  # fmt: skip
    """Compute the runs first … last − 1, sixteen at a time."""
    _run(
        at.LANES, memory, plan, overrides, out, first, last, controller, initial, custom,
        step_lanes, progress,
    )  # fmt: skip


@_kernel
def run_single(
    memory: Any, plan: Any, overrides: Any, out: Any, first: int, last: int,
    controller: Any, initial: Any, custom: Any, progress: Any,
) -> None:  # fmt: skip
    """Compute the runs first … last − 1, one after the other."""
    _run(
        1, memory, plan, overrides, out, first, last, controller, initial, custom, step_single,
        progress,
    )


@_kernel
def begin_single(memory: Any, plan: Any, overrides: Any, run: int) -> None:
    """Put a run at its start, for a controller that is stepped from Python."""
    begin_run(1, memory.lanes, memory, plan, overrides, plan.parameters.shape[0] - 1, 0, run)


@_kernel
def before_control_single(memory: Any, plan: Any, out: Any, moment: int) -> int:
    """Begin a tick up to what the controller sees; return the status, RUNNING if it goes on."""
    S = memory.lanes
    n_axles = plan.parameters.shape[0] - 1
    status = _look_after(1, S, memory, plan, out, n_axles, 0)
    if status == RUNNING:
        begin_tick(1, S, memory, plan, n_axles, moment)
        if int(S[at.TICK]) % plan.timing.control_every == 0:
            gather(1, S, memory.measured[0], plan, n_axles, 0, moment)
            _monitor(1, S, memory, plan, n_axles, 0)
    return int(status)


@_kernel
def after_control_single(memory: Any, plan: Any, moment: int, custom: Any) -> None:
    """Obey the command and finish the tick."""
    S = memory.lanes
    n_axles = plan.parameters.shape[0] - 1
    obey(1, S, memory.command[0], n_axles, 0, moment)
    end_tick(1, S, memory, plan, n_axles, moment, custom, step_single)
