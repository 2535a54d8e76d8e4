"""What temperature control remembers: its places in the state array (`state_layout`)."""

from __future__ import annotations

from typing import Final

from railgrip.control.state_layout import GROUP, OWN, OWN_TRAIN, SCRATCH

# The train.
CLOCK: Final = OWN_TRAIN + 0  # since the controller began, s
SAMPLE: Final = OWN_TRAIN + 1  # place of the newest sample in the windows
FACTOR: Final = OWN_TRAIN + 2  # on the admissible rises at present
TRAIN_ACCELERATION: Final = OWN_TRAIN + 3  # signed, m/s²
STILL: Final = OWN_TRAIN + 4  # square of the heat conductance of one body at rest, W²/K²,
MOVING: Final = OWN_TRAIN + 5  # and what each m/s adds to it for each N of load

# Each axle.
MASS: Final = (OWN + 0) * GROUP  # rotating mass at the tread, kg
LOAD: Final = (OWN + 1) * GROUP  # N
BRAKE_FORCE: Final = (OWN + 2) * GROUP  # friction brake at full demand, N
IMPULSE: Final = (OWN + 3) * GROUP  # of the forces applied so far, Ns
FORCE_BEFORE: Final = (OWN + 4) * GROUP  # applied one period ago, N
FRICTION: Final = (OWN + 5) * GROUP  # force of the rail as observed, driving positive, N
FORCE_TARGET: Final = (OWN + 6) * GROUP  # F*, driving positive, N
FLIGHT: Final = (OWN + 7) * GROUP  # pressure change commanded and not yet felt, Pa
FORCE_PER_PRESSURE: Final = (OWN + 8) * GROUP  # of the friction brake at the tread, N/Pa
PRESSURE_PER_FORCE: Final = (OWN + 9) * GROUP  # one over it, Pa/N; 0 without brake
CONTINUOUS_BRAKE: Final = (OWN + 10) * GROUP  # 1 where the friction brake follows a share
EFFORT_OF_MOTOR: Final = (OWN + 11) * GROUP  # greatest force of the motor when braking, N
POWER_OF_MOTOR: Final = (OWN + 12) * GROUP  # and its power, W
FIRST: Final = (OWN + 13) * GROUP  # pressure at which the brake force begins, Pa
FULL: Final = (OWN + 14) * GROUP  # pressure at full demand, Pa
SLIP_LIMIT: Final = (OWN + 15) * GROUP  # greatest slip that the axle is led to
MOMENTA: Final = (OWN + 16) * GROUP  # impulse less momentum of the wheel, in the window, Ns
N_WINDOW: Final = 32  # a power of two

# Each axle, within a step.
MOMENTUM_THEN: Final = SCRATCH  # at the beginning of the window, Ns
COUNTED_FRICTION: Final = SCRATCH + 1 * GROUP  # 0 where the sensor is not believed, N
COUNTED_LOAD: Final = SCRATCH + 2 * GROUP  # likewise, N
MOMENTUM: Final = SCRATCH + 4 * GROUP  # now, Ns
FRICTION_PERMITTED: Final = SCRATCH + 2 * GROUP  # share of the friction brake as commanded
