"""Deceleration curves of a train to a target: EBD, SBD (SUBSET-026, 3.13.8)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from railgrip.control.etcs.ceiling import EMERGENCY, ceiling_margin
from railgrip.control.etcs.deceleration_curve import DecelerationCurve, deceleration_curve
from railgrip.control.etcs.deceleration_field import DecelerationField
from railgrip.control.etcs.gradient_acceleration import gradient_under_train
from railgrip.control.etcs.steps import Steps
from railgrip.control.etcs.train_data import SupervisedTrain, Target, Track

Array = NDArray[np.float64]


def emergency_curve(
    train: SupervisedTrain, track: Track, target: Target, top: float
) -> DecelerationCurve:
    """Return the EBD of a target up to a speed.

    Parameters
    ----------
    train, track, target : SupervisedTrain, Track, Target
        What the supervision knows.
    top : float
        Speed up to which it is wanted, [m/s].

    Returns
    -------
    DecelerationCurve
        To standstill at the supervised location; or, to a speed limit, through the ceiling's EBI
        at the target and on to the target speed.

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.8.3.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import constant
    >>> from railgrip.control.etcs.train_data import Brakes
    >>> train = SupervisedTrain(200.0, Brakes(constant(1.0), constant(1.0), 2.5, 2.5))
    >>> curve = emergency_curve(train, Track(constant(0.0)), Target(5000.0, 20.0, False), 50.0)
    >>> round(float(curve.position_at(20.0)), 3)
    5043.837
    """
    position, speed = target.position, target.speed + ceiling_margin(target.speed, EMERGENCY)
    if target.is_end_of_authority:
        location = target.supervised_location
        position, speed = target.position if location is None else location, 0.0
    low = 0.0 if target.is_end_of_authority else target.speed
    return train_curve(train, track, train.brakes.safe, position, speed, top, "EBD", low=low)


def brake_field(train: SupervisedTrain, track: Track, brake: Steps) -> DecelerationField:
    """Return what slows a train with one of its brakes on the track."""
    gradient = gradient_under_train(track.gradient, train.length)
    return DecelerationField(brake, gradient, train.rotating_mass)


def train_curve(
    train: SupervisedTrain,
    track: Track,
    brake: Steps,
    position: float,
    speed: float,
    top: float,
    name: str,
    low: float = 0.0,
) -> DecelerationCurve:
    """Return the curve of one brake through a point, between two speeds."""
    field = brake_field(train, track, brake)
    if name == "EBD":  # what is expected of the service brake takes no worst case
        field = field._replace(cap=track.cap)
    return deceleration_curve(
        field, position, speed, lowest=low, highest=max(top, speed + 1.0), name=name
    )


def before_target(target: Target, curve: DecelerationCurve, speed: Array) -> Array:
    """Return how far before the target a curve has its speeds."""
    return np.asarray(target.position - curve.position_at(speed))
