"""What temperature control remembers: its places in the state array (`state_layout`)."""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control.contract import FloatArray
from railgrip.control.state_layout import GROUP, OWN, OWN_TRAIN, axle_base

# The train.
CLOCK: Final = OWN_TRAIN + 0  # since the controller began, s
SAMPLE: Final = OWN_TRAIN + 1  # place of the newest sample in the windows
FACTOR: Final = OWN_TRAIN + 2  # on the admissible rises at present
TRAIN_ACCELERATION: Final = OWN_TRAIN + 3  # signed, m/s²

# Each axle.
MASS: Final = (OWN + 0) * GROUP  # rotating mass at the tread, kg
LOAD: Final = (OWN + 1) * GROUP  # N
BRAKE_FORCE: Final = (OWN + 2) * GROUP  # friction brake at full demand, N
STILL: Final = (OWN + 3) * GROUP  # squares of the heat conductance of one body: at rest, W²/K²,
MOVING: Final = (OWN + 4) * GROUP  # and what each m/s adds to it
IMPULSE: Final = (OWN + 5) * GROUP  # of the forces applied so far, Ns
FORCE_BEFORE: Final = (OWN + 6) * GROUP  # applied one period ago, N
FRICTION: Final = (
    OWN + 7
) * GROUP  # force of the rail on the axle as observed, driving positive, N
SLIP: Final = (OWN + 8) * GROUP  # s*, driving positive
POWER_TARGET: Final = (OWN + 9) * GROUP  # P_soll, W
FRICTION_SPEED: Final = (OWN + 10) * GROUP  # P_soll over the observed force, m/s
SLIP_TARGET: Final = (OWN + 11) * GROUP  # s_soll, driving positive
FORCE_TARGET: Final = (OWN + 12) * GROUP  # F*, driving positive, N
FLIGHT: Final = (OWN + 13) * GROUP  # pressure change commanded and not yet felt, Pa
FORCE_PER_PRESSURE: Final = (OWN + 14) * GROUP  # of the friction brake at the tread, N/Pa
CONTINUOUS_BRAKE: Final = (OWN + 15) * GROUP  # 1 where the friction brake follows a share
EFFORT_OF_MOTOR: Final = (OWN + 16) * GROUP  # greatest force of the motor when braking, N
POWER_OF_MOTOR: Final = (OWN + 17) * GROUP  # and its power, W
FIRST: Final = (OWN + 18) * GROUP  # pressure at which the brake force begins, Pa
FULL: Final = (OWN + 19) * GROUP  # pressure at full demand, Pa
SLIP_LIMIT: Final = (OWN + 20) * GROUP  # greatest slip that the axle is led to
FRICTION_PERMITTED: Final = (OWN + 21) * GROUP  # share of the friction brake as commanded
SPEEDS: Final = (OWN + 22) * GROUP  # wheel speeds of the window, m/s
N_WINDOW: Final = 32  # a power of two
IMPULSES: Final = SPEEDS + N_WINDOW * GROUP  # the impulse at the same times, Ns


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


def targets(state: FloatArray, axle: int) -> Targets:
    """Return the reckoning of one axle out of a state, to be logged or drawn.

    Examples
    --------
    >>> import numpy as np
    >>> from railgrip.control.state_layout import state_size
    >>> targets(np.zeros(state_size(2)), 1).force
    0.0
    """
    own = axle_base(axle)
    order = (FRICTION, SLIP, SLIP_TARGET, POWER_TARGET, FRICTION_SPEED, FORCE_TARGET)
    return Targets(*(float(state[own + place]) for place in order))
