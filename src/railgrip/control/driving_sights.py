"""Speed of a driven train whose axles may all spin.

Wheels without a motor show it. Where there are none, it is reckoned from the forces that the rails
are observed to give, over the mass that the axles carry, and never above the slowest wheel, because
no driven wheel is slower than the train. What forces do not tell (gradient, resistance) is learned
from sights: now and then one axle is let run free until it turns with the train.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import DYNAMIC_FORCE, MOTORED, FloatArray
from railgrip.control.conventional_state import (
    ACCELERATION,
    DECELERATION,
    IS_FAULTY,
    REFERENCE,
    SLIDES,
    SPEED,
)
from railgrip.control.driving_reference import follow_trailing_wheels
from railgrip.control.state_layout import axle_base
from railgrip.control.traction_parameters import DOUBT_LONGEST, DOUBT_RATE, LOOK_LONGEST
from railgrip.control.traction_state import (
    DOUBT,
    EXPECTED_GAIN,
    FORCE,
    FREE_CLOCK,
    LAST_LOOK,
    LOAD,
    LOOK_TIME,
    LOOKING,
    N_SIGHTS,
    OFFSET,
    SEEN,
    SIGHT_AGE,
    SIGHT_SPEED,
)
from railgrip.core.constants import GRAVITY

FREE_FORCE: Final = 800.0  # N: with less a wheel turns with the train
STEADY: Final = 0.6  # m/s²: a wheel whose acceleration differs less from the train's has settled,
STEADY_AFTER: Final = 0.2  # s: when it has done so for so long
IMPLAUSIBLE: Final = 0.5  # m/s: a driven wheel so much slower than the train is a faulty signal
SIGHT_INTERVAL: Final = 1.0  # s: two sights so far apart teach the offset
SIGHT_WEIGHT: Final = 0.7  # how much of the error they show
GREATEST_OFFSET: Final = 0.5  # m/s²
SLOW: Final = 0.4  # m/s: slower wheels pass too few teeth to be compared with the forces
RISE_MARGIN: Final = 0.15  # m/s²: adhering wheels may gain so much more than the forces say
LESSON: Final = 1.0  # 1/s²: how fast the offset is learned from adhering wheels,
GREATEST_LESSON: Final = 0.05  # m/s: and what error counts at most
NEVER: Final = -1.0e9


def know_train_speed(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    dt: float,
) -> None:
    """Update reference speed, train acceleration and the axle that runs free, in the state.

    Parameters
    ----------
    parameters, axle_setup, state, measured : ndarray
        As in the controller contract; wheels have been read, forces observed.
    dt : float
        Period, [s].
    """
    n_axles = measured.shape[0]
    for axle in range(n_axles):
        if axle_setup[axle, MOTORED] == 0.0 and state[axle_base(axle) + IS_FAULTY] == 0.0:
            follow_trailing_wheels(parameters, axle_setup, state, n_axles, dt)
            return
    _reckon(state, measured, n_axles, dt)
    _let_run_free(parameters, state, n_axles, dt)


def _reckon(state: FloatArray, measured: FloatArray, n_axles: int, dt: float) -> None:
    """Advance the reference speed by the forces, bound it by the wheels, correct it by a sight."""
    force = load = 0.0
    slowest, second = 1.0e9, 1.0e9
    seen = -1.0
    is_any_spinning = False
    for axle in range(n_axles):
        base = axle_base(axle)
        load += state[base + LOAD]
        force += state[base + FORCE]
        if state[base + IS_FAULTY] > 0.0:
            continue
        speed = state[base + SPEED]
        is_any_spinning = is_any_spinning or state[base + SLIDES] > 0.0
        if speed < slowest:
            second = slowest
            slowest = speed
        else:
            second = min(second, speed)
        clock = state[base + FREE_CLOCK] + dt
        is_unsteady = abs(state[base + ACCELERATION] + state[DECELERATION]) > STEADY
        if abs(measured[axle, DYNAMIC_FORCE]) > FREE_FORCE or is_unsteady:
            clock = 0.0
        state[base + FREE_CLOCK] = clock
        if clock > STEADY_AFTER:
            seen = speed if seen < 0.0 else min(seen, speed)
    acceleration = state[OFFSET]
    if load > 0.0:
        acceleration += force * GRAVITY / load
    before = state[REFERENCE]
    reference = before + acceleration * dt
    # one slow signal alone may be a faulty one
    bound = slowest if slowest > before - IMPLAUSIBLE or second > 1.0e8 else second
    if not is_any_spinning and bound < 1.0e8:
        reference = _follow(state, reference, bound, dt)
    else:
        reference = min(reference, bound)
        state[EXPECTED_GAIN] += acceleration * dt
        state[SIGHT_AGE] += dt
        if seen >= 0.0:
            reference = seen
            _learn(state, seen)
    state[SEEN] = seen
    state[DECELERATION] = -acceleration
    state[REFERENCE] = max(0.0, reference)


def _follow(state: FloatArray, reckoned: float, slowest: float, dt: float) -> float:
    """Return the speed of wheels that adhere; they rise no faster than the forces say."""
    error = slowest - reckoned
    if reckoned > SLOW:
        step = max(-GREATEST_LESSON, min(GREATEST_LESSON, error))
        offset = state[OFFSET] + LESSON * step * dt
        state[OFFSET] = max(-GREATEST_OFFSET, min(GREATEST_OFFSET, offset))
        error = min(error, RISE_MARGIN * dt)
    # what adhering wheels show may already be the begin of a spin: it teaches nothing at a sight
    state[SIGHT_AGE] = NEVER
    state[EXPECTED_GAIN] = 0.0
    state[DOUBT] = 0.0
    return reckoned + error


def _learn(state: FloatArray, seen: float) -> None:
    """Correct the offset by the true gain of speed since the last sight, and begin anew."""
    age = state[SIGHT_AGE]
    if age > SIGHT_INTERVAL:
        error = (seen - state[SIGHT_SPEED] - state[EXPECTED_GAIN]) / age
        offset = state[OFFSET] + SIGHT_WEIGHT * error
        state[OFFSET] = max(-GREATEST_OFFSET, min(GREATEST_OFFSET, offset))
        state[N_SIGHTS] += 1.0
    state[SIGHT_SPEED] = seen
    state[SIGHT_AGE] = 0.0
    state[EXPECTED_GAIN] = 0.0
    state[DOUBT] = 0.0


def _let_run_free(parameters: FloatArray, state: FloatArray, n_axles: int, dt: float) -> None:
    """Decide which axle, if any, runs free to show the train's speed; they take turns."""
    if state[LOOKING] > 0.0:
        state[LOOK_TIME] += dt
        if state[SEEN] >= 0.0 or state[LOOK_TIME] > parameters[LOOK_LONGEST]:
            state[LOOKING] = 0.0
            state[DOUBT] = 0.0
        return
    # the offset is better known after every sight
    rate = parameters[DOUBT_RATE] / (1.0 + min(state[N_SIGHTS], 4.0))
    state[DOUBT] += rate * dt
    if state[DOUBT] <= parameters[DOUBT_LONGEST]:
        return
    axle = int(state[LAST_LOOK])
    for _ in range(n_axles):
        axle = axle + 1 if axle + 1 < n_axles else 0
        base = axle_base(axle)
        if state[base + IS_FAULTY] == 0.0 and state[base + SLIDES] > 0.0:
            state[LOOKING] = 1.0 + axle
            state[LAST_LOOK] = float(axle)
            state[LOOK_TIME] = 0.0
            return
