"""What is wrong with an axle."""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_state import DIAMETER, IS_FAULTY, SAFETY_FILL
from railgrip.core.formulas.choosing import choose

ALARM_SENSOR = 1.0
ALARM_SAFETY_TIMER = 2.0
ALARM_DIAMETER = 3.0
NOTED_CORRECTION = 0.015
"""A wheel whose believed diameter was wrong by more than this share is reported."""


def axle_alarm(state: FloatArray, base: int) -> float:
    """Return what is wrong with an axle: 1 sensor, 2 safety timer, 3 wheel diameter; 0 nothing."""
    alarm = choose(abs(state[base + DIAMETER] - 1.0) > NOTED_CORRECTION, ALARM_DIAMETER, 0.0)
    alarm = choose(state[base + SAFETY_FILL] > 0.0, ALARM_SAFETY_TIMER, alarm)
    return choose(state[base + IS_FAULTY] > 0.0, ALARM_SENSOR, alarm)
