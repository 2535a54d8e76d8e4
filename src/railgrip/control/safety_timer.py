"""Safety timer: an axle kept from filling for too long gets its brake back."""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import CYLINDER_PRESSURE, FILL, VENT, FloatArray
from railgrip.control.conventional_parameters import EMPTY_PRESSURE, SAFETY_TIME, SETTLE_TIME
from railgrip.control.conventional_state import ACCELERATION, ADHERED_CLOCK, KEPT_CLOCK, SAFETY_FILL

GAINING_ACCELERATION: Final = 0.3
"""A wheel that turns faster by so much, m/s², is on its way back: the timer waits."""

ALIVE_ACCELERATION: Final = -2.0
"""A wheel that slows by so much, m/s², under the returning brake is no false signal."""


def watch_release(
    parameters: FloatArray,
    state: FloatArray,
    base: int,
    measured: FloatArray,
    axle: int,
    valve_before: float,
    dt: float,
) -> bool:
    """Update the timer and return whether the axle must fill.

    Parameters
    ----------
    parameters, state, measured : ndarray
        As in the controller contract.
    base : int
        Where the axle's block begins in the state.
    axle : int
        Row of the axle.
    valve_before : float
        The dump valve as commanded since the last tick.
    dt : float
        Period, [s].

    Notes
    -----
    A released wheel that does not turn faster for ten seconds is more likely a false signal than a
    slide, so its brake fills. If the wheel answers to the brake, the signal was true after all and
    the axle goes back under protection; a dead signal does not answer, and the brake stays on.
    Ten seconds are usual in the trade, not read in a standard.
    """
    acceleration = state[base + ACCELERATION]
    if state[base + SAFETY_FILL] > 0.0:
        has_settled = state[base + ADHERED_CLOCK] > parameters[SETTLE_TIME]
        if acceleration < ALIVE_ACCELERATION or has_settled:
            state[base + SAFETY_FILL] = 0.0
            state[base + KEPT_CLOCK] = 0.0
            return False
        return True
    is_released = (
        valve_before == VENT or measured[axle, CYLINDER_PRESSURE] < parameters[EMPTY_PRESSURE]
    )
    if valve_before == FILL:
        state[base + KEPT_CLOCK] = 0.0
    elif is_released and acceleration < GAINING_ACCELERATION:
        state[base + KEPT_CLOCK] += dt
        if state[base + KEPT_CLOCK] > parameters[SAFETY_TIME]:
            state[base + SAFETY_FILL] = 1.0
            return True
    return False
