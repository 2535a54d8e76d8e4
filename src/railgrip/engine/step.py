"""One step of wheels and train over all lanes: linearly implicit Euler, momentum exact.

Equations (driving positive; per axle: wheel speed w at the tread, contact force T; train speed v)::

    m_r dw/dt = -T - B sgn(w) - F_D              m_r rotating mass, B friction brake, F_D dynamic
    M   dv/dt = sum T - R sgn(v) - G             M static mass, R resistance, G gradient
    sigma dT/dt + |v| T = C (w - v)              relaxation form, C = T_ss(s)/s chord of the law

T is solved together with w and v (an arrow-shaped linear system: one pass down the train, one
back), so the step is stable at any length and never divides by v. B and R are dry friction:
they bring a speed to zero and hold it there, never beyond. The very T that moves the wheel moves
the train.

Each pass is a loop over lanes that LLVM turns into packed arithmetic; choices (which law) are
taken outside it. A pass touches its axle's block and the block in front of it, at fixed distances,
so that LLVM sees that nothing overlaps: what concerns the whole train (its speed, sums of forces)
is handed from block to block down the train.
"""

from __future__ import annotations

import math
from typing import Any

from railgrip.compiler import inlined
from railgrip.engine import offsets as at
from railgrip.engine.contact_pass import contact_pass
from railgrip.engine.driveline import (
    extrapolate_driveline_pass,
    is_driven,
    load_half_pass,
    load_whole_pass,
    swing_half_pass,
    swing_whole_pass,
)
from railgrip.engine.offsets import width


@inlined
def _condense(
    L: int, S: Any, b: int, k: int, mass: float, acting: float, per_step: float
) -> tuple[float, float, float, float, float, float]:
    """Eliminate the wheel: what is left of it is a force and a stiffness against train speed.

    Its mass is over the step; of motor and shaft it holds what turns with the wheel.

    Returns these two, then what the wheel needs to be found again: carried force, stiffness of
    the contact, forced momentum rate, and one over inertia and stiffness.
    """
    train_speed = S[b + at.HERE_SPEED * L + k]
    wheel_speed = S[b + at.WHEEL_SPEED * L + k]
    limit = S[b + at.BRAKE_LIMIT * L + k]
    sigma = S[b + at.RELAXATION_LENGTH * L + k] * per_step
    damping = 1.0 / (sigma + S[b + at.ROLLING * L + k])
    carried = sigma * S[b + at.CONTACT_FORCE * L + k] * damping
    stiffness = S[b + at.CHORD * L + k] * damping
    forced = mass * wheel_speed - acting
    brake = math.copysign(limit, wheel_speed) if wheel_speed != 0.0 else 0.0
    share = 1.0 / (mass + stiffness)
    free = (forced - carried - brake) * share
    # a wheel that this brake locks contributes as a locked wheel
    turns = (free + stiffness * share * train_speed) * wheel_speed
    rotates = 0.0 if (turns <= 0.0 and limit > 0.0) else 1.0
    force = carried + stiffness * free * rotates
    against = stiffness * (1.0 - stiffness * share * rotates)
    return force, against, carried, stiffness, forced, share


@inlined
def _condense_whole_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    L = width(lanes)
    front = b - at.N_VARS * L
    per_step = 1.0 / h
    for k in range(L):
        mass = S[b + at.WHOLE_TURNED_MASS * L + k] * per_step
        acting = S[b + at.WHOLE_TURNING_FORCE * L + k]
        force, against, carried, stiffness, forced, share = _condense(
            L, S, b, k, mass, acting, per_step
        )
        S[b + at.WHOLE_FORCE_SO_FAR * L + k] = S[front + at.WHOLE_FORCE_SO_FAR * L + k] + force
        S[b + at.WHOLE_STIFFNESS_SO_FAR * L + k] = (
            S[front + at.WHOLE_STIFFNESS_SO_FAR * L + k] + against
        )
        S[b + at.WHOLE_CARRIED * L + k] = carried
        S[b + at.WHOLE_STIFFNESS * L + k] = stiffness
        S[b + at.WHOLE_FORCED * L + k] = forced
        S[b + at.WHOLE_SHARE * L + k] = share


@inlined
def _condense_half_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    L = width(lanes)
    front = b - at.N_VARS * L
    per_step = 1.0 / h
    for k in range(L):
        mass = S[b + at.TURNED_MASS * L + k] * per_step
        acting = S[b + at.TURNING_FORCE * L + k]
        force, against, carried, stiffness, forced, share = _condense(
            L, S, b, k, mass, acting, per_step
        )
        S[b + at.FORCE_SO_FAR * L + k] = S[front + at.FORCE_SO_FAR * L + k] + force
        S[b + at.STIFFNESS_SO_FAR * L + k] = S[front + at.STIFFNESS_SO_FAR * L + k] + against
        S[b + at.CARRIED * L + k] = carried
        S[b + at.STIFFNESS * L + k] = stiffness
        S[b + at.FORCED * L + k] = forced
        S[b + at.SHARE * L + k] = share


@inlined
def _wheel(
    mass: float, limit: float, brake: float, train_speed: float, h: float,
    carried: float, stiffness: float, forced: float, share: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Return wheel speed, contact force and brake impulse of one axle after a step."""
    free = forced - carried + stiffness * train_speed
    speed = math.copysign(max(abs(free) - brake, 0.0) * share, free)
    contact = carried + stiffness * (speed - train_speed)
    bounded = min(max(contact, -limit), limit)
    # at its limit the contact force no longer depends on the speeds
    free = forced - bounded
    slipping = math.copysign(max(abs(free) - brake, 0.0) / mass, free)
    speed = slipping if contact != bounded else speed
    # a turning wheel feels the whole brake; one that it holds, only what holds it
    acting = math.copysign(brake, speed) if speed != 0.0 else free
    return speed, bounded, h * acting


@inlined
def _whole_wheel_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """The wheel after the whole step: kept aside."""
    L = width(lanes)
    front = b - at.N_VARS * L
    per_step = 1.0 / h
    for k in range(L):
        train_speed = S[front + at.WHOLE_PREDICTED * L + k]
        S[b + at.WHOLE_PREDICTED * L + k] = train_speed
        speed, contact, brake_impulse = _wheel(
            S[b + at.WHOLE_TURNED_MASS * L + k] * per_step,
            S[b + at.FRICTION_LIMIT * L + k],
            S[b + at.BRAKE_LIMIT * L + k],
            train_speed,
            h,
            S[b + at.WHOLE_CARRIED * L + k],
            S[b + at.WHOLE_STIFFNESS * L + k],
            S[b + at.WHOLE_FORCED * L + k],
            S[b + at.WHOLE_SHARE * L + k],
        )
        S[b + at.WHOLE_FORCE_SO_FAR * L + k] = S[front + at.WHOLE_FORCE_SO_FAR * L + k] + contact
        S[b + (at.WHOLE_STEP + at.WHEEL_SPEED) * L + k] = speed
        S[b + (at.WHOLE_STEP + at.CONTACT_FORCE) * L + k] = contact
        S[b + (at.WHOLE_STEP + at.CONTACT_IMPULSE) * L + k] = h * contact
        S[b + (at.WHOLE_STEP + at.BRAKE_IMPULSE) * L + k] = brake_impulse


@inlined
def _half_wheel_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """The wheel after a half step."""
    L = width(lanes)
    front = b - at.N_VARS * L
    per_step = 1.0 / h
    for k in range(L):
        train_speed = S[front + at.HERE_PREDICTED * L + k]
        S[b + at.HERE_PREDICTED * L + k] = train_speed
        speed, contact, brake_impulse = _wheel(
            S[b + at.TURNED_MASS * L + k] * per_step,
            S[b + at.FRICTION_LIMIT * L + k],
            S[b + at.BRAKE_LIMIT * L + k],
            train_speed,
            h,
            S[b + at.CARRIED * L + k],
            S[b + at.STIFFNESS * L + k],
            S[b + at.FORCED * L + k],
            S[b + at.SHARE * L + k],
        )
        S[b + at.FORCE_SO_FAR * L + k] = S[front + at.FORCE_SO_FAR * L + k] + contact
        S[b + at.WHEEL_SPEED * L + k] = speed
        S[b + at.CONTACT_FORCE * L + k] = contact
        S[b + at.CONTACT_IMPULSE * L + k] += h * contact
        S[b + at.BRAKE_IMPULSE * L + k] += brake_impulse


@inlined
def _extrapolate_pass(lanes: Any, S: Any, b: int) -> None:
    """Richardson: twice the two halves less the whole."""
    for i in range(at.N_STATES * width(lanes)):
        S[b + i] = 2.0 * S[b + i] - S[b + at.WHOLE_STEP * width(lanes) + i]


@inlined
def _head_pass(lanes: Any, S: Any) -> None:
    """Begin the hand-down in the train's block."""
    L = width(lanes)
    for k in range(L):
        S[at.HERE_SPEED * L + k] = S[at.TRAIN_SPEED * L + k]
        S[at.HERE_PITCH * L + k] = S[at.PITCH_DECELERATION * L + k]
        S[at.FORCE_SO_FAR * L + k] = 0.0
        S[at.STIFFNESS_SO_FAR * L + k] = 0.0
        S[at.WHOLE_FORCE_SO_FAR * L + k] = 0.0
        S[at.WHOLE_STIFFNESS_SO_FAR * L + k] = 0.0


@inlined
def _resistance(L: int, S: Any, k: int) -> float:
    speed = abs(S[at.TRAIN_SPEED * L + k])
    resistance: float = (
        S[at.RESISTANCE_CONSTANT * L + k]
        + S[at.CURVE_FORCE * L + k]
        + speed * (S[at.RESISTANCE_LINEAR * L + k] + speed * S[at.RESISTANCE_QUADRATIC * L + k])
    )
    return resistance


@inlined
def _speed_after(L: int, S: Any, k: int, force: float, stiffness: float, h: float) -> float:
    """Return v after the step under ``force - stiffness v``: dry friction never reverses it."""
    mass = S[at.TRAIN_MASS * L + k] * (1.0 / h)
    free = mass * S[at.TRAIN_SPEED * L + k] + force - S[at.GRADIENT_FORCE * L + k]
    held = _resistance(L, S, k) + S[at.TRACK_BRAKE_FORCE * L + k]
    return math.copysign(max(abs(free) - held, 0.0) / (mass + stiffness), free)


@inlined
def _predict_whole_pass(lanes: Any, S: Any, last: int, h: float) -> None:
    """Solve the arrow for v; the axles need it before their forces are final."""
    L = width(lanes)
    for k in range(L):
        force = S[last + at.WHOLE_FORCE_SO_FAR * L + k]
        stiffness = S[last + at.WHOLE_STIFFNESS_SO_FAR * L + k]
        S[at.WHOLE_PREDICTED * L + k] = _speed_after(L, S, k, force, stiffness, h)
        S[at.WHOLE_FORCE_SO_FAR * L + k] = 0.0


@inlined
def _predict_half_pass(lanes: Any, S: Any, last: int, h: float) -> None:
    L = width(lanes)
    for k in range(L):
        force = S[last + at.FORCE_SO_FAR * L + k]
        stiffness = S[last + at.STIFFNESS_SO_FAR * L + k]
        S[at.HERE_PREDICTED * L + k] = _speed_after(L, S, k, force, stiffness, h)
        S[at.FORCE_SO_FAR * L + k] = 0.0


@inlined
def _train(L: int, S: Any, k: int, force: float, h: float) -> tuple[float, float, float, float]:
    """Return train speed, pitching, and what resistance and track brake took, after a step."""
    start = S[at.TRAIN_SPEED * L + k]
    speed = _speed_after(L, S, k, force, 0.0, h)
    resistance = _resistance(L, S, k)
    track_brake = S[at.TRACK_BRAKE_FORCE * L + k]
    # a train that moves feels all of both; one that they hold, only what holds it
    pull = force - S[at.GRADIENT_FORCE * L + k] + S[at.TRAIN_MASS * L + k] * start / h
    needed = pull / max(resistance + track_brake, 1e-9)
    share = math.copysign(1.0, speed) if speed != 0.0 else needed
    lag = S[at.PITCH_TIME * L + k]
    pitch = (lag * S[at.PITCH_DECELERATION * L + k] + (start - speed)) / (lag + h)
    return speed, pitch, h * share * resistance, h * share * track_brake


@inlined
def _whole_train_pass(lanes: Any, S: Any, last: int, h: float) -> None:
    L = width(lanes)
    for k in range(L):
        force = S[last + at.WHOLE_FORCE_SO_FAR * L + k]
        speed, pitch, resistance, track_brake = _train(L, S, k, force, h)
        S[(at.WHOLE_STEP + at.TRAIN_SPEED) * L + k] = speed
        S[(at.WHOLE_STEP + at.PITCH_DECELERATION) * L + k] = pitch
        S[(at.WHOLE_STEP + at.RESISTANCE_IMPULSE) * L + k] = resistance
        S[(at.WHOLE_STEP + at.TRACK_BRAKE_IMPULSE) * L + k] = track_brake


@inlined
def _half_train_pass(lanes: Any, S: Any, last: int, h: float) -> None:
    L = width(lanes)
    for k in range(L):
        force = S[last + at.FORCE_SO_FAR * L + k]
        speed, pitch, resistance, track_brake = _train(L, S, k, force, h)
        S[at.TRAIN_SPEED * L + k] = speed
        S[at.PITCH_DECELERATION * L + k] = pitch
        S[at.RESISTANCE_IMPULSE * L + k] += resistance
        S[at.TRACK_BRAKE_IMPULSE * L + k] += track_brake


@inlined
def _whole_and_first_half(
    lanes: Any, S: Any, n_axles: int, creep_law: int, tables: Any, custom: Any, h: float
) -> None:
    """Step by h, kept aside, and by h/2: both begin at one state, so they share the contact."""
    block = at.N_VARS * width(lanes)
    last = n_axles * block
    _head_pass(lanes, S)
    for axle in range(n_axles):
        b = (axle + at.AXLE_BLOCK) * block
        contact_pass(lanes, S, axle, creep_law, tables, custom)
        if is_driven(lanes, S, b):
            load_whole_pass(lanes, S, b, h)
            load_half_pass(lanes, S, b, 0.5 * h)
        _condense_whole_pass(lanes, S, b, h)
        _condense_half_pass(lanes, S, b, 0.5 * h)
    _predict_whole_pass(lanes, S, last, h)
    _predict_half_pass(lanes, S, last, 0.5 * h)
    for axle in range(n_axles):
        b = (axle + at.AXLE_BLOCK) * block
        _whole_wheel_pass(lanes, S, b, h)
        _half_wheel_pass(lanes, S, b, 0.5 * h)
        if is_driven(lanes, S, b):
            swing_whole_pass(lanes, S, b)
            swing_half_pass(lanes, S, b)
    _whole_train_pass(lanes, S, last, h)
    _half_train_pass(lanes, S, last, 0.5 * h)


@inlined
def _second_half(
    lanes: Any, S: Any, n_axles: int, creep_law: int, tables: Any, custom: Any, h: float
) -> None:
    """Step by h/2 once more, and extrapolate."""
    block = at.N_VARS * width(lanes)
    last = n_axles * block
    _head_pass(lanes, S)
    for axle in range(n_axles):
        b = (axle + at.AXLE_BLOCK) * block
        contact_pass(lanes, S, axle, creep_law, tables, custom)
        if is_driven(lanes, S, b):
            load_half_pass(lanes, S, b, 0.5 * h)
        _condense_half_pass(lanes, S, b, 0.5 * h)
    _predict_half_pass(lanes, S, last, 0.5 * h)
    for axle in range(n_axles):
        b = (axle + at.AXLE_BLOCK) * block
        _half_wheel_pass(lanes, S, b, 0.5 * h)
        if is_driven(lanes, S, b):
            swing_half_pass(lanes, S, b)
            extrapolate_driveline_pass(lanes, S, b)
        _extrapolate_pass(lanes, S, b)
    _half_train_pass(lanes, S, last, 0.5 * h)
    _extrapolate_pass(lanes, S, at.TRAIN_BLOCK)


@inlined
def plant_step(
    lanes: Any, S: Any, n_axles: int, creep_law: int, tables: Any, custom: Any, h: float
) -> None:
    """Advance wheels and train of every lane by h, to second order.

    Richardson's extrapolation of the step: 2 × two halves − one whole. It is linear in the
    states, so momentum stays exact, and so does energy with the tick's mean speeds.
    """
    _whole_and_first_half(lanes, S, n_axles, creep_law, tables, custom, h)
    _second_half(lanes, S, n_axles, creep_law, tables, custom, h)
