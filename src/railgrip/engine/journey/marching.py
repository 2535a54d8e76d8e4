"""The march of a journey in parts: from renewal to renewal, from intervention to intervention."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.control.coasting.moving_authority import MovingAuthority
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.journey import kernel
from railgrip.engine.journey.drive import (
    DrivingLaw,
    JourneyRun,
    check_end,
    check_passing,
    rows_for,
    run_of,
)
from railgrip.engine.journey.forces import train_arrays
from railgrip.engine.journey.legs import Leg, braking_of, leg_of
from railgrip.engine.journey.profile import Sections, ceiling
from railgrip.engine.journey.steps import SCRATCH
from railgrip.engine.journey.supervision import Onboard
from railgrip.engine.plug_ins import first_class
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

WORTH_MOVING = 0.01
"""An authority that ends nearer than this lets a standing train stand, m."""


class Authority(NamedTuple):
    """How far a train may go, over the time since it could set off.

    Parameters
    ----------
    record : MovingAuthority, optional
        Behind the leading train; absent: the line is free.
    free_from : float
        When the leading train has left the track, [s].
    """

    record: MovingAuthority | None = None
    free_from: float = math.inf

    def end(self, time: float) -> float:
        """Return the end of authority that is known at a time, [m]."""
        if self.record is None:
            return math.inf
        known, period = time, self.record.period
        if period > 0.0:
            known = period * math.floor(time / period + 1e-9)
        return math.inf if known >= self.free_from else self.record.target(time).position

    def next_renewal(self, time: float) -> float:
        """Return when another end of authority is known, [s]."""
        return math.inf if self.record is None else self.record.next_renewal(time)


class Part(NamedTuple):
    """What one call of the kernel did."""

    status: int
    rows: Array
    state: Array
    totals: Array
    time: float
    place: float
    speed: float


class March:
    """A journey under way.

    Parameters
    ----------
    journey : Journey
        What is asked.
    law : DrivingLaw
        What to demand below the permitted speed.
    authority : Authority
        Behind a leading train, or free.
    """

    def __init__(self, journey: Journey, law: DrivingLaw, authority: Authority) -> None:
        self.journey, self.law, self.authority = journey, law, authority
        self.deceleration = braking_of(journey)
        self.train, self.sections = train_arrays(journey.train), Sections(journey)
        self.called = first_class(law.demand, kernel.LAW)
        own = journey.supervision
        self.onboard = None if own is None or own.mode == "report" else Onboard(journey)
        self.totals, self.traces, self.clock = np.zeros(kernel.TOTALS), list[Array](), 0.0
        self.told, self.state = list[tuple[int, Leg]](), np.zeros(0)
        self.place, self.speed = journey.stops()[0].at, journey.passing_speed

    def run(self) -> JourneyRun:
        """Drive from the first stop to the last."""
        stops, times = self.journey.stops(), []
        for k, there in enumerate(stops[1:]):
            begun = self.clock
            self.leg(there.at, self.journey.passing_speed if k == len(stops) - 2 else 0.0)
            times.append(self.clock - begun)
            self.clock += there.dwell
            self.speed = 0.0
        rows = np.concatenate(self.traces)
        pulls = np.concatenate([[False], rows[:, kernel.TRACTION] > 0.0])
        self.totals[kernel.SWITCHINGS] = float(np.count_nonzero(np.diff(pulls)))
        return run_of(self.journey, rows, np.array(times), self.totals, self.told)

    def leg(self, stop: float, final: float, *, is_first: bool = True) -> None:
        """Drive to the next stop."""
        while True:
            renewal = self.authority.next_renewal(self.clock)
            known = self.authority.end(self.clock)
            end = min(known, stop)
            if end - self.place < WORTH_MOVING:
                if end == stop:
                    return
                self.clock = self._waited(renewal)
                continue
            lid = self.ceiling(known, end, stop, final)
            if lid[1][0] <= 0.0:
                self.clock = self._waited(renewal)
                continue
            if is_first:
                check_passing(self.speed, lid)
            # the law knows its next stop, and all targets up to the end of authority
            told = leg_of(lid, self.deceleration, final == 0.0)
            told = told._replace(end=stop, authority=known)
            parameters, first = self.law.setup(told)
            state = first if is_first else self.state
            # what the renewal itself changes is known before anything moves
            demand = np.zeros(2 + state.size)
            self.law.demand(self.place, self.speed, parameters, state, demand)
            self.state, is_first = demand[2:].copy(), False
            until = math.inf if end == stop and end < math.inf else renewal - self.clock
            self.told.append((sum(map(len, self.traces)), told))
            if self.go(told, parameters, until, end):
                continue
            if end == stop:
                return

    def _waited(self, renewal: float) -> float:
        if math.isinf(renewal):
            what = "the train may not go on, and nothing more is announced"
            raise RailgripError(Problem("", what, got=f"a stand at {self.place:.1f} m"))
        return renewal

    def ceiling(
        self, known: float, end: float, stop: float, final: float
    ) -> tuple[Array, Array, Array]:
        """Return the highest square of speed from here to the end of what is known."""
        aim = final if end == stop else 0.0
        if self.onboard is None:
            return ceiling(self.journey, self.place, end, aim, self.deceleration)
        way = self.onboard.way(known, stop, final == 0.0)
        return self.onboard.ceiling(way, self.place, end, aim)

    def go(self, told: Leg, parameters: Array, until: float, end: float) -> bool:
        """March on; return whether there is more of the leg, as known, to be driven."""
        return self.take(self.part(told, parameters, until), end)

    def take(self, part: Part, end: float) -> bool:
        """Accept a part up to its own end; return whether a renewal ended it before the leg."""
        self.accept(part)
        if part.status == kernel.TIME_IS_UP:
            self.clock = self.authority.next_renewal(self.clock - kernel.IN_TIME * 2)
            return True
        self.place = end if abs(end - part.place) < 1e-6 else part.place
        return False

    def part(self, told: Leg, parameters: Array, until: float) -> Part:
        """Call the kernel from here on, for so many seconds at most."""
        lid, state = told.ceiling, self.state.copy()
        totals, found = self.totals.copy(), np.zeros(4)
        rows = np.zeros((rows_for(lid, self.sections, self.journey), kernel.COLUMNS))
        status = kernel.march(
            self.train, self.sections.position, self.sections.slope,
            self.sections.slope_change, self.sections.drag,
            *lid, self.called, parameters, state, self.speed, self.journey.step, until,
            rows, totals, np.zeros(SCRATCH + 2 * (2 + state.size)), found,
        )  # fmt: skip
        check_end(status, found, self.deceleration)
        part = rows[: int(found[0])]
        part[:, kernel.TIME] += self.clock
        return Part(status, part, state, totals, *found[1:].tolist())

    def accept(self, part: Part) -> None:
        """Take over what a part of the march did."""
        self.state, self.totals = part.state, part.totals
        self.traces.append(part.rows)
        self.clock += part.time
        self.place, self.speed = part.place, part.speed
