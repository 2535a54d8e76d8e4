"""From the sensor to a wheel speed that can be believed, with its acceleration.

Known wrong when: a sensor reads too fast by a few per cent. Such an axle leads the reference
speed; the safety timer then limits the harm to the other axles.
"""

from __future__ import annotations

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
    REFERENCE,
    SPEED,
    SPEED_LAG,
)

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
    reference speed up and all other brakes released.
    """
    reading = measured[axle, WHEEL_SPEED]
    if not -GREATEST_SPEED < reading < GREATEST_SPEED:
        state[base + IS_FAULTY] = 1.0
        state[base + DEAD_CLOCK] = parameters[DEAD_TIME]
        return
    speed = abs(reading) * state[base + DIAMETER]
    if state[REFERENCE] > parameters[DEAD_REFERENCE]:
        _watch_dead_sensor(parameters, state, base, measured, axle, speed, dt)
    blend = dt / (parameters[ACCELERATION_FILTER] + dt)
    lag = state[base + SPEED_LAG]
    lag += blend * (speed - lag)
    state[base + SPEED] = speed
    state[base + SPEED_LAG] = lag
    state[base + ACCELERATION] = (speed - lag) / parameters[ACCELERATION_FILTER]


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
    reading = measured[axle, WHEEL_SPEED]
    is_same = reading == state[base + LAST_READING]
    state[base + LAST_READING] = reading
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
