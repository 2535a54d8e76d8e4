"""Reference speed of the train, from wheels that slide: the wheels as force gauges.

The plain rule lets the reference speed fall no faster than a fixed or a self-measured slope. A
fixed slope locks wheels on very low adhesion; a slope measured on the reference speed itself feeds
on its own error, and follows too late when a slide ends on better rail.

A braked wheel says more. What its brake takes and its own inertia does not supply must come from
the rail, sliding or not. So the deceleration of the train follows from brake cylinder pressures,
dynamic brake forces and wheel accelerations; the gain from pressure to deceleration is learned in
the same stop, before the first slide. The reference speed is dead reckoning on that deceleration,
never lower than the fastest wheel, and is seen anew on every wheel that adheres or runs free. If
none has done so for long, one axle is let run free until it turns with the train.

Known wrong when: pad friction changes faster than wheels are seen; all axles lock at once.
"""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import (
    DECELERATION_PER_PRESSURE,
    DRIFT_FLOOR,
    DRIFT_RATE,
    DRIFT_SHARE,
    FREE_LONGEST,
    INHIBIT_SPEED,
    REFERENCE_MARGIN,
    REFERENCE_RISE,
    ROTATING_SHARE,
    SLIP_LOWER,
    SLOPE_FILTER,
)
from railgrip.control.conventional_state import (
    DECELERATION,
    DRIFT,
    EFFORT_LAG,
    EXPECTED_FALL,
    FASTEST_LAG,
    FREED_AXLE,
    FREED_TIME,
    OFFSET,
    PRESSURE_GAIN,
    REFERENCE,
    SEEN_SPEED,
    SEEN_TIME,
)

GREATEST_OFFSET = 0.5  # m/s²: a gradient of 50 ‰
GREATEST_DECELERATION = 3.0  # m/s²: beyond any wheel-rail brake
LEARNING_PRESSURE = 4.0e4  # Pa: below it the springs of the rigging decide
LEARNING_TIME = 0.3  # s
SURPRISE_SHARE = 0.2  # of the estimate: a fastest wheel that falls otherwise by more than this
SURPRISE = 0.2  # and so much more, m/s², slides or comes back: nothing is learned from it
LEAST_GAIN_SHARE = 0.5  # of the first guess
GREATEST_GAIN_SHARE = 2.0
SIGHT_INTERVAL = 1.5  # s: two sights of the train speed so far apart give a deceleration
SIGHT_WEIGHT = 0.5  # how much of its error goes into the offset


def estimate_deceleration(
    parameters: FloatArray, state: FloatArray, effort: float, mean_acceleration: float
) -> None:
    """Update the train's deceleration in the state from what brakes and wheels show.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    effort : float
        Mean braking pressure over all axles, dynamic brake included, [Pa].
    mean_acceleration : float
        Mean acceleration of the wheels at the tread, [m/s²].

    Notes
    -----
    Train M, rotating mass of all wheels ρ(M + m_rot), brake forces F_b, wheel accelerations ẇ:
    the rail gives F = F_b + m_rot ẇ, and the train decelerates with D = F/M. While all wheels
    adhere, ẇ = -D and D = κ·effort + offset; so, sliding or not,
    D = (κ·effort + offset + ρ·mean(ẇ)) / (1 - ρ).
    """
    share = parameters[ROTATING_SHARE]
    deceleration = (state[PRESSURE_GAIN] * effort + state[OFFSET] + share * mean_acceleration) / (
        1.0 - share
    )
    state[DECELERATION] = max(-GREATEST_OFFSET, min(GREATEST_DECELERATION, deceleration))


def learn_pressure_gain(
    parameters: FloatArray,
    state: FloatArray,
    effort: float,
    fastest: float,
    is_adhering: bool,
    dt: float,
) -> None:
    """Learn gain and offset of the deceleration while all wheels adhere.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    effort : float
        Mean braking pressure over all axles, [Pa].
    fastest : float
        Greatest believable wheel speed, [m/s].
    is_adhering : bool
        Whether no wheel is known to slide.
    dt : float
        Period, [s].
    """
    blend = dt / (parameters[SLOPE_FILTER] + dt)
    state[FASTEST_LAG] += blend * (fastest - state[FASTEST_LAG])
    state[EFFORT_LAG] += blend * (effort - state[EFFORT_LAG])
    slope = (state[FASTEST_LAG] - fastest) / parameters[SLOPE_FILTER]
    expected = state[PRESSURE_GAIN] * state[EFFORT_LAG] + state[OFFSET]
    if not is_adhering or abs(slope - expected) > SURPRISE_SHARE * expected + SURPRISE:
        return
    learning = dt / LEARNING_TIME
    if state[EFFORT_LAG] > LEARNING_PRESSURE:
        guess = parameters[DECELERATION_PER_PRESSURE]
        gain = state[PRESSURE_GAIN]
        gain += learning * ((slope - state[OFFSET]) / state[EFFORT_LAG] - gain)
        state[PRESSURE_GAIN] = max(LEAST_GAIN_SHARE * guess, min(GREATEST_GAIN_SHARE * guess, gain))
    elif effort <= 0.0:
        offset = state[OFFSET] + learning * (slope - state[OFFSET])
        state[OFFSET] = max(-GREATEST_OFFSET, min(GREATEST_OFFSET, offset))


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


def free_an_axle(
    parameters: FloatArray,
    state: FloatArray,
    candidate: int,
    is_witnessed: bool,
    dt: float,
) -> None:
    """Decide which axle, if any, runs free to show the train's speed.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    candidate : int
        The fastest axle that can be released; -1 for none.
    is_witnessed : bool
        Whether enough axles adhere for the reference speed to be trusted.
    dt : float
        Period, [s].
    """
    reference = state[REFERENCE]
    if is_witnessed:
        state[DRIFT] = 0.0
    else:
        state[DRIFT] += parameters[DRIFT_RATE] * dt
    if state[FREED_AXLE] > 0.0:
        state[FREED_TIME] += dt
        # A sight resets the drift, so does adhesion come back.
        is_over = state[DRIFT] <= 0.0 or state[FREED_TIME] > parameters[FREE_LONGEST]
        if is_over or reference < parameters[INHIBIT_SPEED]:
            state[FREED_AXLE] = 0.0
            state[DRIFT] = 0.0
        return
    trusted = max(
        parameters[DRIFT_FLOOR], parameters[DRIFT_SHARE] * parameters[SLIP_LOWER] * reference
    )
    if state[DRIFT] > trusted and candidate >= 0 and reference > parameters[INHIBIT_SPEED]:
        state[FREED_AXLE] = 1.0 + candidate
        state[FREED_TIME] = 0.0
