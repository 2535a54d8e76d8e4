"""Parameters of the conventional WSP, and where each stands in the array that its kernel reads.

"trial" marks starting values found on an independent trial model of sixteen axles, "practice" a
figure that is usual in the trade but was not checked against a standard; both are illustrative and
meant to be tuned to the train.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray


class ConventionalParameters(NamedTuple):
    """Everything that can be tuned in `ConventionalWSP`, SI.

    Parameters
    ----------
    slip_lower, slip_upper : float
        Slip below which the brake fills again and above which it vents, share of the reference
        speed; 0.08 and 0.16 are the macro band, 0.008 and 0.02 the micro band (trial).
    slip_speed_lower_floor, slip_speed_upper_floor : float
        Least slip speeds of the two thresholds, [m/s] (trial).
    lead_time : float
        How far ahead the slip speed is foreseen from the wheel's acceleration, [s] (trial).
    acceleration_filter : float
        Time constant of the wheel acceleration, [s] (illustrative).
    fill_pulse, fill_hold : float
        Stepped filling after a slide: length of a step and of the pause behind it, [s] (practice:
        0.06-0.10 and 0.15-0.30).
    settle_time : float
        Time without a slide after which the brake fills without steps, [s] (illustrative).
    inhibit_speed : float
        Reference speed below which nothing is released any more, [m/s] (practice: 3-5 km/h).
    safety_time : float
        Longest time an axle is kept from filling without turning faster, [s] (practice: 10).
    rotating_share : float
        Rotating mass as share of the train's mass, for the force estimate (illustrative).
    deceleration_per_pressure : float
        First guess of the deceleration by one Pa of mean cylinder pressure, [m/(s² Pa)];
        learned in every stop before the first slide (illustrative: 1.2 m/s² at 3 bar).
    pressure_per_force : float
        Cylinder pressure that brakes as much as one newton of dynamic force, [Pa/N]
        (illustrative: 3.0 bar for 16.5 kN).
    slope_filter : float
        Time constant of the measured deceleration, [s] (illustrative).
    reference_margin : float
        Added to the estimated deceleration so that an error upwards heals, [m/s²] (trial).
    reference_rise : float
        Greatest rise of the reference speed, [m/s²] (illustrative).
    drift_rate : float
        How fast the reference speed is trusted less while no axle adheres, [m/s²] (illustrative).
    drift_share, drift_floor : float
        Drift at which an axle is let run free to see the train's speed: share of the slip speed at
        the lower threshold, least value [m/s] (illustrative).
    free_longest : float
        Longest time one axle is let run free, [s] (trial: 6).
    dynamic_least_force : float
        Dynamic force below which the brake counts as handed over, [N] (illustrative).
    dynamic_release_time, dynamic_return_time : float
        Full stroke of the dynamic share downwards and upwards, [s] (practice: 0.3; illustrative).
    dynamic_return_after : float
        Time without a slide before the dynamic brake comes back, [s]; very large: not in this
        stop (illustrative).
    diameter_time, diameter_bound, diameter_least_speed : float
        Wheel-diameter compensation: time constant [s], greatest correction (share), least speed
        [m/s] (illustrative).
    dead_speed, dead_time, dead_reference : float
        A sensor is dead when it reads less than dead_speed [m/s] for dead_time [s] with an empty
        cylinder above the reference speed dead_reference [m/s] (illustrative).
    frozen_time : float
        A sensor is frozen when a braked wheel above dead_reference reads the very same speed, to
        the last digit, for so long, [s] (illustrative).
    empty_pressure : float
        Cylinder pressure below which an axle counts as released, [Pa] (illustrative).
    sand_above, sand_after, sand_time : float
        Sand is asked for above this reference speed [m/s] once an axle has slid so long [s], and
        for at least so long [s] (practice: above 10 mph; illustrative).

    Examples
    --------
    >>> ConventionalParameters().slip_upper
    0.16
    """

    slip_lower: float = 0.08
    slip_upper: float = 0.16
    slip_speed_lower_floor: float = 0.15
    slip_speed_upper_floor: float = 0.25
    lead_time: float = 0.2
    acceleration_filter: float = 0.04
    fill_pulse: float = 0.08
    fill_hold: float = 0.20
    settle_time: float = 1.5
    inhibit_speed: float = 1.4
    safety_time: float = 10.0
    rotating_share: float = 0.10
    deceleration_per_pressure: float = 4.0e-6
    pressure_per_force: float = 18.0
    slope_filter: float = 0.3
    reference_margin: float = 0.1
    reference_rise: float = 3.0
    drift_rate: float = 0.1
    drift_share: float = 0.25
    drift_floor: float = 0.2
    free_longest: float = 6.0
    dynamic_least_force: float = 500.0
    dynamic_release_time: float = 0.3
    dynamic_return_time: float = 3.0
    dynamic_return_after: float = 3.0
    diameter_time: float = 4.0
    diameter_bound: float = 0.05
    diameter_least_speed: float = 8.0
    dead_speed: float = 0.5
    dead_time: float = 3.0
    dead_reference: float = 10.0
    frozen_time: float = 0.5
    empty_pressure: float = 2.0e4
    sand_above: float = 4.5
    sand_after: float = 0.5
    sand_time: float = 2.0


def parameter_array(parameters: ConventionalParameters) -> NDArray[np.float64]:
    """Return the parameters as the kernel reads them.

    Examples
    --------
    >>> float(parameter_array(ConventionalParameters())[SLIP_UPPER])
    0.16
    """
    return np.array(parameters, dtype=np.float64)


_place = ConventionalParameters._fields.index

SLIP_LOWER: Final = _place("slip_lower")
SLIP_UPPER: Final = _place("slip_upper")
SLIP_SPEED_LOWER_FLOOR: Final = _place("slip_speed_lower_floor")
SLIP_SPEED_UPPER_FLOOR: Final = _place("slip_speed_upper_floor")
LEAD_TIME: Final = _place("lead_time")
INHIBIT_SPEED: Final = _place("inhibit_speed")
ROTATING_SHARE: Final = _place("rotating_share")
DECELERATION_PER_PRESSURE: Final = _place("deceleration_per_pressure")
SLOPE_FILTER: Final = _place("slope_filter")
REFERENCE_MARGIN: Final = _place("reference_margin")
REFERENCE_RISE: Final = _place("reference_rise")
DRIFT_RATE: Final = _place("drift_rate")
DRIFT_SHARE: Final = _place("drift_share")
DRIFT_FLOOR: Final = _place("drift_floor")
FREE_LONGEST: Final = _place("free_longest")
DYNAMIC_LEAST_FORCE: Final = _place("dynamic_least_force")
DIAMETER_TIME: Final = _place("diameter_time")
DIAMETER_BOUND: Final = _place("diameter_bound")
DIAMETER_LEAST_SPEED: Final = _place("diameter_least_speed")
DEAD_TIME: Final = _place("dead_time")
EMPTY_PRESSURE: Final = _place("empty_pressure")


def conventional_of(parameters: NDArray[np.float64]) -> ConventionalParameters:
    """Return by name what stands first in the array that a kernel reads.

    A loop over the axles takes them so: read before it, they are numbers that nothing in it can
    change, where an array might overlap with the state.

    Examples
    --------
    >>> conventional_of(parameter_array(ConventionalParameters())) == ConventionalParameters()
    True
    """
    return ConventionalParameters(
        slip_lower=parameters[0],
        slip_upper=parameters[1],
        slip_speed_lower_floor=parameters[2],
        slip_speed_upper_floor=parameters[3],
        lead_time=parameters[4],
        acceleration_filter=parameters[5],
        fill_pulse=parameters[6],
        fill_hold=parameters[7],
        settle_time=parameters[8],
        inhibit_speed=parameters[9],
        safety_time=parameters[10],
        rotating_share=parameters[11],
        deceleration_per_pressure=parameters[12],
        pressure_per_force=parameters[13],
        slope_filter=parameters[14],
        reference_margin=parameters[15],
        reference_rise=parameters[16],
        drift_rate=parameters[17],
        drift_share=parameters[18],
        drift_floor=parameters[19],
        free_longest=parameters[20],
        dynamic_least_force=parameters[21],
        dynamic_release_time=parameters[22],
        dynamic_return_time=parameters[23],
        dynamic_return_after=parameters[24],
        diameter_time=parameters[25],
        diameter_bound=parameters[26],
        diameter_least_speed=parameters[27],
        dead_speed=parameters[28],
        dead_time=parameters[29],
        dead_reference=parameters[30],
        frozen_time=parameters[31],
        empty_pressure=parameters[32],
        sand_above=parameters[33],
        sand_after=parameters[34],
        sand_time=parameters[35],
    )
