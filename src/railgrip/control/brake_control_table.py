"""What brake control is told, measures, commands and remembers: parameters and columns.

As with the protection's controllers, numbers travel in flat arrays, one row an axle; what concerns
the whole train stands in row 0.
"""

from __future__ import annotations

from typing import Final, NamedTuple

OFF: Final = 0.0
ALWAYS: Final = 1.0
PAST_THRESHOLD: Final = 2.0
"""When the estimate is passed on, and when the deceleration controller acts."""

FROM_SENSOR: Final = 0.0
FROM_MODEL: Final = 1.0
COEFFICIENT: Final = 0.0
CHARACTERISTIC: Final = 1.0


class BrakeControlParameters(NamedTuple):
    """Parameters of brake control; each stands in the scenario's ``[brake_control]`` too.

    Parameters
    ----------
    estimator, controller : float
        `OFF`, `ALWAYS` or `PAST_THRESHOLD` (the latter for the estimator is the source's figure 5).
    temperature_source : float
        `FROM_SENSOR` or `FROM_MODEL`.
    adapts : float
        `COEFFICIENT`, or `CHARACTERISTIC`: the pressure over demand as it is without brake control,
        bent by the factor f0/μ.
    threshold_service, threshold_emergency : float
        Δa_max, deviation of the deceleration beyond which what waits for it begins [m/s²].
    degraded_share : float
        Of Δa_max that counts once a brake has failed, 0 … 1 [-].
    proportional, integral, greatest_correction, correction_rate : float
        See `deceleration_controller.DecelerationGains`.
    jerk_service, jerk_emergency : float
        Fastest change of the asked deceleration [m/s³].
    gradient_compensation : float
        Share of the gradient's force that the brakes make up for; in an emergency downhill only.
    delay : float
        From the central unit's correction to the local units [s].
    full_deceleration : float
        What full demand asks of the brakes [m/s²].
    resistance_constant, resistance_linear, resistance_quadratic : float
        Running resistance over mass, known [m/s², 1/s, 1/m].
    dead_time, filling : float
        From demand to first pressure; from demand until every sound brake has its pressure [s].
    measuring_lag : float
        Of the filter behind the deceleration sensor [s].
    settling : float
        After a change of demand the deviation is not looked at for so long [s].
    reserve : float
        Greatest pressure over the nominal full one, ≥ 1 [-].
    redistributes : float
        1: sound brakes take over what failed ones leave.
    stops : float
        1: the asked deceleration brings the train to the place it is told.
    response, least_stopping_speed : float
        See `deceleration_controller.stopping_deceleration`.
    """

    estimator: float = OFF
    controller: float = OFF
    temperature_source: float = FROM_SENSOR
    adapts: float = COEFFICIENT
    threshold_service: float = 0.1
    threshold_emergency: float = 0.05
    degraded_share: float = 0.5
    proportional: float = 0.3
    integral: float = 0.7
    greatest_correction: float = 0.4
    correction_rate: float = 0.5
    jerk_service: float = 1e9
    jerk_emergency: float = 1e9
    gradient_compensation: float = 0.0
    delay: float = 0.1
    full_deceleration: float = 1.0
    resistance_constant: float = 0.0
    resistance_linear: float = 0.0
    resistance_quadratic: float = 0.0
    dead_time: float = 0.3
    filling: float = 3.0
    measuring_lag: float = 0.2
    settling: float = 0.3
    reserve: float = 1.0
    redistributes: float = 0.0
    stops: float = 0.0
    response: float = 0.6
    least_stopping_speed: float = 0.4


_place = BrakeControlParameters._fields.index
ESTIMATOR: Final = _place("estimator")
CONTROLLER: Final = _place("controller")
TEMPERATURE_SOURCE: Final = _place("temperature_source")
ADAPTS: Final = _place("adapts")
THRESHOLD_SERVICE: Final = _place("threshold_service")
THRESHOLD_EMERGENCY: Final = _place("threshold_emergency")
DEGRADED_SHARE: Final = _place("degraded_share")
PROPORTIONAL: Final = _place("proportional")
INTEGRAL_GAIN: Final = _place("integral")
GREATEST_CORRECTION: Final = _place("greatest_correction")
CORRECTION_RATE: Final = _place("correction_rate")
JERK_SERVICE: Final = _place("jerk_service")
JERK_EMERGENCY: Final = _place("jerk_emergency")
GRADIENT_COMPENSATION: Final = _place("gradient_compensation")
DELAY: Final = _place("delay")
FULL_DECELERATION: Final = _place("full_deceleration")
RESISTANCE_CONSTANT: Final = _place("resistance_constant")
RESISTANCE_LINEAR: Final = _place("resistance_linear")
RESISTANCE_QUADRATIC: Final = _place("resistance_quadratic")
DEAD_TIME: Final = _place("dead_time")
FILLING: Final = _place("filling")
MEASURING_LAG: Final = _place("measuring_lag")
SETTLING: Final = _place("settling")
RESERVE: Final = _place("reserve")
REDISTRIBUTES: Final = _place("redistributes")
STOPS: Final = _place("stops")
RESPONSE: Final = _place("response")
LEAST_STOPPING_SPEED: Final = _place("least_stopping_speed")

# Columns of setup[axle, column].
ESTIMATE_AXLE: Final = 0  # the axle whose estimate this one uses
FULL_PRESSURE: Final = 1
FULL_FORCE: Final = 2
CLAMP_PER_PRESSURE: Final = 3
CLAMP_OFFSET: Final = 4
CLAMP_PER_BLOCK: Final = 5
NOMINAL_TREAD: Final = 6  # tread force per friction force
PADS: Final = 7
BRAKED: Final = 8
DISC: Final = 9  # nine numbers of two_node_heat.DiscHeat
MODEL: Final = 18  # f0 and three times nine numbers of Hinges
N_SETUP: Final = 18 + 28

# Columns of measured[axle, column]; from BRAKE_DEMAND on only row 0 is filled.
WHEEL_SPEED: Final = 0
CYLINDER_PRESSURE: Final = 1
DYNAMIC_FORCE: Final = 2
DISC_TEMPERATURE: Final = 3
IS_HELD: Final = 4  # 1 where the wheel-slide protection keeps the brake from filling
BELIEVED_TREAD: Final = 5  # tread force per friction force, with the believed wheel radius
LEARNED_FRICTION: Final = 6  # f0 of this brake over that of the model, as learned
BRAKE_DEMAND: Final = 7
EMERGENCY: Final = 8
DECELERATION: Final = 9
GRADIENT: Final = 10
TO_GO: Final = 11
TRAIN_SPEED: Final = 12  # as the wheel-slide protection believes it
N_MEASURED: Final = 13

# Columns of command[axle, column].
FORCE_FACTOR: Final = 0
PRESSURE_FACTOR: Final = 1
ESTIMATED_FRICTION: Final = 2
CORRECTION_OUT: Final = 3
N_COMMAND: Final = 4

# State of the central unit, then of each axle.
COUNT: Final = 0
CLOCK: Final = 1
LAST_DEMAND: Final = 2
ASKED: Final = 3
DEVIATION: Final = 4
INTEGRAL: Final = 6
CORRECTION: Final = 7
IS_PAST: Final = 8
N_FAILED: Final = 9
SHARE_LIMITED: Final = 10
SINCE_CHANGE: Final = 11
SETTLED: Final = 12
HELD_CLOCK: Final = 13
HISTORY: Final = 16
N_HISTORY: Final = 64
BUS: Final = HISTORY + N_HISTORY
FIRST_AXLE: Final = BUS + N_HISTORY
RING: Final = 0
HUB: Final = 1
ESTIMATE: Final = 2
CLAMP: Final = 3
FAILED_CLOCK: Final = 4
LEFT: Final = 5  # share of the full force that friction was asked for
N_AXLE: Final = 6


def brake_state_size(n_axles: int) -> int:
    """Return the length of the state array, which starts as zeros.

    Examples
    --------
    >>> brake_state_size(2)
    156
    """
    return FIRST_AXLE + N_AXLE * n_axles
