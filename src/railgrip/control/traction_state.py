"""What traction anti-slip remembers: behind the adaptive protection's state, its own.

The adaptive protection's begins with the ordinary protection's; one controller only uses all of it.
First the values of the train, then one block an axle: ``state[own_base(n_axles, axle) + FORCE]``.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.adaptive_state import adaptive_state_size

# The train.
OFFSET: Final = 0  # acceleration that the forces do not explain: gradient, resistance, m/s²
DOUBT: Final = 1  # possible error of the reference speed since it was last seen, m/s
SIGHT_AGE: Final = 2  # time since then, s
SIGHT_SPEED: Final = 3  # what was seen, m/s
EXPECTED_GAIN: Final = 4  # gain of speed since then by the forces, m/s
N_SIGHTS: Final = 5
LOOKING: Final = 6  # 1 + the axle that runs free to show the train's speed, 0 for none
LOOK_TIME: Final = 7  # how long it has, s
LAST_LOOK: Final = 8  # the axle that did it last
CLOCK: Final = 9  # since the controller began, s
SEEN: Final = 10  # speed seen in this period, negative for none, m/s
N_TRAIN: Final = 11

# Each axle.
MASS: Final = 0  # rotating mass at the tread, kg
LOAD: Final = 1  # N
FORCE_PER_PRESSURE: Final = 2  # of the friction brake at the tread, N/Pa
APPLIED_BEFORE: Final = 3  # sum of motor and brake one period ago, driving positive, N
BELIEVED_SPEED: Final = 4  # of the wheel, by the observer, m/s
FORCE: Final = 5  # of the rail on the axle, by the observer, driving positive, N
SHARE: Final = 6  # of the demanded motor force that is permitted
SHARE_AT_SPIN: Final = 7  # what it was when the wheel broke away
IS_CUT: Final = 8  # 1 from a breakaway until the wheel adheres
FREE_CLOCK: Final = 9  # how long an unmotored wheel has turned steadily, s
TARGET: Final = 10  # slip speed aimed at, m/s
SLIP_LAG: Final = 11  # slip speed as late as the observed force, m/s
MEAN_SLIP: Final = 12  # means against which their ups and downs are taken
MEAN_FORCE: Final = 13
SLOPE: Final = 14  # (dF/F)/(dw/w), of the adhesion curve at the target
DOUBT_OF_SLOPE: Final = 15  # its variance
N_OWN: Final = 16


def train_base(n_axles: int) -> int:
    """Return where the train's own values begin.

    Examples
    --------
    >>> train_base(2) == adaptive_state_size(2)
    True
    """
    return adaptive_state_size(n_axles)


def own_base(n_axles: int, axle: int) -> int:
    """Return where the block of an axle begins.

    Examples
    --------
    >>> own_base(2, 1) - own_base(2, 0)
    16
    """
    return train_base(n_axles) + N_TRAIN + axle * N_OWN


def state_size(n_axles: int) -> int:
    """Return the length of the state array.

    Examples
    --------
    >>> state_size(1) - train_base(1)
    27
    """
    return own_base(n_axles, n_axles)
