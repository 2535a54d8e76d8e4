"""Wheels that show the train outvote one that turns faster: nothing braked can.

The reference speed is never below the fastest believable wheel, so a sensor that reads some per
cent too fast leads it, and all other brakes are released. But released wheels soon turn with the
train. Two of them that agree show its speed beyond doubt. A leader that is a little too fast has a
wheel smaller than believed, and its factor is corrected; one that is much too fast has a fault.

Known wrong when: a wheel is faster than the train because its motor drives it; nothing is judged
then. Two released wheels that creep back equally slowly, on rail that gives next to nothing, would
be believed too early.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import BRAKE_DEMAND, FloatArray
from railgrip.control.conventional_parameters import DEAD_TIME
from railgrip.control.conventional_state import (
    CORRECTIONS,
    DEAD_CLOCK,
    DIAMETER,
    HAS_LED,
    IS_FAULTY,
    LEAD_CLOCK,
    READING,
    SPEED,
    SPEED_LAG,
    VOTE_CLOCK,
)
from railgrip.control.state_layout import axle_base
from railgrip.control.wheel_speed import GREATEST_SPEED

AGREE_SHARE: Final = 0.005
AGREE_FLOOR: Final = 0.1
"""Speeds that differ by no more than this share, or this, m/s, agree."""
VOTES_AFTER: Final = 0.25
"""An unbraked wheel that has mostly not gained for so long, s, may vote."""
VOTES_AT_MOST: Final = 0.5
"""Its clock goes no further, s, so that a wheel that gains after all soon loses its vote."""
MOST_CORRECTIONS: Final = 2
"""A wheel that leads again after so many is no worn one: its sensor drifts, or hides its slide."""
DROPPED_VENT: Final = 2.0
"""Whoever drops a leader does not know how deep it slides, and lets it turn free for so long, s."""
OUTVOTED_AFTER: Final = 0.3
"""A wheel that has led so long, s, is corrected, or not believed until the brake is released."""
GREATEST_CORRECTION: Final = 0.1
"""Of a wheel's factor: from new to worn out a diameter loses 8 to 10 %."""


def outvote_leader(state: FloatArray, measured: FloatArray, leader: int, dt: float) -> float:
    """Count how long the fastest wheel has contradicted two settled ones, and drop it in the end.

    Parameters
    ----------
    state, measured : ndarray
        As in the controller contract.
    leader : int
        The fastest axle.
    dt : float
        Period, [s].

    Returns
    -------
    float
        The train's speed as the voters see it, in the period in which they drop the leader; else
        -1, [m/s].
    """
    best = -1.0
    second = -1.0
    for axle in range(measured.shape[0]):
        base = axle_base(axle)
        is_voter = (
            axle != leader
            and state[base + IS_FAULTY] == 0.0
            and state[base + VOTE_CLOCK] > VOTES_AFTER
        )
        speed = state[base + SPEED] if is_voter else -1.0
        second = max(second, min(best, speed))
        best = max(best, speed)
    apart = max(AGREE_FLOOR, AGREE_SHARE * best)
    base = axle_base(leader)
    leads = second > apart and best - second < apart and state[base + SPEED] - best > apart
    if leads and measured[leader, BRAKE_DEMAND] > 0.0:
        state[HAS_LED] = 1.0
        state[base + LEAD_CLOCK] += dt
        if state[base + LEAD_CLOCK] > OUTVOTED_AFTER:
            # it may slide a little itself, so a little more than it shows
            _correct_or_drop(state, base, (1.0 - AGREE_SHARE) * best / state[base + SPEED])
            return best
    return -1.0


def keep_dropped(
    parameters: FloatArray, state: FloatArray, n_axles: int, is_braking: bool, dt: float
) -> None:
    """Let axles that other wheels have outvoted stay so until the brake is released."""
    for axle in range(n_axles):
        base = axle_base(axle)
        if abs(state[base + READING]) < GREATEST_SPEED:
            clock = state[base + LEAD_CLOCK] if is_braking else 0.0
            if clock > OUTVOTED_AFTER:
                clock += dt
                state[base + IS_FAULTY] = 1.0
                state[base + DEAD_CLOCK] = parameters[DEAD_TIME]
            state[base + LEAD_CLOCK] = clock
            if not is_braking:
                state[base + CORRECTIONS] = 0.0


def _correct_or_drop(state: FloatArray, base: int, ratio: float) -> None:
    factor = state[base + DIAMETER] * ratio
    state[base + CORRECTIONS] += 1.0
    if factor < 1.0 - GREATEST_CORRECTION or state[base + CORRECTIONS] > MOST_CORRECTIONS:
        state[base + IS_FAULTY] = 1.0
        return
    state[base + DIAMETER] = factor
    state[base + SPEED] *= ratio
    state[base + SPEED_LAG] *= ratio
    state[base + LEAD_CLOCK] = 0.0


def runs_free(state: FloatArray, base: int) -> bool:
    """Return whether an axle has just been dropped."""
    return bool(OUTVOTED_AFTER < state[base + LEAD_CLOCK] < OUTVOTED_AFTER + DROPPED_VENT)
