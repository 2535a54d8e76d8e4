"""One tick of all lanes: brake and rail, wheels and train, and the account of it.

What changes slowly (brake, rail, line) enters as it is in the middle of the tick. With the mean
speeds of the tick, force impulse × speed is exactly the work that each term took.
"""

from __future__ import annotations

import math
from typing import Any

from railgrip.brake.track_brake import TrackBrake, track_brake_force
from railgrip.compiler import inlined
from railgrip.core.formulas.elementary import power_0_8
from railgrip.engine import offsets as at
from railgrip.engine.brake_tick import brake_pass, heat_pass
from railgrip.engine.driveline import account_driveline_pass, is_driven, remember_motor_pass
from railgrip.engine.offsets import width
from railgrip.engine.rail import rail_pass

_power_0_8 = inlined(power_0_8)
_track_brake_force = inlined(track_brake_force)

SLIDING = 0.05
"""Creepage beyond which a wheel counts as sliding."""
LOCKED = 0.05
"""Share of the train speed below which a wheel counts as locked."""
ROLLING = 0.3
"""Train speed below which no wheel counts as locked, m/s."""
LOCK_SPEED = 30.0 / 3.6
"""Locks above this train speed are counted for themselves, m/s."""
LEAST_SLIP_SPEED = 3.0
"""Train speed below which no greatest slip is recorded, m/s."""
ACTIVITY_SPEED = 60.0 / 3.6
"""Slide activity is judged down to this train speed, m/s."""
LEAST_FACTOR = 0.5
"""Of brake control's force factor, where build-up is counted: a jerk limit begins at nothing."""
BUILT_UP = 0.99
"""Share of the asked force at which the brake counts as built up."""


@inlined
def begin_train(lanes: Any, S: Any, h: float) -> None:
    """Clear the tick's impulses, and work out what every axle needs of the train."""
    L = width(lanes)
    for k in range(L):
        speed = S[at.TRAIN_SPEED * L + k]
        middle = max(speed - 0.5 * h * S[at.LAST_DECELERATION * L + k], 0.0)
        S[at.HERE_SPEED * L + k] = speed
        S[at.HERE_PITCH * L + k] = S[at.PITCH_DECELERATION * L + k]
        S[at.HERE_TICK * L + k] = S[at.TICK * L + k]
        S[at.HERE_FILM * L + k] = _power_0_8(middle)
        S[at.HERE_DYNAMIC * L + k] = S[at.DYNAMIC_ALLOWED * L + k]
        S[at.HERE_POSITION * L + k] = S[at.POSITION * L + k]
        S[at.HERE_DRIVE * L + k] = S[at.DRIVE_DEMAND * L + k]
        asked = S[at.FIRST_DEMAND * L + k]
        S[at.HERE_PER_DEMAND * L + k] = 1.0 / asked if asked > 0.0 else 0.0
        S[at.SPEED_BEFORE_TICK * L + k] = speed
        S[at.POSITION_BEFORE * L + k] = S[at.POSITION * L + k]
        S[at.RESISTANCE_IMPULSE * L + k] = 0.0
        S[at.TRACK_BRAKE_IMPULSE * L + k] = 0.0
        magnet = TrackBrake(
            S[at.TRACK_BRAKE_ATTRACTION * L + k], S[at.TRACK_BRAKE_FRICTION * L + k],
            S[at.TRACK_BRAKE_FALL * L + k], S[at.TRACK_BRAKE_RELEASE * L + k],
        )  # fmt: skip
        wanted = S[at.TRACK_BRAKE_ON * L + k] * _track_brake_force(magnet, middle)
        change = S[at.TRACK_BRAKE_RATE * L + k] * h
        force = S[at.TRACK_BRAKE_FORCE * L + k]
        S[at.TRACK_BRAKE_FORCE * L + k] = max(force - change, min(force + change, wanted))


@inlined
def hand_down(lanes: Any, S: Any, b: int) -> None:
    """Take from the block in front what concerns the whole train in this tick."""
    L = width(lanes)
    front = b - at.N_VARS * L
    for i in range(at.HERE_TICK, at.HERE_MEAN):
        for k in range(L):
            S[b + i * L + k] = S[front + i * L + k]
    for k in range(L):
        speed = S[front + at.HERE_SPEED * L + k]
        pitch = S[front + at.HERE_PITCH * L + k]
        S[b + at.HERE_SPEED * L + k] = speed
        S[b + at.HERE_PITCH * L + k] = pitch
        S[b + at.HERE_PER_DEMAND * L + k] = S[front + at.HERE_PER_DEMAND * L + k]


@inlined
def _remember(lanes: Any, S: Any, b: int) -> None:
    """Keep the wheel speed of the tick's start, and clear the axle's impulses."""
    L = width(lanes)
    for k in range(L):
        S[b + at.SPEED_BEFORE * L + k] = S[b + at.WHEEL_SPEED * L + k]
        S[b + at.CONTACT_IMPULSE * L + k] = 0.0
        S[b + at.BRAKE_IMPULSE * L + k] = 0.0
    if is_driven(lanes, S, b):
        remember_motor_pass(lanes, S, b)


@inlined
def prepare_axle(
    lanes: Any, S: Any, b: int, brake: Any, demand_tick: Any, demand_level: Any,
    origin: float, per_metre: float, h: float,
) -> None:  # fmt: skip
    """Bring brake and rail of one axle to the middle of the tick."""
    brake_pass(lanes, S, b, brake, demand_tick, demand_level, h)
    rail_pass(lanes, S, b, origin, per_metre, 0.5 * h)
    _remember(lanes, S, b)


@inlined
def account(lanes: Any, S: Any, n_axles: int, h: float) -> None:
    """Sum up what the tick did, each term from its own force and speed."""
    L = width(lanes)
    for k in range(L):
        after = S[at.TRAIN_SPEED * L + k]
        mean = 0.5 * (S[at.SPEED_BEFORE_TICK * L + k] + after)
        S[at.HERE_SPEED * L + k] = after
        S[at.HERE_MEAN * L + k] = mean
        S[at.HERE_PER_SPEED * L + k] = 1.0 / max(after, LEAST_SLIP_SPEED)
        S[at.RESISTANCE_ENERGY * L + k] += S[at.RESISTANCE_IMPULSE * L + k] * mean
        S[at.GRADIENT_ENERGY * L + k] += h * S[at.GRADIENT_FORCE * L + k] * mean
        S[at.TRACK_BRAKE_ENERGY * L + k] += S[at.TRACK_BRAKE_IMPULSE * L + k] * mean
        S[at.POSITION * L + k] += h * mean
        S[at.SLOW_SO_FAR * L + k] = 0.0
    for axle in range(n_axles):
        b = (axle + at.AXLE_BLOCK) * at.N_VARS * L
        if is_driven(lanes, S, b):
            account_driveline_pass(lanes, S, b, h)
        _account_energy(lanes, S, b, h)
        _account_flash(lanes, S, b, h)
        heat_pass(lanes, S, b, h)
        _account_slide(lanes, S, b, h)
        _account_build_up(lanes, S, b, h)
    last = n_axles * at.N_VARS * L
    for k in range(L):
        time = h if S[at.TRAIN_SPEED * L + k] > ACTIVITY_SPEED else 0.0
        S[at.ACTIVE_TIME * L + k] += time
        half = 2.0 * S[last + at.SLOW_SO_FAR * L + k] >= float(n_axles)
        S[at.SLIDE_ACTIVE * L + k] += time if half else 0.0
        lost = S[at.SPEED_BEFORE_TICK * L + k] - S[at.TRAIN_SPEED * L + k]
        S[at.LAST_DECELERATION * L + k] = lost / h
        S[at.TICK * L + k] += 1.0


@inlined
def _account_energy(lanes: Any, S: Any, b: int, h: float) -> None:
    L = width(lanes)
    front = b - at.N_VARS * L
    for k in range(L):
        mean = S[front + at.HERE_MEAN * L + k]
        S[b + at.HERE_MEAN * L + k] = mean
        wheel_mean = 0.5 * (S[b + at.SPEED_BEFORE * L + k] + S[b + at.WHEEL_SPEED * L + k])
        given = S[b + at.CONTACT_IMPULSE * L + k] * (wheel_mean - mean)
        S[b + at.ROLLED * L + k] += h * abs(wheel_mean)
        S[b + at.SLID_DISTANCE * L + k] += h * abs(wheel_mean - mean)
        S[b + at.PENDING_ENERGY * L + k] += given
        S[b + at.SLID_ENERGY * L + k] += given
        S[b + at.BRAKE_ENERGY * L + k] += S[b + at.BRAKE_IMPULSE * L + k] * wheel_mean
        motor = h * S[b + at.DYNAMIC_ACTING * L + k]
        motor_mean = wheel_mean + S[b + at.MOTOR_LEAD * L + k]
        S[b + at.DYNAMIC_ENERGY * L + k] += max(motor, 0.0) * motor_mean
        S[b + at.TRACTION_ENERGY * L + k] -= min(motor, 0.0) * motor_mean


@inlined
def _account_flash(lanes: Any, S: Any, b: int, h: float) -> None:
    """Note how hot the contact gets: both wheels share the work of their axle."""
    L = width(lanes)
    front = b - at.N_VARS * L
    half_per_tick = 0.5 / h
    for k in range(L):
        mean = S[front + at.HERE_MEAN * L + k]
        wheel_mean = 0.5 * (S[b + at.SPEED_BEFORE * L + k] + S[b + at.WHEEL_SPEED * L + k])
        power = abs(S[b + at.CONTACT_IMPULSE * L + k] * (wheel_mean - mean)) * half_per_tick
        still = S[b + at.FLASH_STILL * L + k]
        pitch = S[b + at.HERE_PITCH * L + k]
        moving = S[b + at.FLASH_MOVING * L + k] + S[b + at.FLASH_TRANSFER * L + k] * pitch
        moving = max(moving, 0.0)
        wheel = math.sqrt(still + moving * abs(wheel_mean))
        rail = math.sqrt(still + moving * abs(mean))
        rise = power / (wheel + rail)
        S[b + at.FLASH_RISE * L + k] = rise
        S[b + at.GREATEST_FLASH * L + k] = max(S[b + at.GREATEST_FLASH * L + k], rise)


@inlined
def _account_slide(lanes: Any, S: Any, b: int, h: float) -> None:
    L = width(lanes)
    front = b - at.N_VARS * L
    for k in range(L):
        train_speed = S[front + at.HERE_SPEED * L + k]
        S[b + at.HERE_SPEED * L + k] = train_speed
        wheel_speed = S[b + at.WHEEL_SPEED * L + k]
        slow = 1.0 if wheel_speed < 0.9 * train_speed else 0.0
        S[b + at.SLOW_SO_FAR * L + k] = S[front + at.SLOW_SO_FAR * L + k] + slow
        is_locked = wheel_speed < LOCKED * train_speed and train_speed > ROLLING
        lock_now = S[b + at.LOCK_NOW * L + k] + h if is_locked else 0.0
        S[b + at.LOCK_NOW * L + k] = lock_now
        S[b + at.LOCKED_TIME * L + k] += h if is_locked else 0.0
        S[b + at.LONGEST_LOCK * L + k] = max(S[b + at.LONGEST_LOCK * L + k], lock_now)
        fast_lock = lock_now if train_speed > LOCK_SPEED else 0.0
        longest = S[b + at.LONGEST_FAST_LOCK * L + k]
        S[b + at.LONGEST_FAST_LOCK * L + k] = max(longest, fast_lock)
        ground = S[b + at.CONTACT_IMPULSE * L + k] * (wheel_speed - train_speed)
        S[b + at.LOCKED_SLIDE * L + k] += ground if is_locked else 0.0
        per_speed = S[front + at.HERE_PER_SPEED * L + k]
        S[b + at.HERE_PER_SPEED * L + k] = per_speed
        slip = (train_speed - wheel_speed) * per_speed
        slip = slip if train_speed > LEAST_SLIP_SPEED else 0.0
        S[b + at.GREATEST_SLIP * L + k] = max(S[b + at.GREATEST_SLIP * L + k], slip)
        S[b + at.SLIDE_TIME * L + k] += h if slip > SLIDING else 0.0
        spin = (wheel_speed - train_speed) / max(wheel_speed, LEAST_SLIP_SPEED)
        spin = spin if wheel_speed > LEAST_SLIP_SPEED else 0.0
        S[b + at.GREATEST_SPIN * L + k] = max(S[b + at.GREATEST_SPIN * L + k], spin)
        S[b + at.SPIN_TIME * L + k] += h if spin > SLIDING else 0.0
        S[b + at.GREATEST_TEMPERATURE * L + k] = max(
            S[b + at.GREATEST_TEMPERATURE * L + k], S[b + at.RING_TEMPERATURE * L + k]
        )


@inlined
def _account_build_up(lanes: Any, S: Any, b: int, h: float) -> None:
    """Count the force that is still missing after the first command, as time at full force."""
    L = width(lanes)
    for k in range(L):
        # over what brake control asks for now: friction that needs less pressure is built up too
        pressure = S[b + at.SUPPLY_PRESSURE * L + k] * S[b + at.PER_FULL_PRESSURE * L + k]
        offered = (
            pressure / S[b + at.PRESSURE_FACTOR * L + k]
            + max(S[b + at.DYNAMIC_FORCE * L + k], 0.0) * S[b + at.PER_FULL_FORCE * L + k]
        )
        per_demand = S[b + at.HERE_PER_DEMAND * L + k]
        asked = max(S[b + at.FORCE_FACTOR * L + k], LEAST_FACTOR)
        share = min(offered * per_demand / asked, 1.0)
        is_built = S[b + at.IS_BUILT_UP * L + k] > 0.0 or share >= BUILT_UP
        S[b + at.IS_BUILT_UP * L + k] = 1.0 if is_built else 0.0
        missing = h * (1.0 - share)
        S[b + at.BUILD_UP_TIME * L + k] += missing if per_demand > 0.0 and not is_built else 0.0
