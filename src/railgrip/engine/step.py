"""One step of the plant over all lanes: linearly implicit Euler, momentum exact.

Equations (driving positive; per axle: wheel speed w at the tread, contact force T; train speed v)::

    m_r dw/dt = -T - B sgn(w) - F_D              m_r rotating mass, B friction brake, F_D dynamic
    M   dv/dt = sum T - R sgn(v) - G             M static mass, R resistance, G gradient
    sigma dT/dt + |v| T = C (w - v)              relaxation form, C = T_ss(s)/s chord of the law

T is solved together with w and v (an arrow-shaped linear system: one pass down the train, one
back), so the step is stable at any length and never divides by v. B and R are dry friction:
they bring a speed to zero and hold it there, never beyond. The very T that moves the wheel moves
the train. Each pass is a loop over lanes that LLVM turns into packed arithmetic; choices (which
law) are taken outside it.
"""

from __future__ import annotations

import math
from typing import Any

import numba

from railgrip.brake.constant_friction import ConstantFriction, constant_friction
from railgrip.brake.dynamic_brake import DynamicBrake, dynamic_brake_limit
from railgrip.brake.filling import Distributor, LinearFilling, distributor_rate, linear_fill_rate
from railgrip.brake.karwatzki_1950 import KarwatzkiParameters, karwatzki_1950
from railgrip.brake.orifice import orifice_flow
from railgrip.brake.piecewise_friction import PiecewiseFriction, piecewise_friction
from railgrip.brake.rigging import hysteresis
from railgrip.brake.track_brake import TrackBrake, track_brake_force
from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.freibauer_1983 import freibauer_1983
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_1983
from railgrip.core.formulas.elementary import exp_decay, power_0_8, power_2_3
from railgrip.core.formulas.piecewise_linear import Hinges
from railgrip.core.formulas.two_node_heat import DiscHeat, two_node_heat_rates
from railgrip.engine import layout as at
from railgrip.engine.compiler import inlined

LEAST_ROLLING_SPEED = 1e-3
"""Floor of the speed that creepage is formed with, m/s: at a stand every creepage is small."""

CUT_OFF = 4.0
"""A converter cuts its torque off so many times faster than it builds it up; illustrative."""

_orifice_flow = inlined(orifice_flow)
_track_brake_force = inlined(track_brake_force)
_hysteresis = inlined(hysteresis)
_dynamic_limit = inlined(dynamic_brake_limit)
_constant = inlined(constant_friction)
_karwatzki = inlined(karwatzki_1950)
_piecewise = inlined(piecewise_friction)
_falling = inlined(falling_friction)
_polach = inlined(polach_2005)
_freibauer = inlined(freibauer_1983)
_shen = inlined(shen_hedrick_elkins_1983)
_exp_decay = inlined(exp_decay)
_power_0_8 = inlined(power_0_8)
_power_2_3 = inlined(power_2_3)
_linear_fill_rate = inlined(linear_fill_rate)
_distributor_rate = inlined(distributor_rate)
_heat_rates = inlined(two_node_heat_rates)

_lanes = numba.njit(forceinline=True, error_model="numpy")


@_lanes
def _dynamic_pass(L: int, S: Any, b: int, h: float) -> None:
    """Dynamic brake of one axle: it takes what it can of the demand."""
    for k in range(L):
        brake = DynamicBrake(
            S[b + at.DYNAMIC_MAX * L + k], S[b + at.DYNAMIC_POWER * L + k],
            S[b + at.FADE_START * L + k], S[b + at.FADE_END * L + k],
        )  # fmt: skip
        limit = _dynamic_limit(brake, S[b + at.WHEEL_SPEED * L + k])
        asked = S[b + at.DEMAND * L + k] * S[b + at.FULL_FORCE * L + k]
        share = S[b + at.DYNAMIC_SHARE * L + k] * S[at.DYNAMIC_ALLOWED * L + k]
        wanted = min(limit, asked) * share
        force = S[b + at.DYNAMIC_FORCE * L + k]
        change = S[b + at.DYNAMIC_RATE * L + k] * h
        S[b + at.DYNAMIC_FORCE * L + k] = max(
            force - CUT_OFF * change, min(force + change, wanted)
        )


@_lanes
def _target(L: int, S: Any, b: int, k: int) -> float:
    """Return the pressure for what the dynamic brake leaves over."""
    left = S[b + at.DEMAND * L + k] - S[b + at.DYNAMIC_FORCE * L + k] / S[b + at.FULL_FORCE * L + k]
    return S[b + at.FULL_PRESSURE * L + k] * max(left, 0.0)


@_lanes
def _supply_pass(L: int, S: Any, b: int, filling: float, h: float) -> None:
    """Pressure that distributor or electro-pneumatic valve offers; the reservoir bounds it."""
    if filling == at.FILL_LINEAR:
        for k in range(L):
            ramps = LinearFilling(S[b + at.FILL_RATE * L + k], S[b + at.RELEASE_RATE * L + k])
            supply = S[b + at.SUPPLY_PRESSURE * L + k]
            supply = supply + h * _linear_fill_rate(ramps, supply, _target(L, S, b, k), h)
            S[b + at.SUPPLY_PRESSURE * L + k] = min(supply, S[b + at.RESERVOIR_PRESSURE * L + k])
    else:
        for k in range(L):
            orifices = Distributor(
                S[b + at.FILL_RATE * L + k], S[b + at.INSHOT_RATE * L + k],
                S[b + at.INSHOT_PRESSURE * L + k], S[b + at.RELEASE_RATE * L + k],
            )  # fmt: skip
            supply = S[b + at.SUPPLY_PRESSURE * L + k]
            supply = supply + h * _distributor_rate(orifices, supply, _target(L, S, b, k))
            S[b + at.SUPPLY_PRESSURE * L + k] = min(supply, S[b + at.RESERVOIR_PRESSURE * L + k])


@_lanes
def _cylinder_pass(L: int, S: Any, b: int, h: float) -> None:
    """Brake cylinder behind its dump valve, and the force on pads or blocks."""
    for k in range(L):
        supply = S[b + at.SUPPLY_PRESSURE * L + k]
        pressure = S[b + at.CYLINDER_PRESSURE * L + k]
        into = S[b + at.IS_FILL * L + k] * S[b + at.VALVE_FILL * L + k]
        out = S[b + at.IS_VENT * L + k] * S[b + at.VALVE_VENT * L + k]
        change = into * _orifice_flow(supply, pressure) - out * _orifice_flow(pressure, 0.0)
        has_valve = S[b + at.HAS_VALVE * L + k]
        pressure = max(has_valve * (pressure + h * change) + (1.0 - has_valve) * supply, 0.0)
        nominal = S[b + at.CLAMP_PER_PRESSURE * L + k] * pressure + S[b + at.CLAMP_OFFSET * L + k]
        S[b + at.CYLINDER_PRESSURE * L + k] = pressure
        S[b + at.CLAMP_FORCE * L + k] = _hysteresis(
            S[b + at.CLAMP_FORCE * L + k], max(nominal, 0.0), S[b + at.HYSTERESIS * L + k]
        )


@_lanes
def _pad_inputs(L: int, S: Any, b: int, k: int) -> tuple[float, float, float]:
    return (
        S[b + at.CLAMP_FORCE * L + k] * S[b + at.CLAMP_PER_BLOCK * L + k],
        abs(S[b + at.WHEEL_SPEED * L + k]) * S[b + at.RUBBING_RATIO * L + k],
        S[b + at.RING_TEMPERATURE * L + k],
    )


@_lanes
def _pad_pass(L: int, S: Any, b: int, pad: Any) -> None:
    """Friction of the pads by the law that this axle's pad names."""
    law = pad[1]
    if law == at.PAD_CONSTANT:
        for k in range(L):
            clamp, rubbing, hot = _pad_inputs(L, S, b, k)
            S[b + at.PAD_FRICTION * L + k] = _constant(
                ConstantFriction(pad[2]), clamp, rubbing, hot
            )
    elif law == at.PAD_KARWATZKI:
        block = KarwatzkiParameters(pad[2], pad[3], pad[4], pad[5], pad[6])
        for k in range(L):
            clamp, rubbing, hot = _pad_inputs(L, S, b, k)
            S[b + at.PAD_FRICTION * L + k] = _karwatzki(block, clamp, rubbing, hot)
    elif law == at.PAD_PIECEWISE:
        organic = PiecewiseFriction(
            pad[2],
            Hinges(pad[3], pad[4], pad[5], pad[6], pad[7], pad[8], pad[9], pad[10], pad[11]),
            Hinges(pad[12], pad[13], pad[14], pad[15], pad[16], pad[17], pad[18], pad[19], pad[20]),
            Hinges(pad[21], pad[22], pad[23], pad[24], pad[25], pad[26], pad[27], pad[28], pad[29]),
        )
        for k in range(L):
            clamp, rubbing, hot = _pad_inputs(L, S, b, k)
            S[b + at.PAD_FRICTION * L + k] = _piecewise(organic, clamp, rubbing, hot)
    for k in range(L):
        S[b + at.BRAKE_LIMIT * L + k] = (
            S[b + at.PAD_FRICTION * L + k]
            * S[b + at.CLAMP_FORCE * L + k]
            * S[b + at.TREAD_PER_CLAMP * L + k]
        )


@_lanes
def _now(L: int, S: Any, b: int, k: int, first: int, last: int, when: float) -> float:
    """Return a rail number at the fraction `when` of the tick: linear along the way."""
    start = S[b + first * L + k]
    return start + when * (S[b + last * L + k] - start)


@_lanes
def _contact_inputs(
    L: int, S: Any, b: int, k: int, when: float
) -> tuple[RailFriction, float, float, float, float]:
    """Return rail, load, Kalker slope, slip speed and creepage of one axle in one lane."""
    train_speed = S[at.TRAIN_SPEED * L + k]
    wheel_speed = S[b + at.WHEEL_SPEED * L + k]
    static_load = S[b + at.STATIC_LOAD * L + k]
    load = static_load + S[b + at.LOAD_TRANSFER * L + k] * S[at.PITCH_DECELERATION * L + k]
    load = max(load, 0.05 * static_load)
    # Hertz: the patch and with it Kalker's slope grow with load^(2/3)
    slope = S[b + at.KALKER_SLOPE * L + k] * _power_2_3(load / static_load)
    slip_speed = abs(wheel_speed - train_speed)
    rolling = max(max(abs(train_speed), abs(wheel_speed)), LEAST_ROLLING_SPEED)
    # The floor keeps C = T/s defined; it is far below any creepage that matters.
    creepage = max(slip_speed / rolling, 1e-7)
    # an axle cleans for itself too: half of what it is just giving to the rail
    own = 0.5 * abs(S[b + at.CONTACT_FORCE * L + k]) * creepage
    left = _exp_decay(S[b + at.CLEANING_RATE * L + k] * own)
    friction = S[b + at.CLEAN_FRICTION * L + k] + left * (
        _now(L, S, b, k, at.RAIL_FRICTION, at.RAIL_END_FRICTION, when)
        - S[b + at.CLEAN_FRICTION * L + k]
    )
    ratio = S[b + at.CLEAN_RATIO * L + k] + left * (
        _now(L, S, b, k, at.RAIL_RATIO, at.RAIL_END_RATIO, when) - S[b + at.CLEAN_RATIO * L + k]
    )
    decay = S[b + at.CLEAN_DECAY * L + k] + left * (
        _now(L, S, b, k, at.RAIL_DECAY, at.RAIL_END_DECAY, when) - S[b + at.CLEAN_DECAY * L + k]
    )
    adhesion = S[b + at.CLEAN_ADHESION * L + k] + left * (
        _now(L, S, b, k, at.RAIL_ADHESION, at.RAIL_END_ADHESION, when)
        - S[b + at.CLEAN_ADHESION * L + k]
    )
    slip = S[b + at.CLEAN_SLIP * L + k] + left * (
        _now(L, S, b, k, at.RAIL_SLIP, at.RAIL_END_SLIP, when) - S[b + at.CLEAN_SLIP * L + k]
    )
    return RailFriction(friction, ratio, decay, adhesion, slip), load, slope, slip_speed, creepage


@_lanes
def _contact_law_pass(L: int, S: Any, b: int, law: Any, when: float) -> None:
    for k in range(L):
        rail, load, slope, slip_speed, creepage = _contact_inputs(L, S, b, k, when)
        S[b + at.CHORD * L + k] = law(rail, load, slope, slip_speed, creepage) / creepage
        S[b + at.FRICTION_LIMIT * L + k] = _falling(rail, slip_speed) * load


@_lanes
def _contact_pass(L: int, S: Any, b: int, creep_law: int, custom: Any, when: float) -> None:
    """Chord of the creep curve and friction limit, by the law that the scenario names."""
    if creep_law == at.LAW_POLACH:
        _contact_law_pass(L, S, b, _polach, when)
    elif creep_law == at.LAW_FREIBAUER:
        _contact_law_pass(L, S, b, _freibauer, when)
    elif creep_law == at.LAW_SHEN:
        _contact_law_pass(L, S, b, _shen, when)
    else:
        for k in range(L):
            rail, load, slope, slip_speed, creepage = _contact_inputs(L, S, b, k, when)
            force = custom(
                rail.static_friction, rail.friction_ratio, rail.friction_decay,
                rail.adhesion_reduction, rail.slip_reduction, load, slope, slip_speed, creepage,
            )  # fmt: skip
            S[b + at.CHORD * L + k] = force / creepage
            S[b + at.FRICTION_LIMIT * L + k] = _falling(rail, slip_speed) * load


@_lanes
def _condense_pass(L: int, S: Any, b: int, h: float) -> None:
    """Express T by v alone: T = CARRIED - STIFFNESS v, and sum up over the train."""
    for k in range(L):
        mass = S[b + at.ROTATING_MASS * L + k] / h
        wheel_speed = S[b + at.WHEEL_SPEED * L + k]
        sigma = S[b + at.RELAXATION_LENGTH * L + k] / h
        rolling = max(abs(S[at.TRAIN_SPEED * L + k]), abs(wheel_speed))
        carried = sigma * S[b + at.CONTACT_FORCE * L + k] / (sigma + rolling)
        stiffness = S[b + at.CHORD * L + k] / (sigma + rolling)
        brake = math.copysign(S[b + at.BRAKE_LIMIT * L + k], wheel_speed)
        brake = brake * (wheel_speed != 0.0)
        forced = mass * wheel_speed - S[b + at.DYNAMIC_FORCE * L + k]
        share = 1.0 / (mass + stiffness)
        free = (forced - carried - brake) * share
        # a wheel that this brake locks contributes as a locked wheel
        turns = free + stiffness * share * S[at.TRAIN_SPEED * L + k]
        locks = (turns * wheel_speed <= 0.0) * (S[b + at.BRAKE_LIMIT * L + k] > 0.0)
        S[at.FORCE_SUM * L + k] += carried + stiffness * free * (1.0 - locks)
        S[at.STIFF_SUM * L + k] += stiffness * (1.0 - stiffness * share * (1.0 - locks))
        S[b + at.CARRIED * L + k] = carried
        S[b + at.STIFFNESS * L + k] = stiffness
        S[b + at.FORCED * L + k] = forced


@_lanes
def _train_speed(L: int, S: Any, k: int, force: float, stiffness: float, h: float) -> float:
    """Return v after the step under ``force - stiffness v``: dry friction never reverses it."""
    inertia = S[at.TRAIN_MASS * L + k] / h + stiffness
    free = (S[at.TRAIN_MASS * L + k] / h * S[at.SPEED_START * L + k] + force) / inertia
    held = (_resistance(L, S, k) + S[at.TRACK_BRAKE_FORCE * L + k]) / inertia
    return math.copysign(max(abs(free) - held, 0.0), free)


@_lanes
def _resistance(L: int, S: Any, k: int) -> float:
    speed = abs(S[at.SPEED_START * L + k])
    return (
        S[at.RESISTANCE_CONSTANT * L + k]
        + S[at.CURVE_FORCE * L + k]
        + speed
        * (S[at.RESISTANCE_LINEAR * L + k] + speed * S[at.RESISTANCE_QUADRATIC * L + k])
    )


@_lanes
def _train_start(L: int, S: Any, h: float) -> None:
    for k in range(L):
        speed = S[at.TRAIN_SPEED * L + k]
        S[at.SPEED_START * L + k] = speed
        S[at.FORCE_SUM * L + k] = 0.0
        S[at.STIFF_SUM * L + k] = 0.0
        S[at.FILM * L + k] = _power_0_8(abs(speed))
        magnet = TrackBrake(
            S[at.TRACK_BRAKE_ATTRACTION * L + k], S[at.TRACK_BRAKE_FRICTION * L + k],
            S[at.TRACK_BRAKE_FALL * L + k], S[at.TRACK_BRAKE_RELEASE * L + k],
        )  # fmt: skip
        wanted = S[at.TRACK_BRAKE_ON * L + k] * _track_brake_force(magnet, abs(speed))
        step = S[at.TRACK_BRAKE_RATE * L + k] * h
        force = S[at.TRACK_BRAKE_FORCE * L + k]
        S[at.TRACK_BRAKE_FORCE * L + k] = max(force - step, min(force + step, wanted))


@_lanes
def _predict(L: int, S: Any, h: float, when: float) -> None:
    """Solve the arrow for v; the axles need it before their forces are final."""
    for k in range(L):
        gradient = _gradient(L, S, k, when)
        S[at.TRAIN_SPEED * L + k] = _train_speed(
            L, S, k, S[at.FORCE_SUM * L + k] - gradient, S[at.STIFF_SUM * L + k], h
        )
        S[at.FORCE_SUM * L + k] = 0.0


@_lanes
def _gradient(L: int, S: Any, k: int, when: float) -> float:
    start = S[at.GRADIENT_FORCE * L + k]
    return start + when * (S[at.GRADIENT_FORCE_END * L + k] - start)


@_lanes
def _wheel_pass(L: int, S: Any, b: int, h: float) -> None:
    """Contact force and wheel speed of one axle, with sticking brake and friction limit."""
    for k in range(L):
        mass = S[b + at.ROTATING_MASS * L + k] / h
        old_speed = S[b + at.WHEEL_SPEED * L + k]
        train_speed = S[at.TRAIN_SPEED * L + k]
        limit = S[b + at.FRICTION_LIMIT * L + k]
        brake = S[b + at.BRAKE_LIMIT * L + k]
        carried = S[b + at.CARRIED * L + k]
        stiffness = S[b + at.STIFFNESS * L + k]
        forced = S[b + at.FORCED * L + k]
        inertia = mass + stiffness
        free = (forced - carried + stiffness * train_speed) / inertia
        speed = math.copysign(max(abs(free) - brake / inertia, 0.0), free)
        contact = carried + stiffness * (speed - train_speed)
        bounded = min(max(contact, -limit), limit)
        # at its limit the contact force no longer depends on the speeds
        free = (forced - bounded) / mass
        slipping = math.copysign(max(abs(free) - brake / mass, 0.0), free)
        at_limit = contact != bounded
        speed = slipping if at_limit else speed
        dynamic = S[b + at.DYNAMIC_FORCE * L + k]
        brake_acting = mass * (old_speed - speed) - bounded - dynamic
        S[at.FORCE_SUM * L + k] += bounded
        S[b + at.WHEEL_SPEED * L + k] = speed
        S[b + at.CONTACT_FORCE * L + k] = bounded
        S[b + at.CONTACT_IMPULSE * L + k] += h * bounded
        S[b + at.BRAKE_IMPULSE * L + k] += h * brake_acting
        S[b + at.DYNAMIC_IMPULSE * L + k] += h * dynamic
        ring, hub = _heat_rates(
            DiscHeat(
                S[b + at.RING_MASS * L + k], S[b + at.HUB_MASS * L + k],
                S[b + at.CONDUCTANCE * L + k], S[b + at.DISC_SURFACE * L + k],
                S[b + at.HEAT_SHARE * L + k], S[b + at.FILM_STILL * L + k],
                S[b + at.FILM_WIND * L + k], S[b + at.EMISSIVITY * L + k],
                S[b + at.AMBIENT * L + k],
            ),
            S[b + at.RING_TEMPERATURE * L + k],
            S[b + at.HUB_TEMPERATURE * L + k],
            brake_acting * 0.5 * (old_speed + speed),
            S[b + at.FILM_STILL * L + k] + S[b + at.FILM_WIND * L + k] * S[at.FILM * L + k],
        )  # fmt: skip
        S[b + at.RING_TEMPERATURE * L + k] += h * ring
        S[b + at.HUB_TEMPERATURE * L + k] += h * hub


@_lanes
def _train_finish(L: int, S: Any, h: float, when: float) -> None:
    for k in range(L):
        start = S[at.SPEED_START * L + k]
        mass = S[at.TRAIN_MASS * L + k]
        gradient = _gradient(L, S, k, when)
        forces = S[at.FORCE_SUM * L + k] - gradient
        speed = _train_speed(L, S, k, forces, 0.0, h)
        # what the dry friction of resistance and track brake really took, shared as they pull
        held = h * forces - mass * (speed - start)
        resistance = _resistance(L, S, k)
        track_brake = S[at.TRACK_BRAKE_FORCE * L + k]
        share = resistance / max(resistance + track_brake, 1e-9)
        S[at.RESISTANCE_IMPULSE * L + k] += held * share
        S[at.TRACK_BRAKE_IMPULSE * L + k] += held * (1.0 - share)
        S[at.GRADIENT_IMPULSE * L + k] += h * gradient
        S[at.TRAIN_SPEED * L + k] = speed
        lag = S[at.PITCH_TIME * L + k]
        pitch = S[at.PITCH_DECELERATION * L + k]
        S[at.PITCH_DECELERATION * L + k] = (lag * pitch + (start - speed)) / (lag + h)


@_lanes
def plant_step(
    L: int, S: Any, n_axles: int, brakes: Any, creep_law: int, custom: Any, h: float, when: float
) -> None:
    """Advance every lane by h; rail and gradient are taken at the fraction `when` of the tick."""
    _train_start(L, S, h)
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L
        _dynamic_pass(L, S, b, h)
        _supply_pass(L, S, b, brakes[axle, 0], h)
        _cylinder_pass(L, S, b, h)
        _pad_pass(L, S, b, brakes[axle])
        _contact_pass(L, S, b, creep_law, custom, when)
        _condense_pass(L, S, b, h)
    _predict(L, S, h, when)
    for axle in range(n_axles):
        _wheel_pass(L, S, (1 + axle) * at.N_VARS * L, h)
    _train_finish(L, S, h, when)
