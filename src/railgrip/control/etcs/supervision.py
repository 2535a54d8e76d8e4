"""Supervision limits over the speed, as distances before the target (SUBSET-026, 3.13.8, 3.13.9)."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.control.etcs.ceiling import (
    EMERGENCY,
    SERVICE,
    WARNING,
    ceiling_margin,
    speed_inaccuracy,
)
from railgrip.control.etcs.deceleration_curve import DecelerationCurve, deceleration_curve
from railgrip.control.etcs.deceleration_field import DecelerationField
from railgrip.control.etcs.gradient_acceleration import gradient_under_train
from railgrip.control.etcs.steps import Steps
from railgrip.control.etcs.train_data import SupervisedTrain, Target, Track

Array = NDArray[np.float64]
WARNING_TIME: Final = 2.0
DRIVER_TIME: Final = 4.0
LEAST_INDICATION: Final = 5.0
MOST_ACCELERATION: Final = 0.4
"""Above it an acceleration counts only while traction may last, m/s²."""


class SupervisionLimits(NamedTuple):
    """Curves and limits over the speed; each a distance before the target, NaN where it has none.

    Parameters
    ----------
    speed : ndarray (speed)
        [m/s].
    ebd, sbd, gui : ndarray (speed)
        Deceleration curves: emergency, service, guidance, [m].
    ebi, sbi1, sbi2, warning, permitted, indication : ndarray (speed)
        Limits for the estimated speed, [m].
    """

    speed: Array
    ebd: Array
    sbd: Array
    gui: Array
    ebi: Array
    sbi1: Array
    sbi2: Array
    warning: Array
    permitted: Array
    indication: Array


CURVES: Final = SupervisionLimits._fields[1:]


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


def supervision_limits(
    train: SupervisedTrain,
    track: Track,
    target: Target,
    speeds: ArrayLike,
    *,
    driver_reacts: bool = False,
    ceiling: float | None = None,
    release_speed: float = 0.0,
) -> SupervisionLimits:
    """Return all curves and limits for one target.

    Parameters
    ----------
    train, track, target : SupervisedTrain, Track, Target
        What the supervision knows.
    speeds : array_like (speed)
        Estimated speeds, ≥ 0, [m/s].
    driver_reacts : bool
        Whether T_driver is part of T_indication.
    ceiling : float, optional
        Speed limit before the target: above it, and its margins, a limit has no place, [m/s].
    release_speed : float
        Up to it only the deceleration curves are told (end of authority), [m/s].

    Returns
    -------
    SupervisionLimits
        Over the speeds.

    Raises
    ------
    RailgripError
        Where the brake does not slow the train on the gradient.

    Notes
    -----
    ``V_bec = max(V + VΔ0 + VΔ1, V_target) + VΔ2``, ``d_EBI = d_EBD(V_bec) − D_bec``; the service
    brake intervenes a build-up time before SBD and EBI, warning and permitted speed lie 2 and 4 s
    before the first intervention, the indication T_indication before the permitted speed.

    Known wrong when: the service brake's pressure is fed back, build-up times are reduced as in
    v4 (A.3.12), or special brakes change along the track.

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.8 and 3.13.9.

    Checked by tests/reference/etcs_era_tool: 14 cases of ERA's tool, 0.25 m.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import constant
    >>> from railgrip.control.etcs.train_data import Brakes
    >>> train = SupervisedTrain(200.0, Brakes(constant(1.0), constant(1.0), 2.5, 2.5))
    >>> limits = supervision_limits(train, Track(constant(0.0)), Target(5000.0), 40.0)
    >>> float(limits.ebd), float(limits.ebi), float(limits.permitted), float(limits.indication)
    (800.0, 900.0, 1060.0, 1260.0)
    """
    speed = np.asarray(speeds, dtype=float)
    times = times_of(train, driver_reacts)
    shifted, run = _at_full_brake(train, times, target, speed)
    top = max(float(np.max(shifted)), float(np.max(speed)), target.speed) + 1.0
    emergency = emergency_curve(train, track, target, top)
    ebd = _before(target, emergency, speed)
    ebi = target.position - (emergency.position_at(shifted) - run)
    sbi2 = ebi + times.service_2 * speed
    sbd = sbi1 = np.full_like(speed, np.nan)
    if target.is_end_of_authority:
        service = _curve(train, track, train.brakes.service, target.position, 0.0, top, "SBD")
        sbd = _before(target, service, speed)
        sbi1 = sbd + times.service_1 * speed
    first = np.fmax(sbi1, sbi2)
    gui = guidance_distances(train, track, target, times, emergency, speed)
    free = np.fmax(first + DRIVER_TIME * speed, gui)
    permitted = free if target.is_end_of_authority else np.maximum(free, 0.0)
    found = {
        "ebd": ebd, "sbd": sbd, "gui": gui, "ebi": ebi, "sbi1": sbi1, "sbi2": sbi2,
        "warning": first + WARNING_TIME * speed, "permitted": permitted,
        "indication": free + times.indication * speed,
    }  # fmt: skip
    below = speed < target.speed - 1e-9
    released = target.is_end_of_authority & (speed < release_speed - 1e-9)
    for name, values in found.items():
        hidden = below | _above(name, speed, ceiling)
        if name not in ("ebd", "sbd", "gui"):
            hidden = hidden | released
        found[name] = np.where(hidden, np.nan, values)
    return SupervisionLimits(speed=speed, **found)


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
    return _curve(train, track, train.brakes.safe, position, speed, top, "EBD", low=low)


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
    field = _field(train, track, brakes.normal_service)._replace(
        cap=Steps((0.0,), (float("inf"),)), uphill=brakes.uphill, downhill=brakes.downhill
    )
    top = max(float(np.max(speed)), target.speed) + 1.0
    curve = deceleration_curve(
        field, foot, target.speed, lowest=target.speed, highest=top, name="GUI"
    )
    return _before(target, curve, speed)


def _field(train: SupervisedTrain, track: Track, brake: Steps) -> DecelerationField:
    gradient = gradient_under_train(track.gradient, train.length)
    return DecelerationField(brake, gradient, train.rotating_mass)


def _curve(
    train: SupervisedTrain,
    track: Track,
    brake: Steps,
    position: float,
    speed: float,
    top: float,
    name: str,
    low: float = 0.0,
) -> DecelerationCurve:
    field = _field(train, track, brake)
    if name == "EBD":  # what is expected of the service brake takes no worst case
        field = field._replace(cap=track.cap)
    return deceleration_curve(
        field, position, speed, lowest=low, highest=max(top, speed + 1.0), name=name
    )


def _before(target: Target, curve: DecelerationCurve, speed: Array) -> Array:
    return np.asarray(target.position - curve.position_at(speed))


def _at_full_brake(
    train: SupervisedTrain, times: Times, target: Target, speed: Array
) -> tuple[Array, Array]:
    """Return the speed when the brake is fully applied and the way until then."""
    error = np.zeros_like(speed)
    if train.compensates_speed:
        error = np.vectorize(speed_inaccuracy, otypes=[float])(speed)
    gained = max(train.acceleration, 0.0) * times.traction
    later = min(max(train.acceleration, 0.0), MOST_ACCELERATION) * times.remaining
    driven = np.maximum(speed + error + gained, target.speed)
    halfway = np.maximum(speed + error + 0.5 * gained, target.speed)
    return driven + later, halfway * times.traction + (driven + 0.5 * later) * times.remaining


def _above(name: str, speed: Array, ceiling: float | None) -> NDArray[np.bool_]:
    """Return where the ceiling supervision has intervened before the limit could."""
    margins = {"ebi": EMERGENCY, "sbi1": SERVICE, "sbi2": SERVICE, "warning": WARNING}
    if ceiling is None or name in ("ebd", "sbd", "gui"):
        return np.zeros(speed.shape, dtype=bool)
    margin = ceiling_margin(ceiling, margins[name]) if name in margins else 0.0
    return np.asarray(speed > ceiling + margin + 1e-9)
