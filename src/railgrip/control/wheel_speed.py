"""From the sensor to a wheel speed that can be believed, with its acceleration.

Known wrong when: a sensor reads too slow by a few per cent. Its axle is then braked less than it
could be.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_state import (
    ACCELERATION,
    DEAD_CLOCK,
    DIAMETER,
    DYNAMIC,
    FROZEN_CLOCK,
    IS_FAULTY,
    LAST_READING,
    LAST_STEP,
    PRESSURE,
    READING,
    ROUGHNESS,
    SPEED,
    SPEED_LAG,
)
from railgrip.core.formulas.choosing import choose

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
    parameters: ConventionalParameters,
    state: FloatArray,
    base: int,
    is_fast: bool,
    dt: float,
) -> None:
    """Update speed, acceleration and fault of one axle in the state.

    Parameters
    ----------
    parameters : ConventionalParameters
        By name.
    state : ndarray
        As in the controller contract; what is measured has been put into it.
    base : int
        Where the axle's values begin.
    is_fast : bool
        Whether the train is faster than `dead_reference`.
    dt : float
        Period, [s].

    Notes
    -----
    A toothed wheel knows no direction, so the magnitude counts. A reading that is no number makes
    the axle faulty at once. A standing reading is a locked wheel or a dead sensor: it is a dead
    sensor if the wheel stands although nothing has braked it for a while. A braked wheel never
    reads the very same speed for long, so one that does is frozen; believed, it would keep the
    reference speed up and all other brakes released. A reading that jumps as no wheel can, or that
    trembles, is none of a wheel either.
    """
    reading = state[base + READING]
    is_number = abs(reading) < GREATEST_SPEED
    magnitude = choose(is_number, abs(reading), 0.0)
    is_spoilt = _trembles(state, base, magnitude, is_number, dt)
    is_wrong = is_spoilt | (not is_number)
    state[base + IS_FAULTY] = choose(is_wrong, 1.0, state[base + IS_FAULTY])
    state[base + DEAD_CLOCK] = choose(is_wrong, parameters.dead_time, state[base + DEAD_CLOCK])
    speed = magnitude * state[base + DIAMETER]
    _watch_dead_sensor(parameters, state, base, speed, is_fast & is_number, dt)
    blend = dt / (parameters.acceleration_filter + dt)
    lag = state[base + SPEED_LAG]
    lag += blend * (speed - lag)
    acceleration = (speed - lag) / parameters.acceleration_filter
    state[base + SPEED] = choose(is_number, speed, state[base + SPEED])
    state[base + SPEED_LAG] = choose(is_number, lag, state[base + SPEED_LAG])
    state[base + ACCELERATION] = choose(is_number, acceleration, state[base + ACCELERATION])


def _trembles(state: FloatArray, base: int, reading: float, is_number: bool, dt: float) -> bool:
    """Return whether a reading jumps, or changes its change, more than a wheel's inertia allows.

    Noise makes the step from reading to reading change by about twice its standard deviation each
    time, whatever the period; a wheel's step changes with its jerk only.
    """
    step = reading - state[base + LAST_READING]
    change = min(abs(step - state[base + LAST_STEP]), GREATEST_TREMBLE)
    roughness = state[base + ROUGHNESS]
    roughness += dt * PER_ROUGH_TIME * (change - roughness)
    state[base + LAST_READING] = choose(is_number, reading, state[base + LAST_READING])
    state[base + LAST_STEP] = choose(is_number, step, state[base + LAST_STEP])
    state[base + ROUGHNESS] = choose(is_number, roughness, state[base + ROUGHNESS])
    is_rough = roughness > ROUGH
    jumps = abs(step) > GREATEST_JUMP + GREATEST_RATE * dt
    return bool((is_rough | jumps) & is_number)


def _watch_dead_sensor(
    parameters: ConventionalParameters, state: FloatArray, base: int, speed: float, watches: bool,
    dt: float,
) -> None:  # fmt: skip
    """Decide between a locked wheel and a dead or frozen sensor, with clocks."""
    is_filled = state[base + PRESSURE] >= parameters.empty_pressure
    is_driven = state[base + DYNAMIC] >= parameters.dynamic_least_force
    is_braked = is_filled | is_driven
    turns = speed > parameters.dead_speed
    is_same = state[base + LAST_STEP] == 0.0
    frozen = choose(is_same & is_braked, state[base + FROZEN_CLOCK] + dt, 0.0)
    frozen = choose(turns, frozen, state[base + FROZEN_CLOCK])
    before = state[base + DEAD_CLOCK]
    turning = max(0.0, before - dt)
    turning = choose(frozen >= parameters.frozen_time, parameters.dead_time, turning)
    standing = choose(is_braked, before, min(parameters.dead_time, before + dt))
    clock = choose(turns, turning, standing)
    faulty = choose(clock <= 0.0, 0.0, state[base + IS_FAULTY])
    faulty = choose(clock >= parameters.dead_time, 1.0, faulty)
    state[base + FROZEN_CLOCK] = choose(watches, frozen, state[base + FROZEN_CLOCK])
    state[base + DEAD_CLOCK] = choose(watches, clock, before)
    state[base + IS_FAULTY] = choose(watches, faulty, state[base + IS_FAULTY])
