"""What the adaptive supervisor remembers: its places in the state array (`state_layout`)."""

from __future__ import annotations

from typing import Final

from railgrip.control.state_layout import GROUP, OF_SUPERVISOR, SCRATCH, SYSTEM

# The system.
STATE: Final = SYSTEM + 0  # number of the state, 301 … 314
TEST_CLOCK: Final = SYSTEM + 1  # time of the running test, or of the pause before it, s
TEST_NUMBER: Final = SYSTEM + 2  # tests begun so far
HAS_PASSED: Final = SYSTEM + 3  # 1 when the last test found sliding useful (310)
N_MACRO: Final = SYSTEM + 4  # axles in macro-slip that count: with an F0, braked, settled
N_MICRO: Final = SYSTEM + 5  # the same in micro-slip
# These four only where the rule asks for them:
MACRO_FORCE: Final = SYSTEM + 6  # sum of FB over those in macro-slip (Fm_mac)
MICRO_FORCE: Final = SYSTEM + 7  # sum of FB over those in micro-slip (Fm_mic)
MACRO_F0: Final = SYSTEM + 8  # sum of F0 over those in macro-slip
MACRO_SLID: Final = SYSTEM + 9  # sum of slid distance over those in macro-slip, m
LEADER_FORCE: Final = SYSTEM + 10  # FB of the first leading test axle; 0 while it does not count
FOLLOWER_FORCE: Final = SYSTEM + 11  # FB of the last leading test axle; 0 while it does not count
LEADER_SLID: Final = SYSTEM + 12  # slid distance of the first leading test axle, m
WAITED: Final = SYSTEM + 13  # control periods since the supervisor last looked
IS_DECIDED: Final = SYSTEM + 14  # 1 once 306 has been asked: before, 301 starts in `start`
NEEDED_ACCURACY: Final = (
    SYSTEM + 15
)  # how exactly the ranges in use need the train speed, as a slip
HAVE_CHANGED: Final = SYSTEM + 16  # 1 once an axle has been given another range

# Each axle; forces in the unit of the signal.
FORCE: Final = (OF_SUPERVISOR + 0) * GROUP  # through the short filter
F0: Final = (OF_SUPERVISOR + 1) * GROUP  # at the last breakaway; 0 before the first
MEAN: Final = (OF_SUPERVISOR + 2) * GROUP  # FB, the mean force in the present range
SLID: Final = (OF_SUPERVISOR + 3) * GROUP  # slid distance sRB since it last began anew, m
RANGE_CLOCK: Final = (OF_SUPERVISOR + 4) * GROUP  # time in the present range, s
IS_ARMED: Final = (OF_SUPERVISOR + 5) * GROUP  # 1 while adhering: the next breakaway gives an F0
FACTOR: Final = (OF_SUPERVISOR + 6) * GROUP  # scale of the signal
TESTED_AT: Final = (OF_SUPERVISOR + 7) * GROUP  # number of its last test; 0 for never
IS_TESTED: Final = (OF_SUPERVISOR + 8) * GROUP  # 1 in a test phase
IS_LEAD: Final = (OF_SUPERVISOR + 9) * GROUP  # 1 for a leading test axle
RANGE: Final = (OF_SUPERVISOR + 10) * GROUP  # permitted range of slip

# Each axle, within a look.
TELLS: Final = SCRATCH  # 1 for one that brakes or pulls, and is believed
COUNTS: Final = SCRATCH + 1 * GROUP  # 1 while mean and slid distance tell of its range
IN_MACRO: Final = SCRATCH + 2 * GROUP  # 1 for one that counts in macro-slip
IN_MICRO: Final = SCRATCH + 4 * GROUP  # 1 for one that counts in micro-slip
