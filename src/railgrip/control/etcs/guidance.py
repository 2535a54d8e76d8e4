"""Guidance curve: comfortable braking for the driver (SUBSET-026, 3.13.8.5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from railgrip.control.etcs.ceiling import speed_inaccuracy
from railgrip.control.etcs.curves import before_target, brake_field
from railgrip.control.etcs.deceleration_curve import DecelerationCurve, deceleration_curve
from railgrip.control.etcs.intervention_times import DRIVER_TIME, Times
from railgrip.control.etcs.train_data import SupervisedTrain, Target, Track

Array = NDArray[np.float64]


def guidance_distances(
    train: SupervisedTrain,
    track: Track,
    target: Target,
    times: Times,
    emergency: DecelerationCurve,
    speed: Array,
) -> Array:
    """Return how far before the target the guidance curve lies, NaN without one, [m].

    Parameters
    ----------
    train, track, target, times : SupervisedTrain, Track, Target, Times
        What the supervision knows.
    emergency : DecelerationCurve
        EBD of the target.
    speed : ndarray (speed)
        [m/s].

    Notes
    -----
    To an end of authority it ends there; to a speed, where the permitted speed has fallen to it.

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.8.5 and 3.13.9.3.5.10.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import constant
    >>> from railgrip.control.etcs.curves import emergency_curve
    >>> from railgrip.control.etcs.intervention_times import times_of
    >>> from railgrip.control.etcs.train_data import Brakes
    >>> brakes = Brakes(constant(1.0), constant(1.0), 2.5, 2.5, normal_service=constant(0.5))
    >>> train, track, stop = SupervisedTrain(200.0, brakes), Track(constant(0.0)), Target(5e3)
    >>> curve = emergency_curve(train, track, stop, 50.0)
    >>> guidance_distances(train, track, stop, times_of(train), curve, np.array([40.0]))
    array([1600.])
    """
    brakes = train.brakes
    if brakes.normal_service is None:
        return np.full_like(speed, np.nan)
    foot = target.position
    if not target.is_end_of_authority:
        error = speed_inaccuracy(target.speed) if train.compensates_speed else 0.0
        shifted = target.speed + error
        intervention = emergency.position_at(shifted) - shifted * (times.remaining + times.traction)
        foot = float(intervention) - target.speed * (DRIVER_TIME + times.service_2)
        foot = min(foot, target.position)
    field = brake_field(train, track, brakes.normal_service)
    field = field._replace(uphill=brakes.uphill, downhill=brakes.downhill)
    top = max(float(np.max(speed)), target.speed) + 1.0
    curve = deceleration_curve(
        field, foot, target.speed, lowest=target.speed, highest=top, name="GUI"
    )
    return before_target(target, curve, speed)
