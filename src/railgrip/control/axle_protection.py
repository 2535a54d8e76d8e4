"""One axle under the conventional WSP: from its slip to its dump valve, dynamic brake and sand."""

from __future__ import annotations

from railgrip.control.contract import (
    ALARM,
    BRAKED,
    DUMP_VALVE,
    DYNAMIC_FORCE,
    DYNAMIC_SHARE,
    FILL,
    HOLD,
    IS_SLIDING,
    MOTORED,
    SANDING,
    VENT,
    FloatArray,
)
from railgrip.control.conventional_parameters import DYNAMIC_LEAST_FORCE, INHIBIT_SPEED
from railgrip.control.conventional_state import (
    ACCELERATION,
    DECELERATION,
    DIAMETER,
    FREED_AXLE,
    IS_FAULTY,
    REFERENCE,
    SAFETY_FILL,
    SLIDES,
    SPEED,
    axle_base,
)
from railgrip.control.dynamic_handover import hand_over
from railgrip.control.safety_timer import watch_release
from railgrip.control.sanding_request import request_sand
from railgrip.control.slip_band import note_slide, wish
from railgrip.control.stepped_filling import step_filling

ALARM_SENSOR = 1.0
ALARM_SAFETY_TIMER = 2.0
ALARM_DIAMETER = 3.0
NOTED_CORRECTION = 0.015
"""A wheel whose believed diameter was wrong by more than this share is reported."""


def axle_alarm(state: FloatArray, base: int) -> float:
    """Return what is wrong with an axle: 1 sensor, 2 safety timer, 3 wheel diameter; 0 nothing."""
    if state[base + IS_FAULTY] > 0.0:
        return ALARM_SENSOR
    if state[base + SAFETY_FILL] > 0.0:
        return ALARM_SAFETY_TIMER
    return ALARM_DIAMETER if abs(state[base + DIAMETER] - 1.0) > NOTED_CORRECTION else 0.0


def protect_axle(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    axle: int,
    lower: float,
    upper: float,
    dt: float,
) -> None:
    """Write the command of one axle.

    Parameters
    ----------
    parameters, axle_setup, state, measured, command : ndarray
        As in the controller contract.
    axle : int
        Row of the axle.
    lower, upper : float
        Slip speeds at the thresholds of the band, [m/s].
    dt : float
        Period, [s].
    """
    base = axle_base(axle)
    wished = FILL
    slip_speed = 0.0
    is_protected = state[base + IS_FAULTY] == 0.0 and state[REFERENCE] >= parameters[INHIBIT_SPEED]
    if is_protected:
        slip_speed = state[REFERENCE] - state[base + SPEED]
        relative = state[base + ACCELERATION] + state[DECELERATION]
        wished = wish(parameters, slip_speed, relative, lower, upper)
    note_slide(state, base, wished, slip_speed, lower, dt)
    if is_protected and state[FREED_AXLE] == axle + 1.0:
        wished = VENT
    must_fill = watch_release(
        parameters, state, base, measured, axle, command[axle, DUMP_VALVE], dt
    )
    if must_fill:
        wished = FILL
    valve = step_filling(parameters, state, base, wished, dt)
    if axle_setup[axle, MOTORED] > 0.0:
        force = measured[axle, DYNAMIC_FORCE]
        share = command[axle, DYNAMIC_SHARE]
        if valve == VENT and share > 0.0 and force > parameters[DYNAMIC_LEAST_FORCE]:
            valve = HOLD
        command[axle, DYNAMIC_SHARE] = hand_over(
            parameters, state, base, wished == VENT, force, share, dt
        )
    command[axle, DUMP_VALVE] = valve if axle_setup[axle, BRAKED] > 0.0 else FILL
    command[axle, SANDING] = request_sand(parameters, state, base, dt)
    command[axle, IS_SLIDING] = state[base + SLIDES]
    command[axle, ALARM] = axle_alarm(state, base)
