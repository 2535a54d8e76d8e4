"""Wheel rotation monitoring: says when an axle does not turn as it should.

It is independent of the wheel-slide protection: its own train speed, its own limits, its own state,
from the measured speeds alone. It commands nothing; it raises an alarm.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control.contract import WHEEL_SPEED, FloatArray


class RotationMonitoring(NamedTuple):
    """When wheel rotation monitoring raises an alarm, SI.

    Parameters
    ----------
    least_speed : float
        Train speed above which an axle is monitored, [m/s]; 50 km/h in TB/T 3009-2019 (as read in
        an abstract).
    deviation_constant, deviation_share : float
        An axle deviates when its speed differs from the train's by more than A + B·v: A [m/s], at
        most 50 km/h, and B, at most 0.3 (same source); the values here are illustrative.
    delay : float
        How long it may deviate, [s]; the alarm is due within 10 s (same source).
    greatest_deceleration : float
        How fast the believed train speed can fall, [m/s²] (illustrative).

    Examples
    --------
    >>> round(RotationMonitoring().least_speed * 3.6)
    50
    """

    least_speed: float = 50.0 / 3.6
    deviation_constant: float = 30.0 / 3.6
    deviation_share: float = 0.2
    delay: float = 8.0
    greatest_deceleration: float = 1.5


_place = RotationMonitoring._fields.index
LEAST_SPEED: Final = _place("least_speed")
DEVIATION_CONSTANT: Final = _place("deviation_constant")
DEVIATION_SHARE: Final = _place("deviation_share")
DELAY: Final = _place("delay")
GREATEST_DECELERATION: Final = _place("greatest_deceleration")

TRAIN_SPEED: Final = 0  # state: the train speed as the monitor believes it, m/s
FIRST_CLOCK: Final = 1  # state: from here one clock an axle, s

GREATEST_SPEED: Final = 200.0  # m/s: what reads more, or no number, is no turning wheel


def rotation_state_size(n_axles: int) -> int:
    """Return the length of the state array, which starts as zeros.

    Examples
    --------
    >>> rotation_state_size(16)
    17
    """
    return FIRST_CLOCK + n_axles


def rotation_monitoring(
    parameters: FloatArray, state: FloatArray, measured: FloatArray, alarm: FloatArray, dt: float
) -> None:
    """Advance wheel rotation monitoring by one period.

    Parameters
    ----------
    parameters : ndarray
        `RotationMonitoring` as an array.
    state : ndarray
        See `rotation_state_size`.
    measured : ndarray (axle, column)
        As in the controller contract; only the wheel speeds are read.
    alarm : ndarray (axle)
        Written: 1 while the axle has deviated for longer than the delay, else 0.
    dt : float
        Period, [s].

    Notes
    -----
    The train speed is the greatest wheel speed, which may fall no faster than the greatest
    deceleration. A clock runs while an axle deviates and the train is fast enough; it runs back
    while the axle turns as it should, so an alarm ends after as long a time of good rotation.

    Examples
    --------
    >>> import numpy as np
    >>> state, alarm = np.zeros(rotation_state_size(2)), np.zeros(2)
    >>> measured = np.array([[30.0, 0, 0, 0, 0], [0.0, 0, 0, 0, 0]])  # the second axle stands
    >>> for _ in range(900):
    ...     rotation_monitoring(np.array(RotationMonitoring()), state, measured, alarm, 0.01)
    >>> alarm.tolist()
    [0.0, 1.0]
    """
    n_axles = measured.shape[0]
    train_speed = state[TRAIN_SPEED] - parameters[GREATEST_DECELERATION] * dt
    for axle in range(n_axles):
        reading = abs(measured[axle, WHEEL_SPEED])
        if reading < GREATEST_SPEED:
            train_speed = max(train_speed, reading)
    state[TRAIN_SPEED] = max(0.0, train_speed)
    limit = parameters[DEVIATION_CONSTANT] + parameters[DEVIATION_SHARE] * train_speed
    for axle in range(n_axles):
        clock = state[FIRST_CLOCK + axle]
        turns = abs(abs(measured[axle, WHEEL_SPEED]) - train_speed) <= limit
        if turns:
            clock = max(0.0, clock - dt)
        elif train_speed > parameters[LEAST_SPEED]:
            clock = min(parameters[DELAY] + dt, clock + dt)
        state[FIRST_CLOCK + axle] = clock
        is_deviating = clock >= parameters[DELAY] or (alarm[axle] > 0.0 and clock > 0.0)
        alarm[axle] = 1.0 if is_deviating else 0.0
