"""One tick of all lanes: save, a whole step, two half steps, extrapolate, account.

Richardson's extrapolation of the linearly implicit Euler step (2 × two halves − one whole) is of
second order at the tick. It is linear in the states, so momentum and energy stay exact:
with the mean speeds of the tick, force impulse × speed is exactly the work that each term took.
"""

from __future__ import annotations

from typing import Any

import numba

from railgrip.engine import layout as at
from railgrip.engine.rail import interpolate_rail
from railgrip.engine.sensing import demand_brake, move_valves, sense
from railgrip.engine.step import plant_step

_lanes = numba.njit(forceinline=True, error_model="numpy")

SLIDING = 0.05
"""Creepage beyond which a wheel counts as sliding."""
LOCKED = 0.05
"""Share of the train speed below which a wheel counts as locked."""
LEAST_SLIP_SPEED = 3.0
"""Train speed below which no greatest slip is recorded, m/s."""
ACTIVITY_SPEED = 60.0 / 3.6
"""Slide activity is judged down to this train speed, m/s."""
BUILT_UP = 0.99
"""Share of the asked force at which the brake counts as built up."""


@_lanes
def _copy(L: int, S: Any, n_axles: int, source: int, target: int) -> None:
    for i in range(at.N_TRAIN_STATES * L):
        S[target * L + i] = S[source * L + i]
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        for i in range(at.N_STATES * L):
            S[b + target * L + i] = S[b + source * L + i]


@_lanes
def _extrapolate(L: int, S: Any, n_axles: int) -> None:
    for i in range(at.N_TRAIN_STATES * L):
        S[i] = 2.0 * S[i] - S[at.FULL_STEP * L + i]
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        for i in range(at.N_STATES * L):
            S[b + i] = 2.0 * S[b + i] - S[b + at.FULL_STEP * L + i]
        for k in range(L):
            S[b + at.CYLINDER_PRESSURE * L + k] = max(S[b + at.CYLINDER_PRESSURE * L + k], 0.0)
            S[b + at.CLAMP_FORCE * L + k] = max(S[b + at.CLAMP_FORCE * L + k], 0.0)


@_lanes
def _clear_impulses(L: int, S: Any, n_axles: int) -> None:
    for i in range(at.RESISTANCE_IMPULSE * L, (at.TRACK_BRAKE_IMPULSE + 1) * L):
        S[i] = 0.0
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        for i in range(at.CONTACT_IMPULSE * L, (at.DYNAMIC_IMPULSE + 1) * L):
            S[b + i] = 0.0
        for k in range(L):
            S[b + at.SPEED_BEFORE * L + k] = S[b + at.WHEEL_SPEED * L + k]
            S[b + at.PRESSURE_BEFORE * L + k] = S[b + at.CYLINDER_PRESSURE * L + k]


@_lanes
def prepare_tick(L: int, S: Any, plan: Any, n_axles: int, moment: int) -> None:
    """Measure, move the valves, bring the demand and the rail to every axle."""
    tick = plan.timing.tick
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        interpolate_rail(L, S, plan.way, b, tick)
        demand_brake(L, S, plan.timing, b)
        move_valves(L, S, plan.timing, b, moment)


@_lanes
def sense_all(L: int, S: Any, plan: Any, n_axles: int, moment: int) -> None:
    """Let every speed sensor measure."""
    for axle in range(n_axles):
        sense(L, S, plan.timing, (1 + axle) * at.N_VARS * L, moment)


@_lanes
def advance_plant(L: int, S: Any, plan: Any, n_axles: int, custom: Any, step: Any) -> None:
    """Advance every lane by one tick, to second order."""
    h = plan.timing.tick
    brakes = plan.formation.brakes
    law = plan.creep_law
    for k in range(L):
        S[at.SPEED_BEFORE_TICK * L + k] = S[at.TRAIN_SPEED * L + k]
    _clear_impulses(L, S, n_axles)
    _copy(L, S, n_axles, 0, at.SAVED)
    step(S, n_axles, brakes, law, custom, h, 1.0)
    _copy(L, S, n_axles, 0, at.FULL_STEP)
    _copy(L, S, n_axles, at.SAVED, 0)
    step(S, n_axles, brakes, law, custom, 0.5 * h, 0.5)
    step(S, n_axles, brakes, law, custom, 0.5 * h, 1.0)
    _extrapolate(L, S, n_axles)


@_lanes
def account(L: int, S: Any, plan: Any, n_axles: int) -> None:
    """Sum up what the tick did, each term from its own force and speed."""
    h = plan.timing.tick
    for k in range(L):
        mean = 0.5 * (S[at.SPEED_BEFORE_TICK * L + k] + S[at.TRAIN_SPEED * L + k])
        S[at.RESISTANCE_ENERGY * L + k] += S[at.RESISTANCE_IMPULSE * L + k] * mean
        S[at.GRADIENT_ENERGY * L + k] += S[at.GRADIENT_IMPULSE * L + k] * mean
        S[at.TRACK_BRAKE_ENERGY * L + k] += S[at.TRACK_BRAKE_IMPULSE * L + k] * mean
        S[at.POSITION * L + k] += h * mean
        S[at.SLOW_AXLES * L + k] = 0.0
    for axle in range(n_axles):
        _account_axle(L, S, (1 + axle) * at.N_VARS * L, h)
    for k in range(L):
        is_fast = S[at.TRAIN_SPEED * L + k] > ACTIVITY_SPEED
        S[at.ACTIVE_TIME * L + k] += h * is_fast
        S[at.SLIDE_ACTIVE * L + k] += h * is_fast * (
            2.0 * S[at.SLOW_AXLES * L + k] >= n_axles
        )
        S[at.LAST_DECELERATION * L + k] = (
            S[at.SPEED_BEFORE_TICK * L + k] - S[at.TRAIN_SPEED * L + k]
        ) / h
        S[at.TICK * L + k] += 1.0


@_lanes
def _account_axle(L: int, S: Any, b: int, h: float) -> None:
    for k in range(L):
        train_speed = S[at.TRAIN_SPEED * L + k]
        mean = 0.5 * (S[at.SPEED_BEFORE_TICK * L + k] + train_speed)
        wheel_speed = S[b + at.WHEEL_SPEED * L + k]
        wheel_mean = 0.5 * (S[b + at.SPEED_BEFORE * L + k] + wheel_speed)
        S[b + at.ROLLED * L + k] += h * abs(wheel_mean)
        slid = h * abs(wheel_mean - mean)
        S[b + at.SLID_DISTANCE * L + k] += slid
        S[b + at.SLID_NOW * L + k] = S[b + at.CONTACT_IMPULSE * L + k] * (wheel_mean - mean)
        S[b + at.SLID_ENERGY * L + k] += S[b + at.SLID_NOW * L + k]
        S[b + at.BRAKE_ENERGY * L + k] += S[b + at.BRAKE_IMPULSE * L + k] * wheel_mean
        S[b + at.DYNAMIC_ENERGY * L + k] += S[b + at.DYNAMIC_IMPULSE * L + k] * wheel_mean
        is_rolling = train_speed > 0.3
        is_locked = (wheel_speed < LOCKED * train_speed) * is_rolling
        S[b + at.LOCKED_TIME * L + k] += h * is_locked
        S[b + at.LOCK_NOW * L + k] = (S[b + at.LOCK_NOW * L + k] + h) * is_locked
        S[b + at.LONGEST_LOCK * L + k] = max(
            S[b + at.LONGEST_LOCK * L + k], S[b + at.LOCK_NOW * L + k]
        )
        S[b + at.LOCKED_SLIDE * L + k] += S[b + at.SLID_NOW * L + k] * is_locked
        slip = (train_speed - wheel_speed) / max(train_speed, LEAST_SLIP_SPEED)
        slip = slip * (train_speed > LEAST_SLIP_SPEED)
        S[b + at.GREATEST_SLIP * L + k] = max(S[b + at.GREATEST_SLIP * L + k], slip)
        S[b + at.SLIDE_TIME * L + k] += h * (slip > SLIDING)
        S[at.SLOW_AXLES * L + k] += wheel_speed < 0.9 * train_speed
        S[b + at.GREATEST_TEMPERATURE * L + k] = max(
            S[b + at.GREATEST_TEMPERATURE * L + k], S[b + at.RING_TEMPERATURE * L + k]
        )
        _account_build_up(L, S, b, k, h)


@_lanes
def _account_build_up(L: int, S: Any, b: int, k: int, h: float) -> None:
    """Count the force that is still missing after the first command, as time at full force."""
    full = max(S[b + at.FULL_FORCE * L + k], 1.0)
    offered = (
        S[b + at.SUPPLY_PRESSURE * L + k] / S[b + at.FULL_PRESSURE * L + k]
        + S[b + at.DYNAMIC_FORCE * L + k] / full
    )
    asked = S[at.FIRST_DEMAND * L + k]
    share = min(offered / max(asked, 1e-6), 1.0)
    is_asked = asked > 0.0
    built = (S[b + at.IS_BUILT_UP * L + k] + is_asked * (share >= BUILT_UP)) > 0.0
    S[b + at.IS_BUILT_UP * L + k] = built
    S[b + at.BUILD_UP_TIME * L + k] += h * (1.0 - share) * is_asked * (1.0 - built)
