"""Reference speed of the train, while every wheel may slide.

The plain rule lets the reference speed fall no faster than a fixed or a self-measured slope. A
fixed slope locks wheels on very low adhesion; a slope measured on the reference speed itself feeds
on its own error, and follows too late when a slide ends on better rail.

Here it is dead reckoning on the deceleration that the wheels show (`deceleration_estimate`), never
lower than the fastest wheel, and it is seen anew on every wheel that runs free (`free_axle`).

Known wrong when: all axles lock at once.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import REFERENCE_MARGIN, REFERENCE_RISE
from railgrip.control.conventional_state import (
    DECELERATION,
    DRIFT,
    EXPECTED_FALL,
    OFFSET,
    REFERENCE,
    SEEN_SPEED,
    SEEN_TIME,
)
from railgrip.control.deceleration_estimate import GREATEST_OFFSET

SIGHT_INTERVAL: Final = 1.5  # s: two sights of the train speed so far apart give a deceleration
SIGHT_WEIGHT: Final = 0.5  # how much of its error goes into the offset


def advance_reference(
    parameters: FloatArray, state: FloatArray, fastest: float, seen: float, dt: float
) -> None:
    """Update the reference speed in the state.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    fastest : float
        Greatest believable wheel speed, [m/s]; 0 where there is none.
    seen : float
        Train speed seen on a free wheel, [m/s]; negative where there is none.
    dt : float
        Period, [s].
    """
    reference = state[REFERENCE]
    fall = state[DECELERATION] * dt
    state[EXPECTED_FALL] += fall
    state[SEEN_TIME] += dt
    if seen >= 0.0:
        _use_sight(state, seen)
        state[REFERENCE] = seen
        return
    # Never up: a falling train on a gradient shows on its wheels, a wrong estimate does not.
    fallen = reference - max(0.0, fall + parameters[REFERENCE_MARGIN] * dt)
    risen = reference + parameters[REFERENCE_RISE] * dt
    state[REFERENCE] = max(0.0, max(fallen, min(fastest, risen)))


def _use_sight(state: FloatArray, seen: float) -> None:
    """Correct the offset by the true fall since the last sight, and begin anew."""
    if state[SEEN_TIME] > SIGHT_INTERVAL:
        error = (state[SEEN_SPEED] - seen - state[EXPECTED_FALL]) / state[SEEN_TIME]
        offset = state[OFFSET] + SIGHT_WEIGHT * error
        state[OFFSET] = max(-GREATEST_OFFSET, min(GREATEST_OFFSET, offset))
    state[SEEN_SPEED] = seen
    state[SEEN_TIME] = 0.0
    state[EXPECTED_FALL] = 0.0
    state[DRIFT] = 0.0
