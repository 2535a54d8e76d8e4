"""Wheel-diameter compensation: worn wheels turn faster, and must not look like the train."""

from __future__ import annotations

from railgrip.control.contract import (
    BRAKE_DEMAND,
    CYLINDER_PRESSURE,
    DYNAMIC_FORCE,
    WHEEL_SPEED,
    FloatArray,
)
from railgrip.control.conventional_parameters import (
    DIAMETER_BOUND,
    DIAMETER_LEAST_SPEED,
    DIAMETER_TIME,
    DYNAMIC_LEAST_FORCE,
    EMPTY_PRESSURE,
)
from railgrip.control.conventional_state import DIAMETER, IS_FAULTY, REFERENCE
from railgrip.control.state_layout import axle_base


def learn_diameters(
    parameters: FloatArray, state: FloatArray, measured: FloatArray, dt: float
) -> None:
    """Move each axle's factor towards the mean speed of all axles while the train coasts.

    Parameters
    ----------
    parameters, state, measured : ndarray
        As in the controller contract.
    dt : float
        Period, [s].

    Notes
    -----
    The factors are relative: what counts is that all axles agree, the error common to all only
    scales the reference speed. Nothing is learned while any brake works or below a speed, and an
    axle beyond the bound is left out, as it spins or its sensor fails. A controller does not see
    the tractive effort: motored axles that creep under traction bias their factor by that creep.
    """
    n_axles = measured.shape[0]
    total = 0.0
    n_valid = 0
    for axle in range(n_axles):
        pressure = measured[axle, CYLINDER_PRESSURE]
        is_braked = (
            measured[axle, BRAKE_DEMAND] > 0.0
            or not pressure < parameters[EMPTY_PRESSURE]
            or not measured[axle, DYNAMIC_FORCE] < parameters[DYNAMIC_LEAST_FORCE]
        )
        if is_braked:
            return
        speed = measured[axle, WHEEL_SPEED]
        if state[axle_base(axle) + IS_FAULTY] == 0.0 and speed > parameters[DIAMETER_LEAST_SPEED]:
            total += speed
            n_valid += 1
    if n_valid < 2 or state[REFERENCE] < parameters[DIAMETER_LEAST_SPEED]:
        return
    mean = total / n_valid
    blend = dt / parameters[DIAMETER_TIME]
    for axle in range(n_axles):
        speed = measured[axle, WHEEL_SPEED]
        if abs(speed - mean) < parameters[DIAMETER_BOUND] * mean:
            place = axle_base(axle) + DIAMETER
            state[place] += blend * (mean / speed - state[place])
