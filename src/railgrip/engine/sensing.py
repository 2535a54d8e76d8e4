"""Toothed-wheel sensors and the delays of speeds and valves."""

from __future__ import annotations

import math
from typing import Any

import numba

from railgrip.control import contract as ctl
from railgrip.engine import layout as at

_lanes = numba.njit(forceinline=True, error_model="numpy")
_scalar = numba.njit(error_model="numpy")

SILENCE = 0.5
"""A wheel without an edge for so long counts as standing, s."""


@_lanes
def sense(L: int, S: Any, timing: Any, b: int, moment: int) -> None:
    """Measure each wheel's speed from the edges of its pole wheel, as a speed card does.

    Whole teeth over the time between the last edges seen; between edges a speed can only be
    lower than one tooth over the time since. The timer's resolution quantises the time.
    """
    for k in range(L):
        pitch = 2.0 * math.pi * S[b + at.WHEEL_RADIUS * L + k] / timing.sensor_teeth
        now = S[at.TICK * L + k] * timing.tick
        place = S[b + at.ROLLED * L + k] / pitch
        edges = math.floor(place)
        speed = max(abs(S[b + at.WHEEL_SPEED * L + k]), 1e-6)
        edge_time = now - min((place - edges) * pitch / speed, timing.tick)
        edge_time = math.floor(edge_time / timing.sensor_timer + 0.5) * timing.sensor_timer
        teeth = edges - S[b + at.PULSES * L + k]
        last_time = S[b + at.EDGE_TIME * L + k]
        believed = pitch * S[b + at.BELIEVED_RATIO * L + k]
        counted = teeth * believed / max(edge_time - last_time, timing.sensor_timer)
        waited = now - last_time
        at_most = min(S[b + at.MEASURED_SPEED * L + k], believed / max(waited, 1e-9))
        at_most = 0.0 if waited > SILENCE else at_most
        saw_edge = teeth > 0.0
        S[b + at.MEASURED_SPEED * L + k] = counted if saw_edge else at_most
        S[b + at.EDGE_TIME * L + k] = edge_time if saw_edge else last_time
        S[b + at.PULSES * L + k] = edges
        S[b + (at.SPEED_HISTORY + (moment & (at.MAX_DELAY - 1))) * L + k] = S[
            b + at.MEASURED_SPEED * L + k
        ]


@_lanes
def move_valves(L: int, S: Any, timing: Any, b: int, moment: int) -> None:
    """Let the dump valves follow their commands after their dead times."""
    wrap = at.MAX_DELAY - 1
    vent = (at.VALVE_HISTORY + ((moment - timing.vent_delay) & wrap)) * L
    fill = (at.VALVE_HISTORY + ((moment - timing.fill_delay) & wrap)) * L
    for k in range(L):
        vents = S[b + vent + k] == ctl.VENT
        fills = (S[b + fill + k] == ctl.FILL) * (not vents)
        S[b + at.VALVE_CYCLES * L + k] += vents * (S[b + at.IS_VENT * L + k] == 0.0)
        S[b + at.IS_VENT * L + k] = vents
        S[b + at.IS_FILL * L + k] = fills


@_scalar
def gather(L: int, S: Any, measured: Any, plan: Any, n_axles: int, k: int, moment: int) -> None:
    """Put what the controller of a lane sees into its table."""
    slot = at.SPEED_HISTORY + ((moment - plan.timing.sensor_delay) & (at.MAX_DELAY - 1))
    demand, emergency = driver_demand(plan.timing, int(S[at.TICK * L + k]))
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L + k
        measured[axle, ctl.WHEEL_SPEED] = S[b + slot * L]
        measured[axle, ctl.CYLINDER_PRESSURE] = S[b + at.CYLINDER_PRESSURE * L]
        measured[axle, ctl.DYNAMIC_FORCE] = S[b + at.DYNAMIC_FORCE * L]
        measured[axle, ctl.BRAKE_DEMAND] = demand
        measured[axle, ctl.EMERGENCY] = emergency


@_scalar
def driver_demand(timing: Any, tick: int) -> tuple[float, float]:
    """Return the driver's demand and whether it is an emergency brake at a tick."""
    demand = 0.0
    emergency = 0.0
    for i in range(timing.demand_tick.shape[0]):
        if tick >= timing.demand_tick[i]:
            demand = timing.demand_level[i]
            emergency = timing.demand_emergency[i]
    return demand, emergency


@_scalar
def obey(L: int, S: Any, command: Any, n_axles: int, k: int, moment: int) -> None:
    """Take a controller's command over, or note that it is none."""
    slot = at.VALVE_HISTORY + (moment & (at.MAX_DELAY - 1))
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L + k
        valve = command[axle, ctl.DUMP_VALVE]
        share = command[axle, ctl.DYNAMIC_SHARE]
        is_valve = valve == ctl.FILL or valve == ctl.HOLD or valve == ctl.VENT  # noqa: PLR1714
        if not is_valve or not (0.0 <= share <= 1.0):
            S[at.CONTROLLER_ERROR * L + k] = 1.0
        S[b + slot * L] = valve
        S[b + at.DYNAMIC_SHARE * L] = share
        if command[axle, ctl.SANDING] > 0.0:
            S[b + at.SAND_TIME * L] += 1.0
        else:
            S[b + at.SAND_TIME * L] = 0.0


@_lanes
def demand_brake(L: int, S: Any, timing: Any, b: int) -> None:
    """Let the driver's demand reach the axle after the delay of pipe and distributor."""
    for k in range(L):
        tick = S[at.TICK * L + k] - math.floor(S[b + at.DEMAND_DELAY * L + k] / timing.tick + 0.5)
        demand = 0.0
        for i in range(timing.demand_tick.shape[0]):
            demand = timing.demand_level[i] if tick >= timing.demand_tick[i] else demand
        S[b + at.DEMAND * L + k] = demand
