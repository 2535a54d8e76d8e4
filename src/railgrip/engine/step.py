"""One step of wheels and train over all lanes: linearly implicit Euler, momentum exact.

Equations (driving positive; per axle: wheel speed w at the tread, contact force T; train speed v)::

    m_r dw/dt = -T - B sgn(w) - F_D              m_r rotating mass, B friction brake, F_D dynamic
    M   dv/dt = sum T - R sgn(v) - G             M static mass, R resistance, G gradient
    sigma dT/dt + |v| T = C (w - v)              relaxation form, C = T_ss(s)/s chord of the law

T is solved together with w and v (an arrow-shaped linear system: one pass down the train, one
back), so the step is stable at any length and never divides by v. B and R are dry friction:
they bring a speed to zero and hold it there, never beyond. The very T that moves the wheel moves
the train. Each pass is a loop over lanes that LLVM turns into packed arithmetic; choices (which
law) are taken outside it. A pass touches one block only: then LLVM sees that nothing overlaps.
"""

from __future__ import annotations

import math
from typing import Any


from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.freibauer_1983 import freibauer_1983
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_1983
from railgrip.engine.offsets import width
from railgrip.engine import layout, offsets as at
from railgrip.engine.compiler import inlined

LEAST_ROLLING_SPEED = 1e-3
"""Floor of the speed that creepage is formed with, m/s: at a stand every creepage is small."""
LEAST_CREEPAGE = 1e-7
"""Floor of the creepage, so that the chord T/s is defined; far below any that matters."""
LEAST_LOAD = 0.05
"""A wheel keeps at least this share of its static load."""

_falling = inlined(falling_friction)
_polach = inlined(polach_2005)
_freibauer = inlined(freibauer_1983)
_shen = inlined(shen_hedrick_elkins_1983)



@inlined
def _rail(L: int, S: Any, b: int, k: int) -> RailFriction:
    return RailFriction(
        S[b + at.RAIL_FRICTION * L + k],
        S[b + at.RAIL_RATIO * L + k],
        S[b + at.RAIL_DECAY * L + k],
        S[b + at.RAIL_ADHESION * L + k],
        S[b + at.RAIL_SLIP * L + k],
    )


@inlined
def _law_pass(lanes: Any, S: Any, b: int, law: Any, h: float) -> None:
    """Chord of the creep curve, then T by v alone: T = CARRIED + ... - STIFFNESS v."""
    L = width(lanes)
    for k in range(L):
        rail = _rail(L, S, b, k)
        train_speed = S[b + at.HERE_SPEED * L + k]
        wheel_speed = S[b + at.WHEEL_SPEED * L + k]
        load = S[b + at.HERE_LOAD * L + k]
        slip_speed = abs(wheel_speed - train_speed)
        rolling = max(abs(train_speed), abs(wheel_speed))
        creepage = max(slip_speed / max(rolling, LEAST_ROLLING_SPEED), LEAST_CREEPAGE)
        force = law(rail, load, S[b + at.SLOPE * L + k], slip_speed, creepage)
        _condense(L, S, b, k, force / creepage, wheel_speed, train_speed, rolling, h)
        S[b + at.FRICTION_LIMIT * L + k] = _falling(rail, slip_speed) * load


@inlined
def _custom_pass(lanes: Any, S: Any, b: int, custom: Any, h: float) -> None:
    """The same with somebody's own law, lane by lane."""
    L = width(lanes)
    for k in range(L):
        rail = _rail(L, S, b, k)
        train_speed = S[b + at.HERE_SPEED * L + k]
        wheel_speed = S[b + at.WHEEL_SPEED * L + k]
        load = S[b + at.HERE_LOAD * L + k]
        slip_speed = abs(wheel_speed - train_speed)
        rolling = max(abs(train_speed), abs(wheel_speed))
        creepage = max(slip_speed / max(rolling, LEAST_ROLLING_SPEED), LEAST_CREEPAGE)
        force = custom(
            rail.static_friction, rail.friction_ratio, rail.friction_decay,
            rail.adhesion_reduction, rail.slip_reduction,
            load, S[b + at.SLOPE * L + k], slip_speed, creepage,
        )  # fmt: skip
        _condense(L, S, b, k, force / creepage, wheel_speed, train_speed, rolling, h)
        S[b + at.FRICTION_LIMIT * L + k] = _falling(rail, slip_speed) * load


@inlined
def _condense(
    L: int, S: Any, b: int, k: int,
    chord: float, wheel_speed: float, train_speed: float, rolling: float, h: float,
) -> None:  # fmt: skip
    """Eliminate the wheel: what is left is a force and a stiffness against the train speed."""
    mass = S[b + at.ROTATING_MASS * L + k] / h
    limit = S[b + at.BRAKE_LIMIT * L + k]
    sigma = S[b + at.RELAXATION_LENGTH * L + k] / h
    damping = 1.0 / (sigma + rolling)
    carried = sigma * S[b + at.CONTACT_FORCE * L + k] * damping
    stiffness = chord * damping
    forced = mass * wheel_speed - S[b + at.DYNAMIC_ACTING * L + k]
    brake = math.copysign(limit, wheel_speed) if wheel_speed != 0.0 else 0.0
    share = 1.0 / (mass + stiffness)
    free = (forced - carried - brake) * share
    # a wheel that this brake locks contributes as a locked wheel
    turns = (free + stiffness * share * train_speed) * wheel_speed
    rotates = 0.0 if (turns <= 0.0 and limit > 0.0) else 1.0
    S[b + at.HERE_FORCE * L + k] = carried + stiffness * free * rotates
    S[b + at.HERE_STIFFNESS * L + k] = stiffness * (1.0 - stiffness * share * rotates)
    S[b + at.CARRIED * L + k] = carried
    S[b + at.STIFFNESS * L + k] = stiffness
    S[b + at.FORCED * L + k] = forced


@inlined
def _contact_pass(lanes: Any, S: Any, b: int, creep_law: int, custom: Any, h: float) -> None:
    """Contact by the law that the scenario names."""
    if creep_law == layout.LAW_POLACH:
        _law_pass(lanes, S, b, _polach, h)
    elif creep_law == layout.LAW_FREIBAUER:
        _law_pass(lanes, S, b, _freibauer, h)
    elif creep_law == layout.LAW_SHEN:
        _law_pass(lanes, S, b, _shen, h)
    else:
        _custom_pass(lanes, S, b, custom, h)


@inlined
def _wheel_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """Contact force and wheel speed of one axle, with sticking brake and friction limit."""
    L = width(lanes)
    for k in range(L):
        mass = S[b + at.ROTATING_MASS * L + k] / h
        old_speed = S[b + at.WHEEL_SPEED * L + k]
        train_speed = S[b + at.HERE_SPEED * L + k]
        limit = S[b + at.FRICTION_LIMIT * L + k]
        brake = S[b + at.BRAKE_LIMIT * L + k]
        carried = S[b + at.CARRIED * L + k]
        stiffness = S[b + at.STIFFNESS * L + k]
        forced = S[b + at.FORCED * L + k]
        share = 1.0 / (mass + stiffness)
        free = forced - carried + stiffness * train_speed
        speed = math.copysign(max(abs(free) - brake, 0.0) * share, free)
        contact = carried + stiffness * (speed - train_speed)
        bounded = min(max(contact, -limit), limit)
        # at its limit the contact force no longer depends on the speeds
        free = forced - bounded
        slipping = math.copysign(max(abs(free) - brake, 0.0) / mass, free)
        speed = slipping if contact != bounded else speed
        S[b + at.WHEEL_SPEED * L + k] = speed
        S[b + at.CONTACT_FORCE * L + k] = bounded
        S[b + at.CONTACT_IMPULSE * L + k] += h * bounded
        S[b + at.BRAKE_IMPULSE * L + k] += h * (
            mass * (old_speed - speed) - bounded - S[b + at.DYNAMIC_ACTING * L + k]
        )


@inlined
def _tell_axle(lanes: Any, S: Any, b: int) -> None:
    """Copy what an axle needs of the train into its block."""
    L = width(lanes)
    for k in range(L):
        static = S[b + at.STATIC_LOAD * L + k]
        gain = S[b + at.LOAD_TRANSFER * L + k] * S[at.PITCH_DECELERATION * L + k]
        S[b + at.HERE_LOAD * L + k] = max(static + gain, LEAST_LOAD * static)
        S[b + at.HERE_SPEED * L + k] = S[at.TRAIN_SPEED * L + k]


@inlined
def _tell_speed(lanes: Any, S: Any, b: int) -> None:
    L = width(lanes)
    for k in range(L):
        S[b + at.HERE_SPEED * L + k] = S[at.TRAIN_SPEED * L + k]


@inlined
def _add(lanes: Any, S: Any, total: int, b: int, part: int) -> None:
    """Add one number of an axle to a sum of the train."""
    L = width(lanes)
    for k in range(L):
        S[total * L + k] += S[b + part * L + k]


@inlined
def _train_start(lanes: Any, S: Any) -> None:
    L = width(lanes)
    for k in range(L):
        S[at.SPEED_START * L + k] = S[at.TRAIN_SPEED * L + k]
        S[at.FORCE_SUM * L + k] = 0.0
        S[at.STIFF_SUM * L + k] = 0.0


@inlined
def _resistance(L: int, S: Any, k: int) -> float:
    speed = abs(S[at.SPEED_START * L + k])
    return (
        S[at.RESISTANCE_CONSTANT * L + k]
        + S[at.CURVE_FORCE * L + k]
        + speed * (S[at.RESISTANCE_LINEAR * L + k] + speed * S[at.RESISTANCE_QUADRATIC * L + k])
    )


@inlined
def _train_speed(L: int, S: Any, k: int, force: float, stiffness: float, h: float) -> float:
    """Return v after the step under ``force - stiffness v``: dry friction never reverses it."""
    mass = S[at.TRAIN_MASS * L + k] / h
    free = mass * S[at.SPEED_START * L + k] + force
    held = _resistance(L, S, k) + S[at.TRACK_BRAKE_FORCE * L + k]
    return math.copysign(max(abs(free) - held, 0.0) / (mass + stiffness), free)


@inlined
def _predict(lanes: Any, S: Any, h: float) -> None:
    """Solve the arrow for v; the axles need it before their forces are final."""
    L = width(lanes)
    for k in range(L):
        force = S[at.FORCE_SUM * L + k] - S[at.GRADIENT_FORCE * L + k]
        S[at.TRAIN_SPEED * L + k] = _train_speed(L, S, k, force, S[at.STIFF_SUM * L + k], h)
        S[at.FORCE_SUM * L + k] = 0.0


@inlined
def _train_finish(lanes: Any, S: Any, h: float) -> None:
    L = width(lanes)
    for k in range(L):
        start = S[at.SPEED_START * L + k]
        force = S[at.FORCE_SUM * L + k] - S[at.GRADIENT_FORCE * L + k]
        speed = _train_speed(L, S, k, force, 0.0, h)
        # what the dry friction of resistance and track brake really took, shared as they pull
        held = h * force - S[at.TRAIN_MASS * L + k] * (speed - start)
        resistance = _resistance(L, S, k)
        share = resistance / max(resistance + S[at.TRACK_BRAKE_FORCE * L + k], 1e-9)
        S[at.RESISTANCE_IMPULSE * L + k] += held * share
        S[at.TRACK_BRAKE_IMPULSE * L + k] += held * (1.0 - share)
        S[at.TRAIN_SPEED * L + k] = speed
        lag = S[at.PITCH_TIME * L + k]
        pitch = S[at.PITCH_DECELERATION * L + k]
        S[at.PITCH_DECELERATION * L + k] = (lag * pitch + (start - speed)) / (lag + h)


@inlined
def plant_step(lanes: Any, S: Any, n_axles: int, creep_law: int, custom: Any, h: float) -> None:
    """Advance wheels and train of every lane by h."""
    L = width(lanes)
    _train_start(lanes, S)
    for axle in range(n_axles):
        b = (axle + at.AXLE_BLOCK) * at.N_VARS * L
        _tell_axle(lanes, S, b)
        _contact_pass(lanes, S, b, creep_law, custom, h)
        _add(lanes, S, at.FORCE_SUM, b, at.HERE_FORCE)
        _add(lanes, S, at.STIFF_SUM, b, at.HERE_STIFFNESS)
    _predict(lanes, S, h)
    for axle in range(n_axles):
        b = (axle + at.AXLE_BLOCK) * at.N_VARS * L
        _tell_speed(lanes, S, b)
        _wheel_pass(lanes, S, b, h)
        _add(lanes, S, at.FORCE_SUM, b, at.CONTACT_FORCE)
    _train_finish(lanes, S, h)
