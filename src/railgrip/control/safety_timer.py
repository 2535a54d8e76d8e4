"""Safety timer: an axle kept from filling for too long gets its brake back."""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import FILL, VENT, FloatArray
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_state import (
    ACCELERATION,
    ADHERED_CLOCK,
    KEPT_CLOCK,
    PRESSURE,
    SAFETY_FILL,
)
from railgrip.core.formulas.choosing import choose

GAINING_ACCELERATION: Final = 0.3
"""A wheel that turns faster by so much, m/s², is on its way back: the timer waits."""

ALIVE_ACCELERATION: Final = -2.0
"""A wheel that slows by so much, m/s², under the returning brake is no false signal."""


def watch_release(
    parameters: ConventionalParameters,
    state: FloatArray,
    base: int,
    valve_before: float,
    dt: float,
) -> bool:
    """Update the timer and return whether the axle must fill.

    Parameters
    ----------
    parameters : ConventionalParameters
        By name.
    state : ndarray
        As in the controller contract.
    base : int
        Where the axle's values begin.
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
    was_filling = state[base + SAFETY_FILL] > 0.0
    has_settled = state[base + ADHERED_CLOCK] > parameters.settle_time
    is_alive = (acceleration < ALIVE_ACCELERATION) | has_settled
    is_empty = state[base + PRESSURE] < parameters.empty_pressure
    is_released = (valve_before == VENT) | is_empty
    fills = valve_before == FILL
    counts = is_released & (acceleration < GAINING_ACCELERATION) & (not fills)
    kept = state[base + KEPT_CLOCK]
    clock = choose(counts, kept + dt, kept)
    clock = choose(fills, 0.0, clock)
    runs_out = counts & (clock > parameters.safety_time)
    must_fill = (was_filling & (not is_alive)) | ((not was_filling) & runs_out)
    after_filling = choose(is_alive, 0.0, kept)
    state[base + KEPT_CLOCK] = choose(was_filling, after_filling, clock)
    state[base + SAFETY_FILL] = choose(must_fill, 1.0, 0.0)
    return bool(must_fill)
