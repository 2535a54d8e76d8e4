"""What traction anti-slip remembers: its places in the state array (`state_layout`)."""

from __future__ import annotations

from typing import Final

from railgrip.control.state_layout import GROUP, OWN, OWN_TRAIN

# The train.
OFFSET: Final = (
    OWN_TRAIN + 0
)  # acceleration that the forces do not explain: gradient, resistance, m/s²
DOUBT: Final = OWN_TRAIN + 1  # possible error of the reference speed since it was last seen, m/s
SIGHT_AGE: Final = OWN_TRAIN + 2  # time since then, s
SIGHT_SPEED: Final = OWN_TRAIN + 3  # what was seen, m/s
EXPECTED_GAIN: Final = OWN_TRAIN + 4  # gain of speed since then by the forces, m/s
N_SIGHTS: Final = 5
LOOKING: Final = OWN_TRAIN + 6  # 1 + the axle that runs free to show the train's speed, 0 for none
LOOK_TIME: Final = OWN_TRAIN + 7  # how long it has, s
LAST_LOOK: Final = OWN_TRAIN + 8  # the axle that did it last
CLOCK: Final = OWN_TRAIN + 9  # since the controller began, s
SEEN: Final = OWN_TRAIN + 10  # speed seen in this period, negative for none, m/s

# Each axle.
MASS: Final = (OWN + 0) * GROUP  # rotating mass at the tread, kg
LOAD: Final = (OWN + 1) * GROUP  # N
FORCE_PER_PRESSURE: Final = (OWN + 2) * GROUP  # of the friction brake at the tread, N/Pa
APPLIED_BEFORE: Final = (
    OWN + 3
) * GROUP  # sum of motor and brake one period ago, driving positive, N
BELIEVED_SPEED: Final = (OWN + 4) * GROUP  # of the wheel, by the observer, m/s
FORCE: Final = (OWN + 5) * GROUP  # of the rail on the axle, by the observer, driving positive, N
SHARE: Final = (OWN + 6) * GROUP  # of the demanded motor force that is permitted
SHARE_AT_SPIN: Final = (OWN + 7) * GROUP  # what it was when the wheel broke away
IS_CUT: Final = (OWN + 8) * GROUP  # 1 from a breakaway until the wheel adheres
FREE_CLOCK: Final = (OWN + 9) * GROUP  # how long an unmotored wheel has turned steadily, s
TARGET: Final = (OWN + 10) * GROUP  # slip speed aimed at, m/s
SLIP_LAG: Final = (OWN + 11) * GROUP  # slip speed as late as the observed force, m/s
MEAN_SLIP: Final = (OWN + 12) * GROUP  # means against which their ups and downs are taken
MEAN_FORCE: Final = (OWN + 13) * GROUP
SLOPE: Final = (OWN + 14) * GROUP  # (dF/F)/(dw/w), of the adhesion curve at the target
DOUBT_OF_SLOPE: Final = (OWN + 15) * GROUP  # its variance
