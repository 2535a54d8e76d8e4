"""The coasting-initiation law as a driving law: what the class says, in the kernel's words."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.control.coasting.coasting_law import (
    AT_THE_CURVE,
    AT_THE_TARGET,
    NO_LIMIT,
    AnnouncedTarget,
    CoastingLaw,
)
from railgrip.control.coasting.coasting_parameters import (
    ACTIONS,
    AT_STATIONS,
    SHAPES,
    check_coasting,
)
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.journey.drive import DrivingLaw, JourneyRun
from railgrip.engine.journey.forces import HOLD
from railgrip.engine.journey.legs import Leg, braking_of, legs
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

(
    BRAKING, SHAPE, OWN_DECELERATION, DISTANCE_GAIN, SPEED_GAIN, HYSTERESIS, ACTION, REDUCED, LIGHT,
    LEAST_SPEED, STATION, HOLDS, LIFT, KNEE, IS_ON, STATION_DISTANCE, TARGETS,
) = range(17)  # fmt: skip
"""Places in the parameters; from `TARGETS` on pairs of position and speed."""
FLAT_OUT_NUMBERS = np.zeros(TARGETS + 2)
"""Parameters with which the law is off, and its only target out of reach."""
FLAT_OUT_NUMBERS[[BRAKING, TARGETS]] = 1.0, 1e12
CUT, REDUCED_TRACTION, LIGHT_BRAKING = range(3)


def coasting_demand(
    position: float, speed: float, parameters: Any, state: Any, demand: Any
) -> None:
    """Demand what the coasting-initiation law leaves; see `CoastingLaw.step`."""
    p = parameters
    limit, curve, is_passed = NO_LIMIT, NO_LIMIT, True
    for k in range(TARGETS, len(p), 2):
        distance, target_speed = p[k] - position, p[k + 1]
        if distance > AT_THE_TARGET:
            is_passed = False
            square = target_speed * target_speed
            braking = math.sqrt(square + 2.0 * p[BRAKING] * distance)
            own = math.sqrt(square + 2.0 * p[OWN_DECELERATION] * distance)
            if p[SHAPE] > 0.0:
                own = p[DISTANCE_GAIN] * distance + p[SPEED_GAIN] * target_speed
            if own > p[KNEE]:
                own += p[LIFT] * (own - p[KNEE])
            limit = min(limit, braking)
            curve = min(curve, min(own, braking))
    must_brake = speed - limit >= -AT_THE_CURVE
    above = speed - p[LEAST_SPEED]
    is_slow = False
    if p[LEAST_SPEED] > 0.0:
        is_slow = above < AT_THE_CURVE
        if state[1] > 0.0:
            is_slow = above - p[HYSTERESIS] < -AT_THE_CURVE
    to_station = p[STATION] - position
    near = to_station > AT_THE_TARGET and to_station - p[STATION_DISTANCE] <= AT_THE_TARGET
    acts = speed - curve >= -AT_THE_CURVE
    if state[0] > 0.0:
        acts = speed - curve + p[HYSTERESIS] > AT_THE_CURVE
    acts = acts and p[IS_ON] > 0.0 and not is_slow and not near and not must_brake
    # at the braking curve, and where it ends, the ceiling brakes: no last pull
    demand[0], demand[1] = 0.0 if must_brake or is_passed else 1.0, 0.0
    if acts:
        demand[0] = p[REDUCED] if p[ACTION] == REDUCED_TRACTION else 0.0
        demand[1] = p[LIGHT] if p[ACTION] == LIGHT_BRAKING else 0.0
    elif near and not must_brake and p[IS_ON] > 0.0 and p[HOLDS] > 0.0:
        demand[0] = HOLD
    demand[2] = 1.0 if acts else 0.0
    demand[3] = 1.0 if is_slow else 0.0


def coasting_of(journey: Journey) -> DrivingLaw:
    """Return the coasting-initiation of a journey as a driving law.

    Parameters
    ----------
    journey : Journey
        With a table ``coasting`` and a deceleration of the braking curves.

    Raises
    ------
    RailgripError
        ``coasting: is missing``; what `check_coasting` finds, with the key paths of the journey.

    Examples
    --------
    >>> from railgrip.engine.journey.drive import drive
    >>> journey = Journey(train="local", line="const", coasting={"coasting_deceleration": 0.1})
    >>> flat_out, coasting = drive(journey), drive(journey, coasting_of(journey))
    >>> f"{coasting.running_time / flat_out.running_time:.3f}"
    '1.059'
    """
    law = _checked(journey)
    assert journey.coasting is not None
    own, p = journey.coasting, law.parameters
    is_raised = p.braking < p.flat_braking
    first = [
        p.braking, float(SHAPES.index(p.shape)), p.coasting_deceleration, p.distance_gain,
        p.speed_gain, p.hysteresis, float(ACTIONS.index(p.action)), p.reduced_share,
        p.light_deceleration, p.least_speed, 0.0, float(AT_STATIONS.index(p.at_station)),
        p.lift if is_raised else 0.0, p.knee_speed, float(own.is_switched_on), p.station_distance,
    ]  # fmt: skip

    def setup(leg: Leg) -> tuple[Array, Array]:
        numbers = np.array([*first, *(number for target in leg.targets for number in target)])
        numbers[STATION] = leg.end if leg.is_stop else -np.inf
        return numbers, np.zeros(2)

    return DrivingLaw(coasting_demand, setup)


class Indicated(NamedTuple):
    """An entry of the log: where an indicator of the coasting law changed."""

    time: float
    position: float
    speed: float
    is_ready: bool
    is_acting: bool


def indicators(run: JourneyRun) -> list[Indicated]:
    """Return where the two indicators of the law changed on a run that obeyed it.

    Notes
    -----
    Told by `CoastingLaw` itself at every step of the run, so that a test can hold both forms of
    the law against each other.
    """
    law, switched = _checked(run.journey), run.journey.coasting
    assert switched is not None
    trace, log, end = run.trace, list[Indicated](), np.nan
    firsts = [first for first, _ in run.told] + [trace["time"].size]
    for (first, leg), until in zip(run.told, firsts[1:], strict=True):
        if leg.end != end:
            law.reset()
            end = leg.end
        targets = announced(leg)
        here = slice(first, until)
        columns = [trace[name][here].tolist() for name in ("time", "position", "speed")]
        for time, position, speed in zip(*columns, strict=True):
            if position >= leg.end:
                continue
            told = law.step(
                position, speed, targets,
                by_hand=switched.by_hand, by_control=switched.by_control,
            )  # fmt: skip
            if not log or (log[-1].is_ready, log[-1].is_acting) != (told.is_ready, told.is_acting):
                log.append(Indicated(time, position, speed, told.is_ready, told.is_acting))
    return log


def announced(leg: Leg) -> list[AnnouncedTarget]:
    """Return the targets of a leg as the law is told them."""
    return [AnnouncedTarget(at, speed, leg.is_stop and at == leg.end) for at, speed in leg.targets]


def coasting_curve(journey: Journey, points: int = 400) -> tuple[Array, Array, Array]:
    """Return positions, and there braking curve and coasting-initiation curve, m and m/s."""
    law, rows = _checked(journey), []
    for leg in legs(journey):
        targets = announced(leg)
        marks = [one.position - offset for one in targets for offset in (0.0, 0.01)]
        places = np.unique([*np.linspace(leg.begin, leg.end, points), *marks])
        for at in places[(places >= leg.begin) & (places < leg.end)]:
            ahead = [one for one in targets if one.position > at]
            rows.append((at, law.braking_speed(at, ahead), law.coasting_speed(at, ahead)))
    table = np.array(rows)
    return table[:, 0], table[:, 1], table[:, 2]


def _checked(journey: Journey) -> CoastingLaw:
    if journey.coasting is None:
        raise RailgripError(Problem("coasting", "is missing", cure="a table [coasting]"))
    parameters = journey.coasting.parameters(braking_of(journey))
    try:
        check_coasting(parameters)
    except RailgripError as error:
        raise RailgripError(
            [
                one if one.where == "braking" else replace(one, where=f"coasting.{one.where}")
                for one in error.problems
            ]
        ) from None
    return CoastingLaw(parameters)
