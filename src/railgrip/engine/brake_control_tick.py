"""Brake control in the batch: what it measures is gathered, its kernel called, its command obeyed.

It touches the plant in two numbers of each axle: FORCE_FACTOR multiplies what is asked of the axle,
dynamic brake first; PRESSURE_FACTOR multiplies the pressure for what friction has to give.
"""

from __future__ import annotations

from typing import Any

from railgrip.compiler import compiled, entry, inlined
from railgrip.control import brake_control_table as table
from railgrip.control import contract as ctl
from railgrip.control.brake_control import brake_control_kernel
from railgrip.control.disc_temperature import lagging_sensor
from railgrip.core.constants import GRAVITY
from railgrip.engine import layout as at

SETTLED = 2.0
"""Effort and adhesion are averaged from so long after the first brake command, s."""

_kernel = compiled(brake_control_kernel)
_sensor = inlined(lagging_sensor)


@compiled
def _gather(L: int, S: Any, memory: Any, plan: Any, n_axles: int, k: int) -> None:
    """Put what brake control of lane k sees into its table."""
    measured, seen = memory.brake_measured[k], memory.measured[k].T
    own = plan.brake_control
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L + k
        ring = S[b + at.RING_TEMPERATURE * L]
        reading = S[b + at.SENSED_TEMPERATURE * L]
        if own.sensor_lag > 0.0:
            reading = _sensor(reading, ring, own.sensor_lag, own.period)
        else:
            reading = ring
        S[b + at.SENSED_TEMPERATURE * L] = reading
        measured[axle, table.DISC_TEMPERATURE] = reading + S[b + at.TEMPERATURE_ERROR * L]
        measured[axle, table.WHEEL_SPEED] = seen[axle, ctl.WHEEL_SPEED]
        measured[axle, table.CYLINDER_PRESSURE] = S[b + at.CYLINDER_PRESSURE * L]
        measured[axle, table.DYNAMIC_FORCE] = S[b + at.DYNAMIC_FORCE * L]
        is_free = S[b + at.FRICTION_SHARE * L] >= 1.0 and S[b + at.IS_FILL * L] > 0.0
        measured[axle, table.IS_HELD] = 0.0 if is_free else 1.0
        tread = S[b + at.TREAD_PER_CLAMP * L] / S[b + at.BELIEVED_RATIO * L]
        measured[axle, table.BELIEVED_TREAD] = tread
        measured[axle, table.LEARNED_FRICTION] = S[b + at.LEARNED_FRICTION * L]
    deceleration = S[at.LAST_DECELERATION * L + k] * S[at.DECELERATION_SCALE * L + k]
    measured[0, table.DECELERATION] = deceleration + S[at.DECELERATION_OFFSET * L + k]
    measured[0, table.BRAKE_DEMAND] = S[at.DRIVER_DEMAND * L + k]
    measured[0, table.EMERGENCY] = S[at.EMERGENCY * L + k]
    measured[0, table.TRAIN_SPEED] = memory.command[k, ctl.REFERENCE_SPEED, 0]
    weight = S[at.TRAIN_MASS * L + k] * GRAVITY
    measured[0, table.GRADIENT] = S[at.GRADIENT_FORCE * L + k] / weight
    believed = S[at.POSITION * L + k] + S[at.POSITION_ERROR * L + k]
    measured[0, table.TO_GO] = own.stop_position - believed


@compiled
def _obey(L: int, S: Any, memory: Any, plan: Any, n_axles: int, k: int) -> None:
    """Take the command of lane k over, and note how much it had to correct."""
    command, period = memory.brake_command[k], plan.brake_control.period
    begun = S[at.BRAKE_TIME * L + k]
    now = S[at.TICK * L + k] * plan.timing.tick
    is_counted = begun >= 0.0 and now - begun >= SETTLED and S[at.STOP_TIME * L + k] < 0.0
    span = period if is_counted else 0.0
    correction = command[0, table.CORRECTION_OUT]
    S[at.BRAKE_CORRECTION * L + k] = correction
    S[at.EFFORT_SUM * L + k] += abs(correction) * span
    S[at.EFFORT_TIME * L + k] += span
    for axle in range(n_axles):
        b = (1 + axle) * at.N_VARS * L + k
        S[b + at.FORCE_FACTOR * L] = command[axle, table.FORCE_FACTOR]
        S[b + at.PRESSURE_FACTOR * L] = command[axle, table.PRESSURE_FACTOR]
        S[b + at.ESTIMATED_FRICTION * L] = command[axle, table.ESTIMATED_FRICTION]
        used = abs(S[b + at.CONTACT_FORCE * L]) / S[b + at.STATIC_LOAD * L]
        S[b + at.ADHESION_SUM * L] += used * span


@entry
def control_brakes(L: int, S: Any, memory: Any, plan: Any) -> None:
    """Let the brake control of every lane whose turn it is measure and command."""
    own = plan.brake_control
    n_axles = plan.formation.vehicle_of_axle.shape[0]
    for k in range(L):
        if S[at.RUN * L + k] < 0.0 or int(S[at.TICK * L + k]) % own.every != 0:
            continue
        _gather(L, S, memory, plan, n_axles, k)
        _kernel(
            own.parameters, own.rules, own.setup, memory.brake_state[k],
            memory.brake_measured[k], memory.brake_command[k], own.period,
        )  # fmt: skip
        _obey(L, S, memory, plan, n_axles, k)
