"""Toothed-wheel sensors, the delays of speeds and valves, and what passes to controllers."""

from __future__ import annotations

import math
from typing import Any

from railgrip.compiler import compiled, inlined
from railgrip.control import contract as ctl
from railgrip.engine import layout as at
from railgrip.engine import offsets as to
from railgrip.engine.offsets import width

SILENCE = 0.5
"""A wheel without an edge for so long counts as standing, s."""


@inlined
def sense_pass(
    lanes: Any, S: Any, b: int, tick: float, teeth: float, per_timer: float, every: float, slot: int
) -> None:
    """Measure each wheel's speed from the edges of its pole wheel, as a speed card does.

    Whole teeth over the time between the last edges seen; between edges a speed can only be
    lower than one tooth over the time since. The timer's resolution quantises the time. The card
    looks once a control period: what it sees must not depend on the step of the computation.
    """
    L = width(lanes)
    per_tooth = 2.0 * math.pi / teeth
    timer = 1.0 / per_timer
    for k in range(L):
        pitch = per_tooth * S[b + to.WHEEL_RADIUS * L + k]
        now = S[b + to.HERE_TICK * L + k] * tick
        place = S[b + to.ROLLED * L + k] / pitch
        edges = math.floor(place)
        speed = max(abs(S[b + to.WHEEL_SPEED * L + k]), 1e-6)
        looks = (
            math.floor(S[b + to.HERE_TICK * L + k] / every) * every == S[b + to.HERE_TICK * L + k]
        )
        edge_time = now - min((place - edges) * pitch / speed, tick * every)
        edge_time = math.floor(edge_time * per_timer + 0.5) * timer
        seen = edges - S[b + to.PULSES * L + k]
        last_time = S[b + to.EDGE_TIME * L + k]
        waited = now - last_time
        counted = max(seen, 1.0) * pitch * S[b + to.BELIEVED_RATIO * L + k]
        over = edge_time - last_time if seen > 0.0 else waited
        counted = counted / max(over, timer)
        at_most = min(S[b + to.MEASURED_SPEED * L + k], counted)
        at_most = 0.0 if waited > SILENCE else at_most
        measured = counted if seen > 0.0 else at_most
        measured = measured if looks else S[b + to.MEASURED_SPEED * L + k]
        S[b + to.EDGE_TIME * L + k] = edge_time if looks and seen > 0.0 else last_time
        S[b + to.MEASURED_SPEED * L + k] = measured
        S[b + to.PULSES * L + k] = edges if looks else S[b + to.PULSES * L + k]
        S[b + slot * L + k] = measured


@inlined
def valve_pass(lanes: Any, S: Any, b: int, vent_slot: int, fill_slot: int) -> None:
    """Let the dump valves follow the commands of their dead times ago."""
    L = width(lanes)
    for k in range(L):
        vents = 1.0 if S[b + vent_slot * L + k] == ctl.VENT else 0.0
        fills = 1.0 - vents if S[b + fill_slot * L + k] == ctl.FILL else 0.0
        was_venting = S[b + to.IS_VENT * L + k]
        S[b + to.VALVE_CYCLES * L + k] += vents * (1.0 - was_venting)
        S[b + to.IS_VENT * L + k] = vents
        S[b + to.IS_FILL * L + k] = fills


@compiled
def gather(
    L: int, S: Any, measured: Any, demand: float, emergency: float, drive: float, n_axles: int,
    k: int, slot: int,
) -> None:  # fmt: skip
    """Put what the controller of a lane sees into its table."""
    for axle in range(n_axles):
        b = (axle + to.AXLE_BLOCK) * to.N_VARS * L + k
        measured[axle, ctl.WHEEL_SPEED] = S[b + slot * L]
        measured[axle, ctl.CYLINDER_PRESSURE] = S[b + to.CYLINDER_PRESSURE * L]
        measured[axle, ctl.DYNAMIC_FORCE] = S[b + to.DYNAMIC_FORCE * L]
        measured[axle, ctl.BRAKE_DEMAND] = demand
        measured[axle, ctl.EMERGENCY] = emergency
        measured[axle, ctl.DRIVE_DEMAND] = drive


@compiled
def driver_demand(
    tick: int, demand_tick: Any, demand_level: Any, demand_emergency: Any
) -> tuple[float, float]:
    """Return the driver's demand and whether it is an emergency brake at a tick."""
    demand = 0.0
    emergency = 0.0
    for i in range(demand_tick.shape[0]):
        if tick >= demand_tick[i]:
            demand = demand_level[i]
            emergency = demand_emergency[i]
    return demand, emergency


@compiled
def drive_demand(tick: int, drive_tick: Any, drive_level: Any) -> float:
    """Return what the driver asks of the motors at a tick."""
    demand = 0.0
    for i in range(drive_tick.shape[0]):
        if tick >= drive_tick[i]:
            demand = drive_level[i]
    return float(demand)


@compiled
def note_brake_command(L: int, S: Any, timing: Any, k: int) -> None:
    """Keep where and how fast the train was at the first brake command."""
    tick = int(S[at.TICK * L + k])
    if S[at.BRAKE_TIME * L + k] >= 0.0 or tick < timing.first_brake_tick:
        return
    S[at.BRAKE_TIME * L + k] = tick * timing.tick
    S[at.BRAKE_POSITION * L + k] = S[at.POSITION * L + k]
    S[at.BRAKE_SPEED * L + k] = S[at.TRAIN_SPEED * L + k]
    S[at.FIRST_DEMAND * L + k], _ = driver_demand(
        tick, timing.demand_tick, timing.demand_level, timing.demand_emergency
    )


@compiled
def obey(L: int, S: Any, command: Any, n_axles: int, k: int, slot: int) -> None:
    """Take a controller's command over, or note that it is none."""
    wrong = 0.0
    for axle in range(n_axles):
        b = (axle + to.AXLE_BLOCK) * to.N_VARS * L + k
        valve = command[axle, ctl.DUMP_VALVE]
        share = command[axle, ctl.DYNAMIC_SHARE]
        # a valve that is none of the three leaves a remainder; NaN is unequal to itself
        odd = valve * (valve - ctl.HOLD) * (valve - ctl.VENT)
        friction = command[axle, ctl.FRICTION_SHARE]
        wrong += abs(odd) + abs(min(max(share, 0.0), 1.0) - share)
        wrong += abs(min(max(friction, 0.0), 1.0) - friction)
        S[b + slot * L] = valve
        S[b + to.DYNAMIC_SHARE * L] = share
        # what is no share releases the brake until the run is ended for it
        S[b + to.FRICTION_SHARE * L] = friction if 0.0 <= friction <= 1.0 else 0.0
    if wrong != 0.0:
        S[to.CONTROLLER_ERROR * L + k] = 1.0


@compiled
def share_inverters(L: int, S: Any, inverter_of_axle: Any, k: int) -> None:
    """Let motors on one inverter obey the smallest share commanded to any of them."""
    own = at.DYNAMIC_SHARE * L + k
    block = at.N_VARS * L
    for axle in range(inverter_of_axle.shape[0]):
        first = (1 + inverter_of_axle[axle]) * block + own
        S[first] = min(S[first], S[(1 + axle) * block + own])
    for axle in range(inverter_of_axle.shape[0]):
        S[(1 + axle) * block + own] = S[(1 + inverter_of_axle[axle]) * block + own]


@compiled
def ask_for_sand(L: int, S: Any, command: Any, n_axles: int, k: int) -> None:
    """Count the ticks for which each axle has been asking for sand."""
    for axle in range(n_axles):
        slot = ((1 + axle) * at.N_VARS + at.SAND_TIME) * L + k
        S[slot] = S[slot] + 1.0 if command[axle, ctl.SANDING] > 0.0 else 0.0
