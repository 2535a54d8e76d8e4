"""What the conventional WSP remembers: its places in the state array (`state_layout`)."""

from __future__ import annotations

from typing import Final

from railgrip.control.state_layout import GROUP, SCRATCH

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
HAS_LED: Final = 12  # 1 once a wheel has led others that show the train

# Each axle.
SPEED: Final = 0 * GROUP  # wheel speed, compensated for the diameter, m/s
SPEED_LAG: Final = 1 * GROUP  # the same through the acceleration filter, m/s
ACCELERATION: Final = 2 * GROUP  # of the wheel, m/s²
DIAMETER: Final = 3 * GROUP  # factor on the measured speed
IS_FAULTY: Final = 4 * GROUP  # 1 while the sensor is not believed
DEAD_CLOCK: Final = 5 * GROUP  # how long the sensor has looked dead, s
SLIDES: Final = 6 * GROUP  # 1 from the first wish to vent until the axle adheres again
ADHERED_CLOCK: Final = 7 * GROUP  # time since slip was last over the lower threshold, s
SETTLED_CLOCK: Final = 8 * GROUP  # time an unbraked wheel has not turned faster, s
FILL_CLOCK: Final = 9 * GROUP  # place in the pattern of stepped filling, s
KEPT_CLOCK: Final = 10 * GROUP  # time released without turning faster, s
SAFETY_FILL: Final = 11 * GROUP  # 1 after the safety timer ran out, until the wheel is alive
HANDED_OVER: Final = 12 * GROUP  # 1 while the dynamic brake is handed over to the friction brake
SAND_CLOCK: Final = 13 * GROUP  # > 0: sand is asked for so much longer; < 0: time slid so far, s
WITNESS_CLOCK: Final = 14 * GROUP  # time the wheel has turned at the reference speed, s
LAST_READING: Final = 15 * GROUP  # what the sensor read last, m/s
FROZEN_CLOCK: Final = 16 * GROUP  # how long a braked wheel has read the very same, s
LAST_STEP: Final = 17 * GROUP  # by how much the reading changed in the last period, m/s
ROUGHNESS: Final = 18 * GROUP  # mean change of that change, m/s: what noise makes and no wheel does
LEAD_CLOCK: Final = 19 * GROUP  # how long the wheel has led wheels that show the train, s
VOTE_CLOCK: Final = 20 * GROUP  # how long an unbraked wheel has mostly not turned faster, s
CORRECTIONS: Final = 21 * GROUP  # corrections of the diameter by other wheels in this braking
STRANGE_CLOCK: Final = 22 * GROUP  # how long the sensor has read what no pulling wheel shows, s
PRESSURE: Final = 23 * GROUP  # in the cylinder as measured, Pa
DYNAMIC: Final = 24 * GROUP  # dynamic brake force as measured, N
VALVE: Final = 25 * GROUP  # dump valve as last commanded: FILL, HOLD or VENT
DYNAMIC_PERMITTED: Final = 26 * GROUP  # share of the dynamic brake as last commanded
LOWER_SHARE: Final = 27 * GROUP  # slip below which the brake fills again, share of the reference
UPPER_SHARE: Final = 28 * GROUP  # slip above which it vents, likewise
IS_BRAKED: Final = 29 * GROUP  # 1 for an axle with a friction brake
IS_MOTORED: Final = 30 * GROUP  # 1 for an axle with a motor

# Each axle, within a step.
READING: Final = SCRATCH  # what the sensor reads now, m/s
EFFORT: Final = SCRATCH + 1 * GROUP  # pressure that brakes as much; 0 where it tells nothing, Pa
SHOWN_SPEED: Final = SCRATCH + 2 * GROUP  # of a believed wheel that shows the train, else -1, m/s
COUNTED_SPEED: Final = SCRATCH + 3 * GROUP  # wheel speed, 0 where the sensor is not believed, m/s
COUNTED_ACCELERATION: Final = SCRATCH + 4 * GROUP  # likewise, m/s²
SAND: Final = SCRATCH  # 1 while the axle wants sand
WRONG: Final = SCRATCH + 1 * GROUP  # what is wrong with it (`axle_alarm`)
