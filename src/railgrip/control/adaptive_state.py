"""What the adaptive protection remembers beside the ordinary WSP and the ranges.

Behind them in the flat state array: first the system's values, then one block an axle.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.slip_ranges import ranged_state_size

# The system.
STATE: Final = 0  # number of the state, 301 … 314
TEST_CLOCK: Final = 1  # time of the running test, or of the pause before it, s
TEST_NUMBER: Final = 2  # tests begun so far
HAS_PASSED: Final = 3  # 1 when the last test found sliding useful (310)
N_MACRO: Final = 4  # axles in macro-slip that count: with an F0, braked, settled
N_MICRO: Final = 5  # the same in micro-slip
MACRO_FORCE: Final = 6  # sum of FB over those in macro-slip (Fm_mac)
MICRO_FORCE: Final = 7  # sum of FB over those in micro-slip (Fm_mic)
MACRO_F0: Final = 8  # sum of F0 over those in macro-slip
MACRO_SLID: Final = 9  # sum of slid distance over those in macro-slip, m
LEADER_FORCE: Final = 10  # FB of the first leading test axle; 0 while it does not count
FOLLOWER_FORCE: Final = 11  # FB of the last leading test axle; 0 while it does not count
LEADER_SLID: Final = 12  # slid distance of the first leading test axle, m
WAITED: Final = 13  # control periods since the supervisor last looked
IS_DECIDED: Final = 14  # 1 once 306 has been asked: before, 301 starts in `start`
N_SYSTEM: Final = 15

# Each axle; forces in the unit of the signal.
FORCE: Final = 0  # through the short filter
F0: Final = 1  # at the last breakaway; 0 before the first
MEAN: Final = 2  # FB, the mean force in the present range
SLID: Final = 3  # slid distance sRB since it last began anew, m
RANGE_CLOCK: Final = 4  # time in the present range, s
IS_ARMED: Final = 5  # 1 while adhering: the next breakaway gives an F0
FACTOR: Final = 6  # scale of the signal
TESTED_AT: Final = 7  # number of its last test; 0 for never
IS_TESTED: Final = 8  # 1 in a test phase
IS_LEAD: Final = 9  # 1 for a leading test axle
N_AXLE: Final = 10


def system_place(n_axles: int) -> int:
    """Return where the system's values begin.

    Examples
    --------
    >>> system_place(16)
    396
    """
    return ranged_state_size(n_axles)


def axle_place(axle: int, n_axles: int) -> int:
    """Return where the block of an axle begins.

    Examples
    --------
    >>> axle_place(1, 16)
    421
    """
    return ranged_state_size(n_axles) + N_SYSTEM + axle * N_AXLE


def adaptive_state_size(n_axles: int) -> int:
    """Return the length of the state array.

    Examples
    --------
    >>> adaptive_state_size(16)
    571
    """
    return axle_place(n_axles, n_axles)
