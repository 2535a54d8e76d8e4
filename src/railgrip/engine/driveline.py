"""The shaft between motor and wheelset: motor inertia, torsional spring and damper, wheelset.

The motor swings on its shaft, seen from a wheelset that turns evenly through the step. That motion
is known in closed form, and linear in the wheel speed at the step's end; so motor and shaft appear
to the linearly implicit step as a mass that turns with the wheelset and a force on it. A motor on a
wheelset that stands or turns evenly swings exactly, at any length of the step. With a wheelset that
swings too the step is of second order: it adds 0.05 % of critical damping at twenty steps a swing,
1 % at ten (`lower_train` refuses fewer), and stays stable down to 1.2.

All at the tread: twist in m, stiffness in N/m. Driving positive.
"""

from __future__ import annotations

import math
from typing import Any

from railgrip.compiler import compiled, inlined
from railgrip.engine import layout
from railgrip.engine import offsets as at
from railgrip.engine.offsets import width

WHOLE, HALF = 0, 4
"""Where the coefficients of the whole and of the half step begin."""


@compiled
def begin_driveline(L: int, S: Any, b: int, speed: float, tick: float) -> None:
    """Let motor and wheelset turn together, and find how the motor swings in a step."""
    mass = S[b + layout.MOTOR_MASS * L]
    S[b + layout.TURNED_MASS * L] = S[b + layout.ROTATING_MASS * L]
    S[b + layout.WHOLE_TURNED_MASS * L] = S[b + layout.ROTATING_MASS * L]
    if mass <= 0.0:
        return
    S[b + layout.MOTOR_SPEED * L] = speed
    rate = 0.5 * S[b + layout.SHAFT_DAMPING * L] / mass
    squared = S[b + layout.SHAFT_STIFFNESS * L] / mass
    turning = math.sqrt(squared - rate * rate)
    for first, h in ((WHOLE, tick), (HALF, 0.5 * tick)):
        kept = math.exp(-rate * h)
        sine, cosine = kept * math.sin(turning * h) / turning, kept * math.cos(turning * h)
        place = layout.TWIST_BY_TWIST + first
        S[b + place * L] = cosine + rate * sine
        S[b + (place + 1) * L] = sine
        S[b + (place + 2) * L] = -squared * sine
        S[b + (place + 3) * L] = cosine - rate * sine


@inlined
def is_driven(lanes: Any, S: Any, b: int) -> bool:
    """Return whether an axle has a shaft: a choice that all lanes share."""
    driven: bool = S[b + at.MOTOR_MASS * width(lanes)] > 0.0
    return driven


@inlined
def _load(L: int, S: Any, b: int, k: int, first: int, h: float) -> tuple[float, float]:
    """Return the mass that turns with the wheelset in a step, and the force against it."""
    mass = S[b + at.MOTOR_MASS * L + k]
    speed = S[b + at.MOTOR_SPEED * L + k]
    force = -S[b + at.DYNAMIC_ACTING * L + k]
    off_rest = S[b + at.TWIST * L + k] - force / S[b + at.SHAFT_STIFFNESS * L + k]
    by_twist = S[b + (at.SPEED_BY_TWIST + first) * L + k]
    carried = mass * (1.0 - S[b + (at.SPEED_BY_SPEED + first) * L + k])
    # what the shaft gives to a wheelset that stands at the step's end
    impulse = force * h - mass * by_twist * off_rest + carried * speed
    wheelset = S[b + at.ROTATING_MASS * L + k] - mass
    against = (carried * S[b + at.WHEEL_SPEED * L + k] - impulse) / h
    return wheelset + carried, against


@inlined
def _swing(L: int, S: Any, b: int, k: int, first: int, wheel_speed: float) -> tuple[float, float]:
    """Return motor speed and twist after a step in which the wheelset turned so fast."""
    force = -S[b + at.DYNAMIC_ACTING * L + k]
    rest = force / S[b + at.SHAFT_STIFFNESS * L + k]
    twist = S[b + at.TWIST * L + k] - rest
    speed = S[b + at.MOTOR_SPEED * L + k] - wheel_speed
    after = S[b + (at.SPEED_BY_TWIST + first) * L + k] * twist
    after += S[b + (at.SPEED_BY_SPEED + first) * L + k] * speed
    twisted = S[b + (at.TWIST_BY_TWIST + first) * L + k] * twist
    twisted += S[b + (at.TWIST_BY_SPEED + first) * L + k] * speed
    return wheel_speed + after, rest + twisted


@inlined
def load_whole_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """Before the whole step: what the wheelset feels of motor and shaft."""
    L = width(lanes)
    for k in range(L):
        mass, force = _load(L, S, b, k, at.as_offset(WHOLE), h)
        S[b + at.WHOLE_TURNED_MASS * L + k] = mass
        S[b + at.WHOLE_TURNING_FORCE * L + k] = force


@inlined
def load_half_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """Before a half step."""
    L = width(lanes)
    for k in range(L):
        mass, force = _load(L, S, b, k, at.as_offset(HALF), h)
        S[b + at.TURNED_MASS * L + k] = mass
        S[b + at.TURNING_FORCE * L + k] = force


@inlined
def swing_whole_pass(lanes: Any, S: Any, b: int) -> None:
    """After the whole step: kept aside."""
    L = width(lanes)
    for k in range(L):
        wheel_speed = S[b + (at.WHOLE_STEP + at.WHEEL_SPEED) * L + k]
        speed, twist = _swing(L, S, b, k, at.as_offset(WHOLE), wheel_speed)
        S[b + at.WHOLE_MOTOR_SPEED * L + k] = speed
        S[b + at.WHOLE_TWIST * L + k] = twist


@inlined
def swing_half_pass(lanes: Any, S: Any, b: int) -> None:
    """After a half step."""
    L = width(lanes)
    for k in range(L):
        wheel_speed = S[b + at.WHEEL_SPEED * L + k]
        speed, twist = _swing(L, S, b, k, at.as_offset(HALF), wheel_speed)
        S[b + at.MOTOR_SPEED * L + k] = speed
        S[b + at.TWIST * L + k] = twist


@inlined
def extrapolate_driveline_pass(lanes: Any, S: Any, b: int) -> None:
    """Richardson, as for the wheels."""
    L = width(lanes)
    for k in range(L):
        speed, twist = S[b + at.MOTOR_SPEED * L + k], S[b + at.TWIST * L + k]
        S[b + at.MOTOR_SPEED * L + k] = 2.0 * speed - S[b + at.WHOLE_MOTOR_SPEED * L + k]
        S[b + at.TWIST * L + k] = 2.0 * twist - S[b + at.WHOLE_TWIST * L + k]


@inlined
def remember_motor_pass(lanes: Any, S: Any, b: int) -> None:
    """Keep the motor speed of the tick's start."""
    L = width(lanes)
    for k in range(L):
        S[b + at.MOTOR_SPEED_BEFORE * L + k] = S[b + at.MOTOR_SPEED * L + k]


@inlined
def account_driveline_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """Note what the shaft took: its impulse times how much faster the motor turned."""
    L = width(lanes)
    for k in range(L):
        before, after = S[b + at.MOTOR_SPEED_BEFORE * L + k], S[b + at.MOTOR_SPEED * L + k]
        wheel = 0.5 * (S[b + at.SPEED_BEFORE * L + k] + S[b + at.WHEEL_SPEED * L + k])
        lead = 0.5 * (before + after) - wheel
        given = -h * S[b + at.DYNAMIC_ACTING * L + k]
        impulse = given - S[b + at.MOTOR_MASS * L + k] * (after - before)
        S[b + at.MOTOR_LEAD * L + k] = lead
        S[b + at.DRIVELINE_ENERGY * L + k] += impulse * lead


@inlined
def shaft_torque(L: int, S: Any, b: int) -> float:
    """Return the torque that the shaft brings to the wheelset, driving positive, [N m]."""
    lead = S[b + layout.MOTOR_SPEED * L] - S[b + layout.WHEEL_SPEED * L]
    force = S[b + layout.SHAFT_STIFFNESS * L] * S[b + layout.TWIST * L]
    force += S[b + layout.SHAFT_DAMPING * L] * lead
    return float(force * S[b + layout.WHEEL_RADIUS * L])
