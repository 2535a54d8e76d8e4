"""What brakes and motor of an axle apply at the tread, from what is measured and known of them."""

from __future__ import annotations

from railgrip.control.contract import FIRST_PRESSURE, FULL_PRESSURE, FloatArray
from railgrip.control.conventional_state import DYNAMIC, IS_BRAKED, PRESSURE
from railgrip.control.temperature_state import FIRST, FORCE_PER_PRESSURE, PRESSURE_PER_FORCE
from railgrip.core.formulas.choosing import choose

NOMINAL_PRESSURE = 3.0e5
"""Cylinder pressure at full demand where the vehicle does not tell it, Pa."""


def pressure_for(state: FloatArray, base: int, force: float) -> float:
    """Return the cylinder pressure that gives a friction brake force at the tread, [Pa]."""
    over: float = force * state[base + PRESSURE_PER_FORCE]
    return choose(force > 0.0, state[base + FIRST] + over, 0.0)


def pressures(axle_setup: FloatArray, axle: int) -> tuple[float, float]:
    """Return the pressures at which the brake force begins and is full, [Pa]."""
    first, full = axle_setup[axle, FIRST_PRESSURE], axle_setup[axle, FULL_PRESSURE]
    if full <= first:
        return 0.0, NOMINAL_PRESSURE
    return first, full


def force_per_pressure(axle_setup: FloatArray, axle: int, full_force: float) -> float:
    """Return what each Pascal above the first gives at the tread, [N/Pa]."""
    first, full = pressures(axle_setup, axle)
    return full_force / (full - first)


def applied_force(state: FloatArray, base: int) -> float:
    """Return what brakes and motor apply at the tread now, driving positive, [N]."""
    over = max(state[base + PRESSURE] - state[base + FIRST], 0.0)
    force = state[base + FORCE_PER_PRESSURE] * over
    works = (state[base + IS_BRAKED] > 0.0) & (force < 1.0e6)
    friction = choose(works, force, 0.0)
    applied: float = -friction - state[base + DYNAMIC]
    return applied


def motor_force(effort: float, power: float, wheel: float, least: float) -> float:
    """Return what the motor can give at this wheel speed: effort, or power over speed, [N].

    Examples
    --------
    >>> motor_force(60e3, 500e3, 20.0, 1.0)
    25000.0
    """
    return min(effort, power / max(wheel, least))
