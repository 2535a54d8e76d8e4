"""Parameters of temperature control, and where each stands in the array that its kernel reads.

"spec" marks what the source or its settled description gives, "trial" a starting value of an
independent trial model, "illustrative" a value to be fitted to the vehicle.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.parameter_sets import joined

PHYSICAL: Final = 0.0
LINEAR: Final = 1.0
NEVER: Final = 1.0e9  # s


class TemperatureOnly(NamedTuple):
    """What temperature control adds to the parameters of the ordinary protection, SI.

    Parameters
    ----------
    rise_wheel, rise_rail : float
        Admissible rise of the surface in one contact, [K]; 0: that limit is absent (illustrative).
    set_point : float
        Share of the admissible rise that is aimed at (trial: 0.95 on uniform rail with known
        ground speed, 0.6 on random rail).
    emergency_factor : float
        The rises in an emergency brake application over those otherwise (illustrative).
    course_1 … course_3 : float
        Times since the controller began, ascending, from which on a factor holds, [s].
    factor_1 … factor_3 : float
        The factors on both rises; before `course_1` it is 1.
    course_ramps : float
        0: the factor steps at each time; 1: it runs straight from point to point.
    heat_law : float
        0: physical flash temperature; 1: the source's linear law.
    linear_factor : float
        k_T of the linear law, [K m²/J]; matched to the physical law at 20 m/s for the patch below.
    semi_axis_along, semi_axis_across : float
        Contact patch of one wheel at `patch_load`, [m] (illustrative: R 0.425 m on a rail head
        of 0.3 m).
    patch_load : float
        Axle load for which they hold, [N]; heavier axles have larger patches.
    accuracy : float
        How exactly the train speed must be known, as a slip, where the ordinary protection takes
        its lower threshold: with `drift_share` it decides when an axle is let run free (chosen
        here).
    observer_window : float
        Window over which wheel speed and applied force are compared, [s] (trial: 0.1).
    least_adhesion : float
        Floor of the observed adhesion (spec).
    least_speed : float
        Floor of the speeds in power, slip and slip target, [m/s] (spec).
    greatest_slip : float
        Bound of the slip target (spec).
    slip_scale : float
        Slip error that asks for the whole brake or tractive force (spec: s_max).
    gain_speed : float
        Below this speed the slip error counts in proportion to the speed, [m/s]: the wheel answers
        ever faster, brake and observer do not (illustrative).
    excess_gain, valve_excess_gain : float
        How much more a slip beyond its target counts than one below it, for continuous brakes and
        motors and behind dump valves (chosen here: the first leads back under the limit within
        0.3 s of a threefold adhesion, the second spares air).
    valve_lead : float
        How far ahead the slip is foreseen from the wheel's acceleration behind dump valves, [s]
        (chosen here; a continuous brake is worse with it).
    nominal_deceleration : float
        Friction brake at full demand, for axles of which no force is known, [m/s²] (illustrative).
    vent_time, fill_time : float
        Time constants of a cylinder behind its dump valve, [s] (illustrative).
    valve_delay : float
        From a valve's command to its effect, [s] (illustrative: 50 and 60 ms).
    pressure_band : float
        Half the width of the band about the wanted pressure in which the valve holds, [Pa]
        (illustrative).

    Examples
    --------
    >>> TemperatureOnly().slip_scale
    0.3
    """

    rise_wheel: float = 200.0
    rise_rail: float = 200.0
    set_point: float = 0.95
    emergency_factor: float = 1.0
    course_1: float = NEVER
    factor_1: float = 1.0
    course_2: float = NEVER
    factor_2: float = 1.0
    course_3: float = NEVER
    factor_3: float = 1.0
    course_ramps: float = 0.0
    heat_law: float = PHYSICAL
    linear_factor: float = 2.570e-3
    semi_axis_along: float = 5.955e-3
    semi_axis_across: float = 4.721e-3
    patch_load: float = 127.5e3
    accuracy: float = 0.02
    observer_window: float = 0.1
    least_adhesion: float = 0.01
    least_speed: float = 1.0
    greatest_slip: float = 0.25
    slip_scale: float = 0.3
    gain_speed: float = 10.0
    excess_gain: float = 8.0
    valve_excess_gain: float = 2.0
    valve_lead: float = 0.1
    nominal_deceleration: float = 1.2
    vent_time: float = 0.30
    fill_time: float = 0.43
    valve_delay: float = 0.055
    pressure_band: float = 0.15e5


TemperatureParameters: Any = joined(
    "TemperatureParameters", ConventionalParameters, TemperatureOnly
)
"""The ordinary protection's parameters come first: its train observer reads them unchanged."""

_place = TemperatureParameters._fields.index

FIRST: Final = _place("rise_wheel")
EMERGENCY_FACTOR: Final = _place("emergency_factor")
COURSE: Final = _place("course_1")
COURSE_RAMPS: Final = _place("course_ramps")
SEMI_AXIS_ALONG: Final = _place("semi_axis_along")
SEMI_AXIS_ACROSS: Final = _place("semi_axis_across")
PATCH_LOAD: Final = _place("patch_load")
ACCURACY: Final = _place("accuracy")
OBSERVER_WINDOW: Final = _place("observer_window")
GREATEST_SLIP: Final = _place("greatest_slip")
NOMINAL_DECELERATION: Final = _place("nominal_deceleration")


def temperature_of(parameters: FloatArray) -> TemperatureOnly:
    """Return by name what temperature control adds, as `conventional_of` what stands before it.

    Examples
    --------
    >>> import numpy as np
    >>> temperature_of(np.array(TemperatureParameters())) == TemperatureOnly()
    True
    """
    return TemperatureOnly(
        rise_wheel=parameters[FIRST + 0],
        rise_rail=parameters[FIRST + 1],
        set_point=parameters[FIRST + 2],
        emergency_factor=parameters[FIRST + 3],
        course_1=parameters[FIRST + 4],
        factor_1=parameters[FIRST + 5],
        course_2=parameters[FIRST + 6],
        factor_2=parameters[FIRST + 7],
        course_3=parameters[FIRST + 8],
        factor_3=parameters[FIRST + 9],
        course_ramps=parameters[FIRST + 10],
        heat_law=parameters[FIRST + 11],
        linear_factor=parameters[FIRST + 12],
        semi_axis_along=parameters[FIRST + 13],
        semi_axis_across=parameters[FIRST + 14],
        patch_load=parameters[FIRST + 15],
        accuracy=parameters[FIRST + 16],
        observer_window=parameters[FIRST + 17],
        least_adhesion=parameters[FIRST + 18],
        least_speed=parameters[FIRST + 19],
        greatest_slip=parameters[FIRST + 20],
        slip_scale=parameters[FIRST + 21],
        gain_speed=parameters[FIRST + 22],
        excess_gain=parameters[FIRST + 23],
        valve_excess_gain=parameters[FIRST + 24],
        valve_lead=parameters[FIRST + 25],
        nominal_deceleration=parameters[FIRST + 26],
        vent_time=parameters[FIRST + 27],
        fill_time=parameters[FIRST + 28],
        valve_delay=parameters[FIRST + 29],
        pressure_band=parameters[FIRST + 30],
    )
