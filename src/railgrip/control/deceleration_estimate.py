"""Deceleration of the train from its wheels, sliding or not: each wheel is a force gauge.

What a brake takes and the wheel's inertia does not supply must come from the rail. So brake
cylinder pressures, dynamic brake forces and wheel accelerations tell how the train decelerates. The
gain from pressure to deceleration is learned in the same stop, before the first slide.

Known wrong when: pad friction changes faster than the train's speed is seen on a free wheel.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import (
    DECELERATION_PER_PRESSURE,
    ROTATING_SHARE,
    SLOPE_FILTER,
)
from railgrip.control.conventional_state import (
    DECELERATION,
    EFFORT_LAG,
    FASTEST_LAG,
    OFFSET,
    PRESSURE_GAIN,
)

GREATEST_OFFSET: Final = 0.5  # m/s²: a gradient of 50 ‰
GREATEST_DECELERATION: Final = 3.0  # m/s²: beyond any wheel-rail brake
LEARNING_PRESSURE: Final = 4.0e4  # Pa: below it the springs of the rigging decide
LEARNING_TIME: Final = 0.3  # s
SURPRISE_SHARE: Final = 0.2  # of the estimate: a fastest wheel that falls otherwise by more than
SURPRISE: Final = 0.2  # this and so much more, m/s², slides or comes back: nothing is learned
LEAST_GAIN_SHARE: Final = 0.5  # of the first guess
GREATEST_GAIN_SHARE: Final = 2.0


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

    Checked by
    ----------
    tests/unit/control/test_reference_speed.py: Newton's law on train and wheels.

    Examples
    --------
    Wheels that slide and lose 5 m/s² at 3 bar: the rail gives less than the brakes take.

    >>> import numpy as np
    >>> from railgrip.control.conventional_parameters import ConventionalParameters
    >>> state = np.zeros(12)
    >>> state[PRESSURE_GAIN] = 4e-6
    >>> estimate_deceleration(ConventionalParameters(), state, 3e5, -5.0)
    >>> round(float(state[DECELERATION]), 2)
    0.78
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
