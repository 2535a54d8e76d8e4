"""Supervision limits over the speed, as distances before the target (SUBSET-026, 3.13.9)."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.control.etcs.ceiling import EMERGENCY, SERVICE, WARNING, ceiling_margin
from railgrip.control.etcs.curves import before_target, emergency_curve, train_curve
from railgrip.control.etcs.guidance import guidance_distances
from railgrip.control.etcs.intervention_times import (
    DRIVER_TIME,
    WARNING_TIME,
    at_full_brake,
    times_of,
)
from railgrip.control.etcs.train_data import SupervisedTrain, Target, Track

Array = NDArray[np.float64]
CEILINGS: Final = {"ebi": EMERGENCY, "sbi1": SERVICE, "sbi2": SERVICE, "warning": WARNING}


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
        Speed limit before the target: above it, and its margins, a limit has no place; the
        indication stays where it is at the ceiling, [m/s].
    release_speed : float
        Below it an end of authority has no limits, and where it is supervised neither SBI1 nor
        EBI begins nearer than its first intervention, [m/s].

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
    found = _unbounded(train, track, target, speed, driver_reacts)
    if target.is_end_of_authority and release_speed > 0.0:
        at_release = _unbounded(train, track, target, np.array([release_speed]), driver_reacts)
        _release(found, speed, release_speed, float(_first(at_release)[0]))
    if ceiling is not None:
        at_ceiling = _unbounded(train, track, target, np.array([ceiling]), driver_reacts)
        _bound(found, speed, ceiling, float(at_ceiling["indication"][0]))
    below = speed < target.speed - 1e-9
    return SupervisionLimits(
        speed=speed, **{name: np.where(below, np.nan, found[name]) for name in CURVES}
    )


def _unbounded(
    train: SupervisedTrain, track: Track, target: Target, speed: Array, driver_reacts: bool
) -> dict[str, Array]:
    """Return curves and limits as if there were no ceiling and no release speed."""
    times = times_of(train, driver_reacts)
    shifted, run = at_full_brake(train, times, target, speed)
    top = max(float(np.max(shifted)), float(np.max(speed)), target.speed) + 1.0
    emergency = emergency_curve(train, track, target, top)
    found = {"ebd": before_target(target, emergency, speed)}
    found["ebi"] = target.position - (emergency.position_at(shifted) - run)
    found["sbi2"] = found["ebi"] + times.service_2 * speed
    found["sbd"] = found["sbi1"] = np.full_like(speed, np.nan)
    if target.is_end_of_authority:
        brake = train.brakes.service
        service = train_curve(train, track, brake, target.position, 0.0, top, "SBD")
        found["sbd"] = before_target(target, service, speed)
        found["sbi1"] = found["sbd"] + times.service_1 * speed
    found["gui"] = guidance_distances(train, track, target, times, emergency, speed)
    found["warning"] = _first(found) + WARNING_TIME * speed
    free = np.fmax(_first(found) + DRIVER_TIME * speed, found["gui"])
    found["permitted"] = free if target.is_end_of_authority else np.maximum(free, 0.0)
    found["indication"] = free + times.indication * speed
    return found


def _first(found: dict[str, Array]) -> Array:
    """Return where the first intervention is."""
    return np.asarray(np.fmax(found["sbi1"], found["sbi2"]))


def _release(found: dict[str, Array], speed: Array, release_speed: float, begin: float) -> None:
    """Leave the stretch where the release speed is supervised to it."""
    found["ebi"] = np.maximum(found["ebi"], begin)
    found["sbi1"] = np.where(found["sbi1"] < begin, np.nan, found["sbi1"])
    slower = speed < release_speed - 1e-9
    for name in ("ebi", "sbi1", "sbi2", "warning", "permitted", "indication"):
        found[name] = np.where(slower, np.nan, found[name])


def _bound(found: dict[str, Array], speed: Array, ceiling: float, indication: float) -> None:
    """Hide what the ceiling supervision has come before."""
    for name in ("ebi", "sbi1", "sbi2", "warning", "permitted"):
        margin = ceiling_margin(ceiling, CEILINGS[name]) if name in CEILINGS else 0.0
        found[name] = np.where(speed > ceiling + margin + 1e-9, np.nan, found[name])
    held = np.where(speed > ceiling, indication, found["indication"])
    over = speed > ceiling + ceiling_margin(ceiling, EMERGENCY) + 1e-9
    found["indication"] = np.where(over, np.nan, held)
