"""From a train's description to the numbers of its axles: train block and axle blocks."""

from __future__ import annotations

import math
from functools import cache

import numpy as np

from railgrip.brake import filling, orifice
from railgrip.contact.kalker_1990 import kalker_slope
from railgrip.core.constants import GRAVITY
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002, flash_conductance
from railgrip.core.formulas.patch import hertz_1882
from railgrip.core.formulas.piecewise_linear import hinges_from_points
from railgrip.engine import layout as at
from railgrip.engine.plan import FloatArray
from railgrip.scenario.bogie import Axle
from railgrip.scenario.brakes import FrictionBrake
from railgrip.scenario.friction import ConstantPad, KarwatzkiPad, Pad, PiecewisePad
from railgrip.scenario.scenario import Scenario
from railgrip.train.load_transfer import load_transfer

STEPS_PER_SWING = 10
"""Steps in one swing of motor against wheelset: with fewer the integration damps it by more than
1 % of critical (it would be stable down to 1.2)."""
RAIL_HEAD_RADIUS = 0.3
"""Transverse radius of the rail head 60E1 at its crown, m."""
YOUNG = 210e9
"""Young's modulus of wheel and rail steel, Pa."""
POISSON = 0.28
"""Poisson's ratio of steel (as in the base case of the verification)."""
PITCH_TIME = 0.15
"""Lag of the load transfer, the body's pitching on its springs, s (illustrative)."""
ENDLESS = 1e9
"""A reservoir or a heat store that nothing exhausts."""
VENT_FROM, VENT_TO = 3.8e5, 0.4e5
FILL_FROM, FILL_TO, FILL_SUPPLY = 0.4e5, 3.6e5, 3.8e5
"""Pressures between which the times of a dump valve are meant, Pa."""


FILLING = {"linear": at.FILL_LINEAR, "orifice": at.FILL_ORIFICE, "lag": at.FILL_LAG}

# Calibrating an orifice takes milliseconds, and the axles of a train are mostly alike.
_distributor = cache(filling.distributor)
_rate_constant_fill = cache(orifice.rate_constant_fill)
_rate_constant_vent = cache(orifice.rate_constant_vent)


def lower_train(scenario: Scenario) -> tuple[FloatArray, FloatArray]:
    """Return the parameter table (1 + axles, N_PARAMETERS) and the axles' brakes."""
    table = np.zeros((1 + scenario.train.n_axles, at.N_PARAMETERS))
    brakes = np.zeros((scenario.train.n_axles, at.BRAKE_COLUMNS))
    _fill(table[0], at.TRAIN_PARAMETERS, _train_values(scenario))
    gains = [gain for vehicle in _transfers(scenario) for gain in vehicle]
    loads = static_loads(scenario)
    for i in range(scenario.train.n_axles):
        values, brakes[i] = _axle_values(scenario, i)
        values |= {"STATIC_LOAD": loads[i], "LOAD_TRANSFER": gains[i]}
        values |= _contact_values(scenario, i, loads[i], gains[i])
        _fill(table[1 + i], at.AXLE_PARAMETERS, values)
    return table, brakes


def _fill(row: FloatArray, names: str, values: dict[str, float]) -> None:
    for i, name in enumerate(names.split()):
        row[i] = values[name]


def _train_values(scenario: Scenario) -> dict[str, float]:
    train = scenario.train
    parts = [train.resistance, *(v.resistance for v in train.vehicle if v.resistance is not None)]
    magnets = [v.track_brake for v in train.vehicle if v.track_brake is not None]
    kinds = {magnet.model_copy(update={"force": 1.0}) for magnet in magnets}
    if len(kinds) > 1:
        raise RailgripError(
            Problem(
                "train.vehicle",
                "track brakes must not differ in anything but their force",
                got=f"{len(kinds)} kinds",
            )
        )
    force = sum(magnet.force for magnet in magnets)
    magnet = magnets[0] if magnets else None
    return {
        "TRAIN_MASS": scenario.mass,
        "TRAIN_LENGTH": train.length,
        "RESISTANCE_CONSTANT": sum(part.constant for part in parts),
        "RESISTANCE_LINEAR": sum(part.linear for part in parts),
        "RESISTANCE_QUADRATIC": sum(part.quadratic for part in parts),
        "PITCH_TIME": PITCH_TIME,
        "DECELERATION_SCALE": 1.0,
        "DECELERATION_OFFSET": 0.0,
        "POSITION_ERROR": 0.0,
        "INITIAL_SPEED": scenario.run.speed,
        "START_POSITION": scenario.line.start,
        "TRACK_BRAKE_ATTRACTION": force,
        "TRACK_BRAKE_FRICTION": magnet.friction if magnet else 0.0,
        "TRACK_BRAKE_FALL": magnet.friction_fall if magnet else 0.0,
        "TRACK_BRAKE_RELEASE": magnet.release_speed if magnet else 0.0,
        "TRACK_BRAKE_RATE": force * magnet.friction / magnet.build_up if magnet else 0.0,
    }


def static_loads(scenario: Scenario) -> list[float]:
    """Return the static load of each axle, [N]."""
    loads = []
    for vehicle, payload in zip(scenario.train.vehicle, scenario.payloads(), strict=True):
        axles = [axle for bogie in vehicle.bogie for axle in bogie.axle]
        weight = (vehicle.tare + payload) * GRAVITY
        shares = [1 / len(axles) if a.load_share is None else a.load_share for a in axles]
        loads += [weight * share / sum(shares) for share in shares]
    return loads


def _transfers(scenario: Scenario) -> list[list[float]]:
    transfers = []
    for vehicle, payload in zip(scenario.train.vehicle, scenario.payloads(), strict=True):
        axles = iter(vehicle.axle_offsets())
        pivots = vehicle.pivot_offsets()
        places = [
            [pivot - next(axles) for _ in bogie.axle]
            for pivot, bogie in zip(pivots, vehicle.bogie, strict=True)
        ]
        gains = load_transfer(
            pivots,
            [bogie.mass for bogie in vehicle.bogie],
            [bogie.height for bogie in vehicle.bogie],
            vehicle.tare + payload - sum(bogie.mass for bogie in vehicle.bogie),
            vehicle.body_height,
            [bogie.traction_height for bogie in vehicle.bogie],
            places,
        )
        transfers.append([gain for bogie in gains for gain in bogie])
    return transfers


def contact_geometry(scenario: Scenario, i: int) -> tuple[float, float, float, float, float]:
    """Radii and material of an axle's contacts, in the order that `hertz_1882` takes them in."""
    axle = scenario.train.axles()[i].axle
    tread = axle.tread_radius_transverse
    across = float("inf") if tread is None else tread
    return axle.wheel_radius, across, RAIL_HEAD_RADIUS, YOUNG, POISSON


def _contact_values(scenario: Scenario, i: int, load: float, gain: float) -> dict[str, float]:
    geometry = (load / 2, *contact_geometry(scenario, i))
    patch = hertz_1882(*geometry)
    return contact_numbers(
        patch.a, kalker_slope(*geometry), flash_parts(patch.a, patch.b), load, gain
    )


def flash_parts(a: float, b: float) -> tuple[float, float]:
    """Return squared conductances of a patch: of resting steel, and per speed of moving steel."""
    still = flash_conductance(STEEL_ERTZ_2002, a, b, 0.0) ** 2
    return still, flash_conductance(STEEL_ERTZ_2002, a, b, 1.0) ** 2 - still


def contact_numbers(
    a: float, slope: float, flash: tuple[float, float], load: float, gain: float
) -> dict[str, float]:
    """Return the numbers of an axle's contacts from those of one wheel."""
    still, moving = flash
    # a patch grows with the load^(1/3), so what moving steel takes up grows with its root
    return {
        "KALKER_SLOPE": 2 * slope,
        "RELAXATION_LENGTH": 8 * a / (3 * np.pi),
        "FLASH_STILL": still,
        "FLASH_MOVING": moving,
        "FLASH_TRANSFER": moving * gain / load,
    }


def _axle_values(scenario: Scenario, i: int) -> tuple[dict[str, float], FloatArray]:
    train = scenario.train
    place = train.axles()[i]
    axle = place.axle
    vehicle = train.vehicle[place.vehicle]
    brake = train.brakes[axle.brake] if axle.brake is not None else None
    values = {
        "ROTATING_MASS": axle.rotating_mass,
        "WHEEL_RADIUS": axle.wheel_radius,
        "BELIEVED_RATIO": axle.believed_radius / axle.wheel_radius,
        "OFFSET": place.behind_front,
        "AMBIENT": scenario.run.ambient,
        "START_TEMPERATURE": scenario.run.ambient,
        "PAD_FACTOR": axle.friction_factor,
        "LEARNED_FRICTION": 1.0,
        "TEMPERATURE_ERROR": 0.0,
        "PRESSURE_LIMIT": ENDLESS,
        "SANDER_FLOW": train.sander.flow if train.sander and axle.sander else 0.0,
    }
    factor = vehicle.brake_factor(scenario.payloads()[place.vehicle])
    values |= _brake_values(brake, axle.wheel_radius, factor)
    values |= _dynamic_values(scenario, axle.motor)
    values |= _traction_values(scenario, axle.motor)
    values |= _driveline_values(scenario, axle)
    values |= _valve_values(scenario, brake)
    if scenario.brake_control is not None:
        values["PRESSURE_LIMIT"] = values["FULL_PRESSURE"] * scenario.brake_control.pressure_reserve
    if brake is not None and train.brake_control.kind == "pipe":
        middle = train.vehicle_fronts()[place.vehicle] + vehicle.length / 2
        values["DEMAND_DELAY"] += middle / train.brake_control.wave_speed
    row = np.zeros(at.BRAKE_COLUMNS)
    if brake is not None:
        row[0] = FILLING[brake.fill]
        shape = _pad_shape(brake.pad)
        row[1 : 1 + len(shape)] = shape
        values["PAD_LEVEL"] = pad_level(brake.pad)
    if axle.isolated:
        values |= UNBRAKED
    return values, row


def _pad_shape(pad: Pad) -> list[float]:
    """Return law and numbers of a pad but its level: how friction depends on the rest."""
    if isinstance(pad, ConstantPad):
        return [at.PAD_CONSTANT]
    if isinstance(pad, KarwatzkiPad):
        return [at.PAD_KARWATZKI, pad.force_high, pad.force_low, pad.speed_high, pad.speed_low]
    assert isinstance(pad, PiecewisePad)
    curves = [hinges_from_points(c) for c in (pad.temperature, pad.speed, pad.clamp_force)]
    return [at.PAD_PIECEWISE, *(n for curve in curves for n in curve)]


def pad_level(pad: Pad) -> float:
    """Return the number that the friction of a pad is proportional to."""
    if isinstance(pad, ConstantPad):
        return pad.friction
    return pad.base if isinstance(pad, KarwatzkiPad) else pad.reference_friction


def nominal_friction(pad: Pad, clamp_force: float) -> float:
    """Return the friction that blending counts with: at reference, or at 50 km/h for a block."""
    if isinstance(pad, ConstantPad):
        return pad.friction
    if isinstance(pad, PiecewisePad):
        return pad.reference_friction
    above = (clamp_force + pad.force_high) * (50 / 3.6 + pad.speed_high)
    return pad.base * above / ((clamp_force + pad.force_low) * (50 / 3.6 + pad.speed_low))


def _brake_values(
    brake: FrictionBrake | None, wheel_radius: float, factor: float
) -> dict[str, float]:
    if brake is None:
        return dict(UNBRAKED)
    rigging = brake.rigging_ratio * brake.rigging_efficiency * brake.units
    slope = brake.cylinder_area * brake.cylinder_efficiency * rigging
    offset = brake.cylinder_spring * rigging + brake.rigging_spring * brake.units
    full_clamp = factor * (slope * brake.cylinder_pressure + offset)
    pressure = (full_clamp - offset) / slope
    radius = brake.friction_radius if brake.friction_radius is not None else wheel_radius
    per_block = 1 / (brake.units * (brake.blocks if brake.kind == "block" else 1))
    friction = nominal_friction(brake.pad, full_clamp * per_block)
    full_force = full_clamp * friction * radius / wheel_radius
    return {
        "FULL_PRESSURE": pressure,
        "PER_FULL_PRESSURE": 1.0 / pressure,
        "CLAMP_PER_PRESSURE": slope,
        "CLAMP_OFFSET": offset,
        "HYSTERESIS": brake.hysteresis,
        "TREAD_PER_CLAMP": radius / wheel_radius,
        "CLAMP_PER_BLOCK": per_block,
        "RUBBING_RATIO": radius / wheel_radius,
        "FULL_FORCE": full_force,
        "PER_FULL_FORCE": 1.0 / full_force,
        "DEMAND_DELAY": brake.dead_time,
        **_filling_values(brake, pressure),
        **_heat_values(brake),
    }


def _filling_values(brake: FrictionBrake, pressure: float) -> dict[str, float]:
    if brake.fill == "linear":
        return {
            "FILL_RATE": pressure / brake.fill_time,
            "INSHOT_RATE": 0.0,
            "INSHOT_PRESSURE": 0.0,
            "RELEASE_RATE": pressure / brake.release_time,
        }
    if brake.fill == "lag":
        rate = 1.0 / brake.lag
        return {
            "FILL_RATE": rate, "INSHOT_RATE": 0.0, "INSHOT_PRESSURE": 0.0, "RELEASE_RATE": rate,
        }  # fmt: skip
    orifices = _distributor(pressure, brake.fill_time, brake.release_time, inshot=brake.inshot)
    return {
        "FILL_RATE": orifices.fill_rate,
        "INSHOT_RATE": orifices.inshot_rate,
        "INSHOT_PRESSURE": orifices.inshot_pressure,
        "RELEASE_RATE": orifices.release_rate,
    }


def _heat_values(brake: FrictionBrake) -> dict[str, float]:
    disc = brake.disc
    if disc is None:
        return _cold()
    return {
        "RING_MASS": disc.ring_mass * brake.units,
        "HUB_MASS": disc.hub_mass * brake.units,
        "CONDUCTANCE": disc.conductance * brake.units,
        "DISC_SURFACE": disc.surface * brake.units,
        "HEAT_SHARE": disc.heat_share,
        "FILM_STILL": disc.film_still,
        "FILM_WIND": disc.film_wind,
        "EMISSIVITY": disc.emissivity,
    }


def _cold() -> dict[str, float]:
    return {
        "RING_MASS": ENDLESS, "HUB_MASS": ENDLESS, "CONDUCTANCE": 0.0, "DISC_SURFACE": 0.0,
        "HEAT_SHARE": 0.0, "FILM_STILL": 0.0, "FILM_WIND": 0.0, "EMISSIVITY": 0.0,
    }  # fmt: skip


UNBRAKED = {
    "FULL_PRESSURE": 1.0, "PER_FULL_PRESSURE": 1.0, "PER_FULL_FORCE": 1.0,
    "CLAMP_PER_PRESSURE": 0.0, "CLAMP_OFFSET": 0.0, "HYSTERESIS": 0.0,
    "TREAD_PER_CLAMP": 0.0, "CLAMP_PER_BLOCK": 0.0, "RUBBING_RATIO": 0.0, "FULL_FORCE": 1.0,
    "DEMAND_DELAY": 0.0, "FILL_RATE": 0.0, "INSHOT_RATE": 0.0, "INSHOT_PRESSURE": 0.0,
    "RELEASE_RATE": 0.0, "PAD_LEVEL": 0.0, **_cold(),
}  # fmt: skip
"""Numbers of an axle without a friction brake, or with one that is isolated."""


def _dynamic_values(scenario: Scenario, is_motored: bool) -> dict[str, float]:
    dynamic = scenario.train.dynamic_brake if is_motored else None
    if dynamic is None:
        return {
            "DYNAMIC_MAX": 0.0, "DYNAMIC_POWER": 0.0, "FADE_START": 2.0, "FADE_END": 1.0,
            "DYNAMIC_RATE": 0.0,
        }  # fmt: skip
    return {
        "DYNAMIC_MAX": dynamic.force,
        "DYNAMIC_POWER": dynamic.power,
        "FADE_START": dynamic.fade_start,
        "FADE_END": dynamic.fade_end,
        "DYNAMIC_RATE": dynamic.force / dynamic.build_up,
    }


def _traction_values(scenario: Scenario, is_motored: bool) -> dict[str, float]:
    traction = scenario.train.traction if is_motored else None
    if traction is None:
        return {"TRACTION_MAX": 0.0, "TRACTION_POWER": 0.0, "TRACTION_RATE": 0.0}
    n_motors = sum(place.axle.motor for place in scenario.train.axles())
    force = traction.force / n_motors
    return {
        "TRACTION_MAX": force,
        "TRACTION_POWER": traction.power / n_motors,
        "TRACTION_RATE": force / traction.build_up,
    }


def _driveline_values(scenario: Scenario, axle: Axle) -> dict[str, float]:
    traction = scenario.train.traction if axle.motor else None
    if traction is None or traction.driveline is None:
        return {"MOTOR_MASS": 0.0, "SHAFT_STIFFNESS": 0.0, "SHAFT_DAMPING": 0.0}
    shaft, squared = traction.driveline, axle.wheel_radius**2
    mass = axle.rotating_mass * shaft.motor_share
    critical = 2.0 * math.sqrt(shaft.stiffness * squared * mass)
    if shaft.damping >= critical:
        raise RailgripError(
            Problem(
                "train.traction.driveline.damping",
                "must leave the motor swinging on its shaft",
                got=f"{shaft.damping:g} N·m·s/rad",
                allowed=f"below {critical:.0f} N·m·s/rad",
            )
        )
    wheelset = axle.rotating_mass - mass
    frequency = math.sqrt(shaft.stiffness / squared * (1.0 / mass + 1.0 / wheelset)) / math.tau
    longest = 1.0 / (STEPS_PER_SWING * frequency)
    if scenario.run.step > longest:
        raise RailgripError(
            Problem(
                "run.step",
                f"is too long for the driveline, which swings with {frequency:.1f} Hz",
                got=f"{scenario.run.step:g} s",
                allowed=f"up to {longest:.4f} s",
            )
        )
    return {
        "MOTOR_MASS": mass,
        "SHAFT_STIFFNESS": shaft.stiffness / squared,
        "SHAFT_DAMPING": shaft.damping / squared,
    }


def _valve_values(scenario: Scenario, brake: FrictionBrake | None) -> dict[str, float]:
    valve = scenario.train.dump_valve
    if valve is None or brake is None or brake.fill == "lag":
        volume = 0.012 if brake is not None and brake.fill != "lag" else 0.0
        return {
            "HAS_VALVE": 0.0, "VALVE_FILL": 0.0, "VALVE_VENT": 0.0, "CYLINDER_VOLUME": volume,
        }  # fmt: skip
    return {
        "HAS_VALVE": 1.0,
        "VALVE_FILL": _rate_constant_fill(FILL_FROM, FILL_TO, FILL_SUPPLY, valve.fill_time_valve),
        "VALVE_VENT": _rate_constant_vent(VENT_FROM, VENT_TO, valve.vent_time),
        "CYLINDER_VOLUME": valve.cylinder_volume,
    }
