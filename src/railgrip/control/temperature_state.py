"""What temperature control remembers: behind the ordinary protection's state, its own.

First the values of the train, then one block an axle:
``state[own_base(n_axles, axle) + FORCE_TARGET]``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control import conventional_state
from railgrip.control.contract import FloatArray

# The train.
CLOCK: Final = 0  # since the controller began, s
SAMPLE: Final = 1  # place of the newest sample in the windows
FACTOR: Final = 2  # on the admissible rises at present
TRAIN_ACCELERATION: Final = 3  # signed, m/s²
N_TRAIN: Final = 4

# Each axle.
MASS: Final = 0  # rotating mass at the tread, kg
LOAD: Final = 1  # N
BRAKE_FORCE: Final = 2  # friction brake at full demand, N
STILL: Final = 3  # squares of the heat conductance of one body: at rest, W²/K²,
MOVING: Final = 4  # and what each m/s adds to it
IMPULSE: Final = 5  # of the forces applied so far, Ns
FORCE_BEFORE: Final = 6  # applied one period ago, N
FRICTION: Final = 7  # force of the rail on the axle as observed, driving positive, N
SLIP: Final = 8  # s*, driving positive
POWER_TARGET: Final = 9  # P_soll, W
FRICTION_SPEED: Final = 10  # P_soll over the observed force, m/s
SLIP_TARGET: Final = 11  # s_soll, driving positive
FORCE_TARGET: Final = 12  # F*, driving positive, N
FLIGHT: Final = 13  # pressure change commanded and not yet felt, Pa
FORCE_PER_PRESSURE: Final = 14  # of the friction brake at the tread, N/Pa
SPEEDS: Final = 15  # wheel speeds of the window, m/s
N_WINDOW: Final = 32  # a power of two
IMPULSES: Final = SPEEDS + N_WINDOW  # the impulse at the same times, Ns
N_OWN: Final = IMPULSES + N_WINDOW


def train_base(n_axles: int) -> int:
    """Return where the train's own values begin.

    Examples
    --------
    >>> train_base(2)
    58
    """
    return conventional_state.N_TRAIN + n_axles * conventional_state.N_AXLE


def own_base(n_axles: int, axle: int) -> int:
    """Return where the block of an axle begins.

    Examples
    --------
    >>> own_base(2, 0)
    62
    """
    return train_base(n_axles) + N_TRAIN + axle * N_OWN


def state_size(n_axles: int) -> int:
    """Return the length of the state array.

    Examples
    --------
    >>> state_size(1)
    118
    """
    return own_base(n_axles, n_axles)


class Targets(NamedTuple):
    """What temperature control has reckoned for one axle, driving positive.

    Parameters
    ----------
    friction : float
        Force of the rail as observed, [N].
    slip, slip_target : float
        s* and s_soll.
    power : float
        Friction power aimed at, both contacts, [W].
    friction_speed : float
        That power over the observed force, before any bound, [m/s].
    force : float
        F*, what brakes and motor shall apply, [N].
    """

    friction: float
    slip: float
    slip_target: float
    power: float
    friction_speed: float
    force: float


def targets(state: FloatArray, n_axles: int, axle: int) -> Targets:
    """Return the reckoning of one axle out of a state, to be logged or drawn.

    Examples
    --------
    >>> import numpy as np
    >>> targets(np.zeros(state_size(2)), 2, 1).force
    0.0
    """
    own = own_base(n_axles, axle)
    order = (FRICTION, SLIP, SLIP_TARGET, POWER_TARGET, FRICTION_SPEED, FORCE_TARGET)
    return Targets(*(float(state[own + place]) for place in order))
