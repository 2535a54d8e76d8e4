"""Times between the supervision limits, and the way until the brake is fully applied."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.control.etcs.ceiling import speed_inaccuracy
from railgrip.control.etcs.train_data import SupervisedTrain, Target

Array = NDArray[np.float64]
WARNING_TIME: Final = 2.0
DRIVER_TIME: Final = 4.0
LEAST_INDICATION: Final = 5.0
MOST_ACCELERATION: Final = 0.4
"""Above it an acceleration counts only while traction may last, m/s²."""


class Times(NamedTuple):
    """Times that the limits are apart, [s]."""

    emergency: float
    service_1: float
    service_2: float
    traction: float
    remaining: float
    indication: float


def times_of(train: SupervisedTrain, driver_reacts: bool = False) -> Times:
    """Return the times between the limits.

    Parameters
    ----------
    train : SupervisedTrain
        Its brake times and interfaces.
    driver_reacts : bool
        Whether T_driver is part of T_indication (SUBSET-026 v4; v3.4 and ERA's tool: not).

    Returns
    -------
    Times
        T_be, T_bs1, T_bs2, T_traction, T_berem, T_indication.

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.9.3.2.3, 3.13.9.3.2.6, 3.13.9.3.3, 3.13.9.3.6.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import constant
    >>> from railgrip.control.etcs.train_data import Brakes
    >>> brakes = Brakes(constant(1.0), constant(1.0), 2.5, 2.5)
    >>> times_of(SupervisedTrain(200.0, brakes, traction_cut_off_time=2.0)).remaining
    0.5
    """
    brakes = train.brakes
    service = brakes.service_time if train.commands_service_brake else 0.0
    traction = train.traction_cut_off_time
    if train.cuts_traction:
        traction = max(traction - (WARNING_TIME + service), 0.0)
    # The driver's brake fills as slowly whether or not the supervision commands it.
    indication = max(0.8 * brakes.service_time, LEAST_INDICATION)
    return Times(
        emergency=brakes.emergency_time,
        service_1=service,
        service_2=service,
        traction=traction,
        remaining=max(brakes.emergency_time - traction, 0.0),
        indication=indication + (DRIVER_TIME if driver_reacts else 0.0),
    )


def at_full_brake(
    train: SupervisedTrain, times: Times, target: Target, speed: Array
) -> tuple[Array, Array]:
    """Return the speed when the brake is fully applied, and the way until then.

    Parameters
    ----------
    train, times, target : SupervisedTrain, Times, Target
        What the supervision knows.
    speed : ndarray (speed)
        Estimated, [m/s].

    Returns
    -------
    (ndarray, ndarray)
        V_bec, [m/s]; D_bec, [m].

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.9.3.2.10.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import constant
    >>> from railgrip.control.etcs.train_data import Brakes
    >>> brakes = Brakes(constant(1.0), constant(1.0), 3.0, 3.0)
    >>> train = SupervisedTrain(200.0, brakes, traction_cut_off_time=1.0, acceleration=0.5)
    >>> speed, way = at_full_brake(train, times_of(train), Target(5e3), np.array([40.0]))
    >>> float(speed[0]), round(float(way[0]), 6)
    (41.3, 122.05)
    """
    error = np.zeros_like(speed)
    if train.compensates_speed:
        error = np.vectorize(speed_inaccuracy, otypes=[float])(speed)
    gained = max(train.acceleration, 0.0) * times.traction
    later = min(max(train.acceleration, 0.0), MOST_ACCELERATION) * times.remaining
    driven = np.maximum(speed + error + gained, target.speed)
    halfway = np.maximum(speed + error + 0.5 * gained, target.speed)
    return driven + later, halfway * times.traction + (driven + 0.5 * later) * times.remaining
