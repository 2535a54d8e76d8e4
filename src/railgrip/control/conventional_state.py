"""What the conventional WSP remembers: the places in its flat state array.

First the values of the train, then one block an axle: ``state[axle_base(axle) + SPEED]``.
"""

from __future__ import annotations

from typing import Final

# The train.
REFERENCE: Final = 0  # the train's speed as believed, m/s
DECELERATION: Final = 1  # of the train as estimated, >= 0 when braking, m/s²
FASTEST_LAG: Final = 2  # fastest wheel through the slope filter, m/s
EFFORT_LAG: Final = 3  # mean braking pressure through the same filter, Pa
PRESSURE_GAIN: Final = 4  # deceleration by one Pa of mean braking pressure, m/(s² Pa)
OFFSET: Final = 5  # deceleration without brakes: resistance, gradient, error, m/s²
DRIFT: Final = 6  # possible error of the reference speed since it was last seen, m/s
SEEN_SPEED: Final = 7  # train speed when it was last seen on a free or adhering wheel, m/s
SEEN_TIME: Final = 8  # time since then, s
EXPECTED_FALL: Final = 9  # fall of the speed since then by the estimate, m/s
FREED_AXLE: Final = 10  # 1 + the axle that is let run free, 0 for none
FREED_TIME: Final = 11  # how long it has been free, s
N_TRAIN: Final = 12

# Each axle.
SPEED: Final = 0  # wheel speed, compensated for the diameter, m/s
SPEED_LAG: Final = 1  # the same through the acceleration filter, m/s
ACCELERATION: Final = 2  # of the wheel, m/s²
DIAMETER: Final = 3  # factor on the measured speed
IS_FAULTY: Final = 4  # 1 while the sensor is not believed
DEAD_CLOCK: Final = 5  # how long the sensor has looked dead, s
SLIDES: Final = 6  # 1 from the first wish to vent until the axle adheres again
ADHERED_CLOCK: Final = 7  # time since slip was last over the lower threshold, s
SETTLED_CLOCK: Final = 8  # time an unbraked wheel has not turned faster, s
FILL_CLOCK: Final = 9  # place in the pattern of stepped filling, s
KEPT_CLOCK: Final = 10  # time released without turning faster, s
SAFETY_FILL: Final = 11  # 1 after the safety timer ran out, until the wheel is alive
HANDED_OVER: Final = 12  # 1 while the dynamic brake is handed over to the friction brake
SAND_CLOCK: Final = 13  # > 0: sand is asked for so much longer; < 0: time slid so far, s
WITNESS_CLOCK: Final = 14  # time the wheel has turned at the reference speed, s
LAST_READING: Final = 15  # what the sensor read last, m/s
FROZEN_CLOCK: Final = 16  # how long a braked wheel has read the very same, s
LAST_STEP: Final = 17  # by how much the reading changed in the last period, m/s
ROUGHNESS: Final = 18  # mean change of that change, m/s: what noise makes and no wheel does
LEAD_CLOCK: Final = 19  # how long the wheel has led wheels that show the train, s
VOTE_CLOCK: Final = 20  # how long an unbraked wheel has mostly not turned faster, s
CORRECTIONS: Final = 21  # how often other wheels have corrected the diameter in this braking
STRANGE_CLOCK: Final = 22  # how long the sensor has read what no pulling wheel shows, s
N_AXLE: Final = 23


def axle_base(axle: int) -> int:
    """Return where the block of an axle begins.

    Examples
    --------
    >>> axle_base(0), axle_base(2)
    (12, 58)
    """
    return N_TRAIN + axle * N_AXLE


def state_size(n_axles: int) -> int:
    """Return the length of the state array.

    Examples
    --------
    >>> state_size(16)
    380
    """
    return N_TRAIN + n_axles * N_AXLE
