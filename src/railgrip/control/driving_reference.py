"""Speed of the train while it is driven: wheels without a motor show it."""

from __future__ import annotations

from railgrip.control.contract import BRAKE_DEMAND, DRIVE_DEMAND, MOTORED, FloatArray
from railgrip.control.conventional_parameters import REFERENCE_RISE
from railgrip.control.conventional_state import (
    DECELERATION,
    DRIFT,
    EXPECTED_FALL,
    FASTEST_LAG,
    FREED_AXLE,
    IS_FAULTY,
    REFERENCE,
    SEEN_SPEED,
    SEEN_TIME,
    SPEED,
)
from railgrip.control.state_layout import axle_base

SLOPE_FILTER = 0.3
"""Time constant of the train's acceleration, s."""
ENOUGH = 3
"""From so many trailing wheels on, the second fastest is believed: one may be wrong either way."""


def follow_trailing_wheels(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, n_axles: int, dt: float
) -> None:
    """Update the reference speed in the state; the wheels have been read.

    Parameters
    ----------
    parameters, axle_setup, state : ndarray
        As in the controller contract.
    n_axles : int
        Number of axles.
    dt : float
        Period, [s].

    Notes
    -----
    With trailing wheels the second fastest of them (of one or two the fastest): a dead sensor, or
    one that reads too much, does no harm. With motors on all axles the slowest wheel, which must
    not rise faster than `reference_rise`.
    """
    fastest, second, slowest = 0.0, 0.0, 1.0e9
    n_trailing = 0
    for axle in range(n_axles):
        base = axle_base(axle)
        if state[base + IS_FAULTY] > 0.0:
            continue
        speed = state[base + SPEED]
        slowest = min(slowest, speed)
        if axle_setup[axle, MOTORED] == 0.0:
            n_trailing += 1
            second = max(second, min(fastest, speed))
            fastest = max(fastest, speed)
    before = state[REFERENCE]
    if n_trailing > 0:
        reference = second if n_trailing >= ENOUGH else fastest
    elif slowest < 1.0e9:
        reference = min(slowest, before + parameters[REFERENCE_RISE] * dt)
    else:
        reference = before
    blend = dt / (SLOPE_FILTER + dt)
    lag = state[FASTEST_LAG] + blend * (reference - state[FASTEST_LAG])
    state[FASTEST_LAG] = lag
    state[DECELERATION] = (lag - reference) / SLOPE_FILTER
    state[REFERENCE] = reference
    state[SEEN_SPEED] = reference
    state[SEEN_TIME] = 0.0
    state[EXPECTED_FALL] = 0.0
    state[DRIFT] = 0.0
    state[FREED_AXLE] = 0.0


def is_driving(measured: FloatArray) -> bool:
    """Return whether the motors are asked, and the brake is not."""
    return bool(measured[0, DRIVE_DEMAND] > 0.0 and measured[0, BRAKE_DEMAND] <= 0.0)
