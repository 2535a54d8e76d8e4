"""The train's deceleration controller: what remains after friction has been fed forward."""

from __future__ import annotations

from typing import NamedTuple


class DecelerationGains(NamedTuple):
    """Gains and bounds of the controller; corrections are shares of the asked deceleration.

    Parameters
    ----------
    proportional : float
        Correction per relative error, ≥ 0 [-].
    integral : float
        Growth of the correction per relative error, ≥ 0 [1/s].
    greatest : float
        Greatest correction in both directions, ≥ 0 [-].
    rate : float
        Fastest change of the correction, > 0 [1/s]; times the asked deceleration, a jerk.
    """

    proportional: float
    integral: float
    greatest: float
    rate: float


def correct_deceleration(
    gains: DecelerationGains,
    integral: float,
    correction: float,
    error: float,
    more_is_possible: float,
    less_is_possible: float,
    dt: float,
) -> tuple[float, float]:
    """Advance the controller by one period.

    Parameters
    ----------
    gains : DecelerationGains
        Of the controller.
    integral, correction : float
        Integral part and correction of the period before [-].
    error : float
        (asked − measured)/asked deceleration, positive when the train brakes too little [-].
    more_is_possible, less_is_possible : float
        0 while brakes are at their pressure limit or wheels slide; 0 while they are released.
    dt : float
        Period [s].

    Returns
    -------
    integral, correction : float
        New values, both within ± greatest [-].

    Notes
    -----
    Anti-windup by conditional integration: the integral does not grow into a direction in which
    the brakes cannot follow, and it follows the rate limit.

    Examples
    --------
    >>> gains = DecelerationGains(0.2, 0.5, 0.3, 1.0)
    >>> [round(x, 3) for x in correct_deceleration(gains, 0.0, 0.0, 0.1, 1.0, 1.0, 0.1)]
    [0.005, 0.025]
    >>> correct_deceleration(gains, 0.1, 0.1, 0.1, 0.0, 1.0, 0.1)[0]
    0.1
    """
    growth = gains.integral * error * dt
    growth = growth * more_is_possible if growth > 0.0 else growth * less_is_possible
    wanted = integral + growth + gains.proportional * error
    change = gains.rate * dt
    is_limited = abs(wanted - correction) > change or abs(wanted) > gains.greatest
    # while the output is bound, the integral may only go back
    growth = 0.0 if is_limited and growth * (wanted - correction) > 0.0 else growth
    integral = max(-gains.greatest, min(gains.greatest, integral + growth))
    wanted = integral + gains.proportional * error
    wanted = max(correction - change, min(correction + change, wanted))
    return integral, max(-gains.greatest, min(gains.greatest, wanted))


def limit_jerk(asked: float, wanted: float, jerk: float, dt: float) -> float:
    """Return the asked deceleration on its way to the wanted one.

    Parameters
    ----------
    asked, wanted : float
        Present and wanted deceleration [m/s²].
    jerk : float
        Fastest change, > 0 [m/s³].
    dt : float
        Period [s].

    Examples
    --------
    >>> limit_jerk(0.0, 1.2, 1.0, 0.1)
    0.1
    """
    return max(asked - jerk * dt, min(asked + jerk * dt, wanted))


def stopping_deceleration(
    speed: float, distance: float, response: float, last: float, least_speed: float
) -> float:
    """Return the deceleration that brings a train to a stand at a place.

    Parameters
    ----------
    speed : float
        Of the train, ≥ 0 [m/s].
    distance : float
        To the place [m].
    response : float
        Time by which the brakes follow late, ≥ 0 [s].
    last : float
        Deceleration asked for in the period before [m/s²].
    least_speed : float
        Below it the last deceleration is kept: there v²/2s has no more meaning [m/s].

    Returns
    -------
    float
        v²/(2 (s − v t_r + a t_r²/2)), ≥ 0 [m/s²].

    Notes
    -----
    What the train runs until the brakes respond, at its last deceleration, is taken off the
    distance, and the speed that it loses meanwhile off the speed.

    Examples
    --------
    >>> round(stopping_deceleration(20.0, 200.0, 0.0, 1.0, 0.5), 6)
    1.0
    """
    then = max(speed - last * response, 0.0)
    left = distance - 0.5 * (speed + then) * response
    wanted = 0.5 * then * then / max(left, 0.01)
    return last if speed < least_speed else wanted
