"""What brakes and motor of an axle apply at the tread, from what is measured and known of them."""

from __future__ import annotations

from railgrip.control.contract import (
    BRAKED,
    CYLINDER_PRESSURE,
    DYNAMIC_FORCE,
    FIRST_PRESSURE,
    FULL_PRESSURE,
    FloatArray,
)
from railgrip.control.temperature_state import FORCE_PER_PRESSURE

NOMINAL_PRESSURE = 3.0e5
"""Cylinder pressure at full demand where the vehicle does not tell it, Pa."""


def pressure_for(
    axle_setup: FloatArray, state: FloatArray, own: int, axle: int, force: float
) -> float:
    """Return the cylinder pressure that gives a friction brake force at the tread, [Pa]."""
    if force <= 0.0:
        return 0.0
    pressure: float = pressures(axle_setup, axle)[0] + force / state[own + FORCE_PER_PRESSURE]
    return pressure


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


def friction_brake_force(
    axle_setup: FloatArray, state: FloatArray, own: int, axle: int, pressure: float
) -> float:
    """Return the friction brake force that a cylinder pressure gives, [N]."""
    over = max(pressure - pressures(axle_setup, axle)[0], 0.0)
    force: float = state[own + FORCE_PER_PRESSURE] * over
    return force if force < 1.0e6 else 0.0


def applied_force(
    axle_setup: FloatArray, state: FloatArray, own: int, measured: FloatArray, axle: int
) -> float:
    """Return what brakes and motor apply at the tread now, driving positive, [N]."""
    friction = 0.0
    if axle_setup[axle, BRAKED] > 0.0:
        pressure = measured[axle, CYLINDER_PRESSURE]
        friction = friction_brake_force(axle_setup, state, own, axle, pressure)
    applied: float = -friction - measured[axle, DYNAMIC_FORCE]
    return applied


def motor_force(
    axle_setup: FloatArray, axle: int, wheel: float, effort_column: int, least: float
) -> float:
    """Return what the motor can give at this wheel speed: effort, or power over speed, [N]."""
    power = axle_setup[axle, effort_column + 1]
    force: float = min(axle_setup[axle, effort_column], power / max(wheel, least))
    return force
