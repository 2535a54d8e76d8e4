"""From the sensor to a wheel speed that can be believed, with its acceleration.

Known wrong when: a sensor reads too slow by a few per cent. Its axle is then braked less than it
could be.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import CYLINDER_PRESSURE, DYNAMIC_FORCE, WHEEL_SPEED, FloatArray
from railgrip.control.conventional_parameters import (
    ACCELERATION_FILTER,
    DEAD_REFERENCE,
    DEAD_SPEED,
    DEAD_TIME,
    DYNAMIC_LEAST_FORCE,
    EMPTY_PRESSURE,
    FROZEN_TIME,
)
from railgrip.control.conventional_state import (
    ACCELERATION,
    DEAD_CLOCK,
    DIAMETER,
    FROZEN_CLOCK,
    IS_FAULTY,
    LAST_READING,
    LAST_STEP,
    REFERENCE,
    ROUGHNESS,
    SPEED,
    SPEED_LAG,
)
from railgrip.control.lone_leader import is_outvoted

ROUGH: Final = 0.15
"""Mean change of the step from reading to reading, m/s, that no wheel shows."""
PER_ROUGH_TIME: Final = 2.0
"""One over the time over which it is averaged, 1/s."""
GREATEST_TREMBLE: Final = 1.0
"""A single change counts for no more, m/s: one wrong reading is no noise."""
GREATEST_JUMP, GREATEST_RATE = 0.5, 150.0
"""No wheel changes its speed by more than this, m/s, and this times the period, m/s²: an axle that
seizes reaches 120 m/s²."""
GREATEST_SPEED = 200.0
"""No wheel turns faster, m/s; what reads more (or NaN) is a fault of the sensor."""


def read_wheel(
    parameters: FloatArray, state: FloatArray, base: int, measured: FloatArray, axle: int, dt: float
) -> None:
    """Update speed, acceleration and fault of one axle in the state.

    Parameters
    ----------
    parameters, state, measured : ndarray
        As in the controller contract.
    base : int
        Where the axle's block begins in the state.
    axle : int
        Row in ``measured``.
    dt : float
        Period, [s].

    Notes
    -----
    A toothed wheel knows no direction, so the magnitude counts. A reading that is no number makes
    the axle faulty at once. A standing reading is a locked wheel or a dead sensor: it is a dead
    sensor if the wheel stands although nothing has braked it for a while. A braked wheel never
    reads the very same speed for long, so one that does is frozen; believed, it would keep the
    reference speed up and all other brakes released. A reading that jumps as no wheel can, or that
    trembles, is none of a wheel either, and an axle that other wheels outvoted stays so.
    """
    reading = measured[axle, WHEEL_SPEED]
    if not -GREATEST_SPEED < reading < GREATEST_SPEED:
        state[base + IS_FAULTY] = 1.0
        state[base + DEAD_CLOCK] = parameters[DEAD_TIME]
        return
    speed = abs(reading) * state[base + DIAMETER]
    is_spoilt = _trembles(state, base, abs(reading), dt)
    if is_spoilt or is_outvoted(state, base, measured, axle, dt):
        state[base + IS_FAULTY] = 1.0
        state[base + DEAD_CLOCK] = parameters[DEAD_TIME]
    if state[REFERENCE] > parameters[DEAD_REFERENCE]:
        _watch_dead_sensor(parameters, state, base, measured, axle, speed, dt)
    blend = dt / (parameters[ACCELERATION_FILTER] + dt)
    lag = state[base + SPEED_LAG]
    lag += blend * (speed - lag)
    state[base + SPEED] = speed
    state[base + SPEED_LAG] = lag
    state[base + ACCELERATION] = (speed - lag) / parameters[ACCELERATION_FILTER]


def _trembles(state: FloatArray, base: int, reading: float, dt: float) -> bool:
    """Return whether a reading jumps, or changes its change, more than a wheel's inertia allows.

    Noise makes the step from reading to reading change by about twice its standard deviation each
    time, whatever the period; a wheel's step changes with its jerk only.
    """
    step = reading - state[base + LAST_READING]
    state[base + LAST_READING] = reading
    change = min(abs(step - state[base + LAST_STEP]), GREATEST_TREMBLE)
    roughness = state[base + ROUGHNESS]
    roughness += dt * PER_ROUGH_TIME * (change - roughness)
    state[base + LAST_STEP] = step
    state[base + ROUGHNESS] = roughness
    return bool(roughness > ROUGH or abs(step) > GREATEST_JUMP + GREATEST_RATE * dt)


def _watch_dead_sensor(
    parameters: FloatArray,
    state: FloatArray,
    base: int,
    measured: FloatArray,
    axle: int,
    speed: float,
    dt: float,
) -> None:
    """Decide between a locked wheel and a dead or frozen sensor, with clocks."""
    is_braked = (
        measured[axle, CYLINDER_PRESSURE] >= parameters[EMPTY_PRESSURE]
        or measured[axle, DYNAMIC_FORCE] >= parameters[DYNAMIC_LEAST_FORCE]
    )
    is_same = state[base + LAST_STEP] == 0.0
    clock = state[base + DEAD_CLOCK]
    if speed > parameters[DEAD_SPEED]:
        clock = max(0.0, clock - dt)
        frozen = state[base + FROZEN_CLOCK] + dt if is_same and is_braked else 0.0
        state[base + FROZEN_CLOCK] = frozen
        clock = parameters[DEAD_TIME] if frozen >= parameters[FROZEN_TIME] else clock
    elif not is_braked:
        clock = min(parameters[DEAD_TIME], clock + dt)
    state[base + DEAD_CLOCK] = clock
    if clock >= parameters[DEAD_TIME]:
        state[base + IS_FAULTY] = 1.0
    elif clock <= 0.0:
        state[base + IS_FAULTY] = 0.0
