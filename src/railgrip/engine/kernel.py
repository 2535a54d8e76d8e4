"""The batch: lanes that run, end, are written down and take the next run.

One run is a batch of one. Time is counted in ticks; nothing here depends on which lane a run has,
on what ran before it, or on how many threads work, so a run gives the same bits in every company.

A tick is a row of stages. Each is compiled by itself and called once for all lanes, since passing
the plan to a function costs more than a lane's share of the work.
"""

from __future__ import annotations

import math
from typing import Any

from railgrip.compiler import compiled, entry, inlined
from railgrip.control.rotation_monitoring import rotation_monitoring
from railgrip.core.status import RunStatus
from railgrip.engine import layout as at
from railgrip.engine import offsets as to
from railgrip.engine.brake_control_tick import control_brakes
from railgrip.engine.driver import act_as_driver
from railgrip.engine.faults import break_sensors, break_valves, seize_axles
from railgrip.engine.offsets import width
from railgrip.engine.plug_ins import call_step
from railgrip.engine.rail import enter_cells, heat_rail, lay_sand, line_forces
from railgrip.engine.records import finish_run, record
from railgrip.engine.sensing import (
    ask_for_sand,
    drive_demand,
    driver_demand,
    gather,
    note_brake_command,
    obey,
    sense_pass,
    share_inverters,
    valve_pass,
)
from railgrip.engine.start import begin_run
from railgrip.engine.step import plant_step
from railgrip.engine.tick import account, begin_train, hand_down, prepare_axle

_rotation_monitoring = inlined(rotation_monitoring)

NORMAL_PRESSURE = 1.0e5
"""Air is counted at 1 bar, Pa."""
NEARLY_STANDING = 0.05
"""Below this speed a stop within the coming tick is looked for, m/s."""
ROLLING_BACK = -0.5
"""A driven train that is slower than this has not got its load under way, m/s."""
WRAP = at.MAX_DELAY - 1
"""LLVM sees by it that a place in the history is none of another variable."""

RUNNING = int(RunStatus.RUNNING)
STOPPED = int(RunStatus.STOPPED)
END_OF_TRACK = int(RunStatus.END_OF_TRACK)
TIME_LIMIT = int(RunStatus.TIME_LIMIT)
DIVERGED = int(RunStatus.DIVERGED)
CONTROLLER_FAILED = int(RunStatus.CONTROLLER_FAILED)
COMPLETED = int(RunStatus.COMPLETED)
STALLED = int(RunStatus.STALLED)


@inlined
def _kept_place(timing: Any, moment: int) -> Any:
    """Return which of the kept ticks a moment has."""
    return to.as_offset(moment & timing.kept & WRAP)


@entry
def step_lanes(S: Any, n_axles: int, creep_law: int, tables: Any, custom: Any, h: float) -> None:
    """One plant step of sixteen lanes: the loops that must be packed arithmetic."""
    plant_step(to.SIXTEEN_LANES, S, n_axles, creep_law, tables, custom, h)


@entry
def step_single(S: Any, n_axles: int, creep_law: int, tables: Any, custom: Any, h: float) -> None:
    """One plant step of a single run: the same operations in the same order."""
    plant_step(to.ONE_LANE, S, n_axles, creep_law, tables, custom, h)


@inlined
def _advance(lanes: Any, S: Any, plan: Any, custom: Any, step: Any, moment: int) -> None:
    timing, way = plan.timing, plan.way
    has_faults = plan.faults.axle.shape[0] > 0
    vent = to.VALVE_HISTORY + _kept_place(timing, moment - timing.vent_delay)
    fill = to.VALVE_HISTORY + _kept_place(timing, moment - timing.fill_delay)
    for axle in range(plan.n_axles):
        b = (axle + to.AXLE_BLOCK) * to.N_VARS * width(lanes)
        valve_pass(lanes, S, b, vent, fill)
        if has_faults:
            for k in range(len(lanes)):
                break_valves(len(lanes), S, plan.faults, timing, moment, axle, k)
        prepare_axle(
            lanes, S, b, plan.formation.brakes[axle], timing.demand_tick, timing.demand_level,
            way.origin, 1.0 / way.cell_length, timing.tick,
        )  # fmt: skip
    if has_faults:
        for k in range(len(lanes)):
            seize_axles(len(lanes), S, plan.faults, k)
    step(S, plan.n_axles, plan.creep_law, plan.creep_tables, custom, timing.tick)
    account(lanes, S, plan.n_axles, timing.tick)


@entry
def advance_lanes(S: Any, plan: Any, custom: Any, moment: int) -> None:
    """One tick of sixteen lanes."""
    _advance(to.SIXTEEN_LANES, S, plan, custom, step_lanes, moment)


@entry
def advance_single(S: Any, plan: Any, custom: Any, moment: int) -> None:
    """One tick of a single run."""
    _advance(to.ONE_LANE, S, plan, custom, step_single, moment)


@inlined
def _sense(lanes: Any, S: Any, plan: Any, moment: int) -> None:
    L = width(lanes)
    timing = plan.timing
    slot = to.SPEED_HISTORY + _kept_place(timing, moment)
    begin_train(lanes, S, timing.tick)
    for axle in range(plan.n_axles):
        b = (axle + to.AXLE_BLOCK) * to.N_VARS * L
        hand_down(lanes, S, b)
        sense_pass(
            lanes, S, b, timing.tick, timing.sensor_teeth, 1.0 / timing.sensor_timer,
            float(timing.control_every), slot,
        )  # fmt: skip
    if plan.faults.axle.shape[0] > 0:
        for k in range(len(lanes)):
            break_sensors(len(lanes), S, plan.faults, timing, moment, plan.way.seed, k)


@entry
def sense_lanes(S: Any, plan: Any, moment: int) -> None:
    """Every speed sensor of sixteen lanes."""
    _sense(to.SIXTEEN_LANES, S, plan, moment)


@entry
def sense_single(S: Any, plan: Any, moment: int) -> None:
    """Every speed sensor of a single run."""
    _sense(to.ONE_LANE, S, plan, moment)


@entry
def drive(L: int, S: Any, memory: Any, plan: Any) -> None:
    """Let the driver act, and find line and rail in the middle of the coming tick."""
    timing, way, formation = plan.timing, plan.way, plan.formation
    energy, factor, sand = memory.ring_energy, memory.ring_factor, memory.ring_sand
    n_axles = formation.vehicle_of_axle.shape[0]
    times, levels, emergencies = timing.demand_tick, timing.demand_level, timing.demand_emergency
    for k in range(L):
        if S[at.RUN * L + k] < 0.0:
            continue
        tick = int(S[at.TICK * L + k])
        demand, emergency = driver_demand(tick, times, levels, emergencies)
        if plan.driver.every > 0:
            act_as_driver(L, S, memory, plan.driver, n_axles, timing.tick, k)
        else:
            S[at.DRIVER_DEMAND * L + k] = demand
            S[at.DRIVE_DEMAND * L + k] = drive_demand(tick, timing.drive_tick, timing.drive_level)
        S[at.EMERGENCY * L + k] = emergency
        S[at.TRACK_BRAKE_ON * L + k] = emergency
        allowed = formation.dynamic_in_emergency == 1 or emergency == 0.0
        S[at.DYNAMIC_ALLOWED * L + k] = 1.0 if allowed else 0.0
        note_brake_command(L, S, timing, k)
        enter_cells(L, S, energy, factor, sand, way, n_axles, 0.5 * timing.tick, k)
        if way.is_level == 0:
            line_forces(L, S, way, formation, 0.5 * timing.tick, k)


@compiled
def _listen(
    L: int, S: Any, memory: Any, monitor: Any, timing: Any, n_axles: int, moment: int, k: int
) -> None:
    """Put what lane k measures into its table; wheel rotation monitoring looks at it too."""
    slot = to.SPEED_HISTORY + _kept_place(timing, moment - timing.sensor_delay)
    measured, alarm = memory.measured[k].T, memory.alarm[k]
    demand, emergency = S[at.DRIVER_DEMAND * L + k], S[at.EMERGENCY * L + k]
    gather(
        to.as_offset(L), S, measured, demand, emergency, S[at.DRIVE_DEMAND * L + k],
        to.as_offset(n_axles), to.as_offset(k), slot,
    )  # fmt: skip
    if int(S[at.TICK * L + k]) % timing.monitor_every == 0:
        period = timing.tick * timing.monitor_every
        _rotation_monitoring(monitor, memory.monitor_state[k], measured, alarm, period)
        for axle in range(n_axles):
            S[((1 + axle) * at.N_VARS + at.ALARM) * L + k] = alarm[axle]


@entry
def control(
    L: int, S: Any, memory: Any, plan: Any, moment: int, controller: Any, initial: Any
) -> None:
    """Let the compiled controllers whose turn it is measure and command."""
    timing = plan.timing
    parameters, setup = plan.controller_parameters, plan.formation.axle_setup
    monitor = plan.monitor_parameters
    n_axles = setup.shape[0]
    period = timing.tick * timing.control_every
    # all measure before the first commands: what has just been written number by number cannot yet
    # be read sixteen at a time
    for k in range(L):
        if S[at.RUN * L + k] >= 0.0 and int(S[at.TICK * L + k]) % timing.control_every == 0:
            _listen(L, S, memory, monitor, timing, n_axles, moment, k)
    for k in range(L):
        if S[at.RUN * L + k] < 0.0:
            continue
        tick = int(S[at.TICK * L + k])
        command = memory.command[k].T
        if tick % timing.control_every == 0:
            measured, state = memory.measured[k].T, memory.controller_state[k]
            if tick == 0:
                initial(parameters, setup, state, measured)
            call_step(controller, parameters, setup, state, measured, command, period)
        slot = to.VALVE_HISTORY + _kept_place(timing, moment)
        obey(to.as_offset(L), S, command, plan.n_axles, to.as_offset(k), slot)
        if plan.formation.has_shared_inverter == 1:
            share_inverters(L, S, plan.formation.inverter_of_axle, k)
        if plan.formation.has_sander == 1:
            ask_for_sand(L, S, command, n_axles, k)


@entry
def leave_behind(L: int, S: Any, memory: Any, plan: Any) -> None:
    """Sand the rail, and take the air from the reservoirs."""
    timing, way, formation = plan.timing, plan.way, plan.formation
    sand = memory.ring_sand
    n_axles = formation.vehicle_of_axle.shape[0]
    for k in range(L):
        if S[at.RUN * L + k] >= 0.0 and formation.has_sander == 1:
            lay_sand(
                L, S, sand, n_axles, way.origin, way.cell_length, timing.tick,
                timing.sand_delay, timing.sand_cut_out, k,
            )  # fmt: skip
    _take_air(L, S, memory.reservoirs, formation, n_axles, timing.tick)


@compiled
def _take_air(L: int, S: Any, reservoirs: Any, formation: Any, n_axles: int, tick: float) -> None:
    vehicles, volumes = formation.vehicle_of_axle, formation.reservoir_volume
    recharge, full = formation.reservoir_recharge, formation.reservoir_pressure
    for vehicle in range(volumes.shape[0]):
        gain = recharge[vehicle] * tick * NORMAL_PRESSURE / volumes[vehicle]
        for k in range(L):
            slot = vehicle * L + k
            reservoirs[slot] = min(reservoirs[slot] + gain, full[vehicle])
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        first = vehicles[axle] * L
        per_volume = 1.0 / volumes[vehicles[axle]]
        for k in range(L):
            rise = S[b + at.CYLINDER_PRESSURE * L + k] - S[b + at.PRESSURE_BEFORE * L + k]
            volume = max(rise, 0.0) * S[b + at.CYLINDER_VOLUME * L + k]
            S[b + at.AIR_USED * L + k] += volume / NORMAL_PRESSURE
            reservoirs[first + k] -= volume * per_volume
            S[b + at.RESERVOIR_PRESSURE * L + k] = reservoirs[first + k]


@compiled
def _look_for_stop(L: int, S: Any, tick: float, k: int) -> None:
    """Locate the stand within the coming tick: with constant deceleration, exactly.

    A train that is driven may stand: it is about to move.
    """
    if S[at.STOP_TIME * L + k] >= 0.0 or S[at.DRIVE_DEMAND * L + k] > 0.0:
        return
    speed = S[at.TRAIN_SPEED * L + k]
    deceleration = S[at.LAST_DECELERATION * L + k]
    now = S[at.TICK * L + k] * tick
    if speed <= 0.0:
        S[at.STOP_TIME * L + k] = now
        S[at.STOP_POSITION * L + k] = S[at.POSITION * L + k]
    elif speed < NEARLY_STANDING and speed <= deceleration * tick:
        S[at.STOP_TIME * L + k] = now + speed / deceleration
        way = speed * speed / (2.0 * deceleration)
        S[at.STOP_POSITION * L + k] = S[at.POSITION * L + k] + way


@compiled
def _status(L: int, S: Any, timing: Any, origin: float, end: float, k: int) -> int:
    """Return whether lane k goes on, or how it ends."""
    limit, after_stop, goes_on = timing.limit, timing.after_stop, timing.goes_on == 1
    speed = S[at.TRAIN_SPEED * L + k]
    rear = S[at.POSITION * L + k] - S[at.TRAIN_LENGTH * L + k]
    if not math.isfinite(speed) or not math.isfinite(S[at.POSITION * L + k]):
        return DIVERGED
    if S[at.CONTROLLER_ERROR * L + k] > 0.0:
        return CONTROLLER_FAILED
    if S[at.STOP_TIME * L + k] >= 0.0 and not goes_on:
        S[at.STAND_TICKS * L + k] += 1.0
        if S[at.STAND_TICKS * L + k] > after_stop:
            return STOPPED
    if S[at.DRIVE_DEMAND * L + k] > 0.0 and speed < ROLLING_BACK:
        return STALLED
    if S[at.POSITION * L + k] >= end or rear < origin:
        return END_OF_TRACK
    if S[at.TICK * L + k] >= limit:
        return COMPLETED if goes_on else TIME_LIMIT
    return RUNNING


@entry
def look_after(L: int, S: Any, memory: Any, plan: Any, out: Any, k: int) -> int:
    """Record lane k and return whether its run goes on, or how it ends."""
    timing = plan.timing
    n_axles = plan.formation.vehicle_of_axle.shape[0]
    if int(S[at.RUN * L + k]) < out.trace_train.shape[0]:
        record(L, S, memory, plan, out, n_axles, k)
    _look_for_stop(L, S, timing.tick, k)
    way = plan.way
    status = _status(L, S, timing, way.origin, way.end, k)
    if status != RUNNING:
        for axle in range(n_axles):
            b = (1 + axle) * at.N_VARS * L
            heat_rail(L, S, memory.ring_energy, 1.0 / way.cell_length, b, k)
        finish_run(L, S, plan, out, n_axles, k, status)
    return int(status)


@inlined
def _needs_attention(L: int, S: Any, limit: int, end: float, k: int) -> bool:
    """Return whether anything but going on is possible: cheap, for the many ticks in between."""
    speed = S[at.TRAIN_SPEED * L + k]
    goes_on = (
        speed > NEARLY_STANDING
        and S[at.POSITION * L + k] < end
        and S[at.TICK * L + k] < limit
        and S[at.CONTROLLER_ERROR * L + k] == 0.0
        and S[at.STOP_TIME * L + k] < 0.0
    )
    return not goes_on


@inlined
def _begin(L: int, memory: Any, plan: Any, overrides: Any, first: int, last: int) -> int:
    """Fill the lanes with runs; return the next one that waits."""
    S = memory.lanes
    for k in range(L):
        # an idle lane computes along on somebody's numbers; nobody reads them
        begin_run(L, S, memory, plan, overrides, k, min(first + k, last - 1))
        if first + k >= last:
            S[at.RUN * L + k] = -1.0
    return min(first + L, last)


@inlined
def _turn_over(
    L: int, memory: Any, plan: Any, overrides: Any, out: Any, upcoming: int, last: int
) -> int:
    """Write down the runs that have ended and begin the next; return the next that waits."""
    S = memory.lanes
    is_traced = out.trace_train.shape[0] > 0
    limit, end = plan.timing.limit, plan.way.end
    for k in range(L):
        if S[at.RUN * L + k] < 0.0 or not (is_traced or _needs_attention(L, S, limit, end, k)):
            continue
        if look_after(L, S, memory, plan, out, k) == RUNNING:
            continue
        if upcoming < last:
            begin_run(L, S, memory, plan, overrides, k, upcoming)
            upcoming += 1
            look_after(L, S, memory, plan, out, k)
        else:
            S[at.RUN * L + k] = -1.0
    return upcoming


@inlined
def _are_running(L: int, S: Any) -> bool:
    running = False
    for k in range(L):
        running = running or S[at.RUN * L + k] >= 0.0
    return running


@entry
def run_lanes(
    memory: Any, plan: Any, overrides: Any, out: Any, first: int, last: int,
    controller: Any, initial: Any, custom: Any,
) -> None:  # fmt: skip
    """Compute the runs first … last − 1, sixteen at a time."""
    S = memory.lanes
    upcoming = _begin(at.LANES, memory, plan, overrides, first, last)
    moment = 0
    while True:
        upcoming = _turn_over(at.LANES, memory, plan, overrides, out, upcoming, last)
        if not _are_running(at.LANES, S):
            return
        drive(at.LANES, S, memory, plan)
        sense_lanes(S, plan, moment)
        control(at.LANES, S, memory, plan, moment, controller, initial)
        if plan.brake_control.every > 0:
            control_brakes(at.LANES, S, memory, plan)
        advance_lanes(S, plan, custom, moment)
        leave_behind(at.LANES, S, memory, plan)
        moment += 1


@entry
def run_single(
    memory: Any, plan: Any, overrides: Any, out: Any, first: int, last: int,
    controller: Any, initial: Any, custom: Any,
) -> None:  # fmt: skip
    """Compute the runs first … last − 1, one after the other."""
    S = memory.lanes
    upcoming = _begin(1, memory, plan, overrides, first, last)
    moment = 0
    while True:
        upcoming = _turn_over(1, memory, plan, overrides, out, upcoming, last)
        if not _are_running(1, S):
            return
        drive(1, S, memory, plan)
        sense_single(S, plan, moment)
        control(1, S, memory, plan, moment, controller, initial)
        if plan.brake_control.every > 0:
            control_brakes(1, S, memory, plan)
        advance_single(S, plan, custom, moment)
        leave_behind(1, S, memory, plan)
        moment += 1


@entry
def begin_single(memory: Any, plan: Any, overrides: Any, run: int) -> None:
    """Put a run at its start, for a controller that is stepped from Python."""
    begin_run(1, memory.lanes, memory, plan, overrides, 0, run)


@entry
def before_control_single(memory: Any, plan: Any, out: Any, moment: int) -> int:
    """Begin a tick; what the controller sees is in memory.measured; return the status."""
    S = memory.lanes
    status = look_after(1, S, memory, plan, out, 0)
    if status == RUNNING:
        drive(1, S, memory, plan)
        sense_single(S, plan, moment)
        n_axles = plan.formation.vehicle_of_axle.shape[0]
        if int(S[at.TICK]) % plan.timing.control_every == 0:
            _listen(1, S, memory, plan.monitor_parameters, plan.timing, n_axles, moment, 0)
    return int(status)


@entry
def after_control_single(memory: Any, plan: Any, moment: int, custom: Any) -> None:
    """Obey the command that Python has put into memory.command, and finish the tick."""
    S = memory.lanes
    n_axles = plan.formation.vehicle_of_axle.shape[0]
    slot = to.VALVE_HISTORY + _kept_place(plan.timing, moment)
    obey(to.as_offset(1), S, memory.command[0].T, plan.n_axles, to.as_offset(0), slot)
    share_inverters(1, S, plan.formation.inverter_of_axle, 0)
    ask_for_sand(1, S, memory.command[0].T, n_axles, 0)
    if plan.brake_control.every > 0:
        control_brakes(1, S, memory, plan)
    advance_single(S, plan, custom, moment)
    leave_behind(1, S, memory, plan)
