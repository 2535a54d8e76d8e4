"""Drives a journey behind another train, whose record is the authority to move."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from railgrip.control.coasting.moving_authority import MovingAuthority, moving_authority
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.journey import kernel
from railgrip.engine.journey.drive import (
    FLAT_OUT,
    DrivingLaw,
    JourneyRun,
    braking_of,
    check_end,
    drive,
    leg_of,
    rows_for,
    run_of,
)
from railgrip.engine.journey.forces import train_arrays
from railgrip.engine.journey.profile import Sections, ceiling
from railgrip.engine.journey.steps import SCRATCH
from railgrip.engine.plug_ins import first_class
from railgrip.scenario.explain import problems_of
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

WORTH_MOVING = 0.01
"""An authority that ends nearer than this lets a standing train stand, m."""


class Authority(NamedTuple):
    """How far a train may go, over the time since it could set off.

    Parameters
    ----------
    record : MovingAuthority
        Behind the leading train, renewed after a period above 0.
    free_from : float
        When the leading train has left the track, [s].
    """

    record: MovingAuthority
    free_from: float = math.inf

    def end(self, time: float) -> float:
        """Return the end of authority that is known at a time, [m]."""
        known = self.record.period * math.floor(time / self.record.period + 1e-9)
        return math.inf if known >= self.free_from else self.record.target(time).position


def leading(journey: Journey) -> JourneyRun:
    """Return the run of the leading train of a journey, flat out on the same line."""
    leader = journey.leader
    if leader is None:
        raise RailgripError(Problem("leader", "is missing", cure="a table [leader]"))
    try:
        ahead = Journey(
            train=leader.train, line=journey.line, stop=leader.stop or journey.stops(),
            passing_speed=leader.passing_speed, braking=leader.braking,
            gradient_under=journey.gradient_under, curve_resistance=journey.curve_resistance,
        )  # fmt: skip
        return drive(ahead)
    except ValidationError as error:
        found = problems_of(error, Journey)
    except RailgripError as error:
        found = error.problems
    raise RailgripError([replace(one, where=f"leader.{one.where}".rstrip(".")) for one in found])


def authority_of(journey: Journey, ahead: JourneyRun | None = None) -> Authority:
    """Return the authority behind the leading train of a journey.

    Parameters
    ----------
    journey : Journey
        With a table ``leader``.
    ahead : JourneyRun, optional
        The leader's run, if it is known; absent: `leading`.

    Raises
    ------
    RailgripError
        ``leader.headway: the train would set off inside the leading train or its margin; got
        10 s; allowed: from 33.4 s``

    Notes
    -----
    The record is straight between the steps of the leader's run: at most a (1 s)²/8 before the
    train itself where it accelerates, well within any margin.
    """
    ahead = leading(journey) if ahead is None else ahead
    leader = journey.leader
    assert leader is not None
    moments, kept = np.unique(ahead.trace["time"], return_index=True)
    front = np.maximum.accumulate(ahead.trace["position"][kept])
    length = ahead.journey.train.length
    free = float(moments[-1]) + leader.clears_after
    needed = journey.stops()[0].at + length + leader.margin
    if front[-1] > needed:
        least = min(float(np.interp(needed, *_rising(front, moments))), free)
    else:
        least = free
    if leader.headway <= least and leader.headway < free:
        raise RailgripError(
            Problem(
                "leader.headway",
                "the train would set off inside the leading train or its margin",
                got=f"{leader.headway:g} s",
                allowed=f"above {least:.1f} s",
            )
        )
    record = moving_authority(
        moments - leader.headway, front, length=length, margin=leader.margin,
        period=leader.renewal,
    )  # fmt: skip
    return Authority(record, free - leader.headway)


def follow(
    journey: Journey, law: DrivingLaw = FLAT_OUT, authority: Authority | None = None
) -> JourneyRun:
    """Drive a journey behind another train, without slip.

    Parameters
    ----------
    journey : Journey
        As for `drive`; its table ``leader`` says what runs ahead.
    law : DrivingLaw
        What to demand below the permitted speed; full power if nothing else is said. It is told
        the end of authority as a target with speed 0, and keeps its state when that is renewed.
    authority : Authority, optional
        Instead of what the leader's run gives.

    Returns
    -------
    run : JourneyRun
        Running times are from the departure on, with what the train stands at ends of authority.

    Raises
    ------
    RailgripError
        What `drive` and `authority_of` find.

    Notes
    -----
    At each renewal the braking curves are drawn anew, to the end of authority or the next stop,
    whichever is nearer; the march between is that of `drive`, cut at the renewal's moment.

    Checked by tests/agreement/test_following.py against the exact run of the laboratory.

    Examples
    --------
    >>> slow = {"train": "freight", "headway": 300.0}
    >>> behind = Journey(train="longdistance", line="const", leader=slow)
    >>> run = follow(behind)
    >>> round(drive(behind).running_time), round(run.running_time), run.switchings
    (331, 561, 76)
    """
    authority = authority_of(journey) if authority is None else authority
    march = _March(journey, law, authority)
    stops = journey.stops()
    times = []
    for k, (here, there) in enumerate(pairwise(stops)):
        first = journey.passing_speed if k == 0 else 0.0
        final = journey.passing_speed if k == len(stops) - 2 else 0.0
        begun = march.clock
        march.leg(here.at, there.at, first, final)
        times.append(march.clock - begun)
        march.clock += there.dwell
    rows = np.concatenate(march.traces)
    pulls = np.concatenate([[False], rows[:, kernel.TRACTION] > 0.0])
    march.totals[kernel.SWITCHINGS] = float(np.count_nonzero(np.diff(pulls)))
    return run_of(journey, rows, np.array(times), march.totals)


class _March:
    """The march from renewal to renewal."""

    def __init__(self, journey: Journey, law: DrivingLaw, authority: Authority) -> None:
        self.journey, self.law, self.authority = journey, law, authority
        self.deceleration = braking_of(journey)
        self.train, self.sections = train_arrays(journey.train), Sections(journey)
        self.called = first_class(law.demand, kernel.LAW)
        self.totals, self.traces, self.clock = np.zeros(kernel.TOTALS), list[Array](), 0.0

    def leg(self, place: float, stop: float, speed: float, final: float) -> None:
        """Drive from a place to the next stop."""
        state: Array | None = None
        period = self.authority.record.period
        while True:
            renewal = period * (math.floor(self.clock / period + 1e-9) + 1)
            end = min(self.authority.end(self.clock), stop)
            if end - place < WORTH_MOVING and end < stop:
                self.clock = renewal
                continue
            aim = final if end == stop else 0.0
            lid = ceiling(self.journey, place, end, aim, self.deceleration)
            if speed**2 > lid[1][0] * (1.0 + 1e-6):
                what = "is above what is permitted there, or what the authority leaves"
                raise RailgripError(Problem("passing_speed", what, got=f"{speed:g} m/s"))
            # the law knows its next stop, and all targets up to the end of authority
            told = leg_of(lid, self.deceleration, final == 0.0)._replace(end=stop)
            parameters, first = self.law.setup(told)
            state = first if state is None else state
            # what the renewal itself changes is known before anything moves
            demand = np.zeros(2 + state.size)
            self.law.demand(place, speed, parameters, state, demand)
            state = demand[2:].copy()
            until = math.inf if end == stop and end < math.inf else renewal - self.clock
            rows = np.zeros((rows_for(lid, self.sections, self.journey), kernel.COLUMNS))
            found = np.zeros(4)
            status = kernel.march(
                self.train, self.sections.position, self.sections.slope,
                self.sections.slope_change, self.sections.drag,
                *lid, self.called, parameters, state, speed, self.journey.step, until,
                rows, self.totals, np.zeros(SCRATCH + 2 * (2 + state.size)), found,
            )  # fmt: skip
            check_end(status, found, self.deceleration)
            part = rows[: int(found[0])]
            part[:, kernel.TIME] += self.clock
            self.traces.append(part)
            place, speed = float(found[2]), float(found[3])
            if status == kernel.TIME_IS_UP:
                self.clock = renewal
                continue
            self.clock += float(found[1])
            if end == stop:
                return
            place, speed = end, 0.0


def _rising(front: Array, moments: Array) -> tuple[Array, Array]:
    """Return positions that rise, each with the last moment at which the front was there."""
    last = np.append(np.diff(front) > 0.0, True)
    return front[last], moments[last]
