"""The train under a brake that the supervision has applied: service, emergency, or both."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.control.etcs.curves import brake_field
from railgrip.control.etcs.intervention_times import MOST_ACCELERATION, times_of
from railgrip.control.etcs.limit_table import EBI, LimitTable
from railgrip.control.etcs.supervised_way import SupervisedWay
from railgrip.core.constants import GRAVITY
from railgrip.engine.journey.forces import resistance, speed_of
from railgrip.engine.journey.legs import Leg
from railgrip.engine.journey.steps import SCRATCH, book

if TYPE_CHECKING:
    from railgrip.engine.journey.marching import March

Array = NDArray[np.float64]

STEP = 0.1
"""Longest step, s; steps end where anything changes, so that results do not depend on it."""
NEAR = 1e-9
"""Inside a step, beyond the place where it begins: m, m/s and s."""
EXCESS = 1e-9
"""A speed that is above a limit by no more than this is not, m/s."""
NEAR_CURVE = 1e-6
"""A train that follows the driver's own curve is off it when it is slower by so much, m/s."""
HALVINGS = 40


class Moment(NamedTuple):
    """When, where, and how fast, SI."""

    time: float
    place: float
    speed: float


class SupervisedBraking:
    """One intervention.

    Parameters
    ----------
    march : March
        The journey under way; its work is booked.
    told : Leg
        The leg, with the driver's own ceiling.
    way_at : callable
        Time → what the supervision is told then.
    decisive : LimitTable or None
        The target that is protected.
    pull : float
        Tractive force before, [N].

    Notes
    -----
    On ``dry`` rail the train has the nominal deceleration of its brakes on the gradient where it
    is, coasts while they build up, and the driver's own brake stays on. On ``assumed`` rail all is
    as the supervision assumes it: the safe deceleration, the worst gradient under the train, and
    a speed that does not fall before the brake has built up.
    """

    def __init__(
        self, march: March, told: Leg, way_at: Callable[[float], SupervisedWay],
        decisive: LimitTable | None, pull: float,
    ) -> None:  # fmt: skip
        assert march.onboard is not None
        self.onboard = march.onboard
        own, track = self.onboard.own, self.onboard.track
        self.march, self.way_at, self.lid, self.pull = march, way_at, told.ceiling, pull
        self.supervised = own.train_before(decisive.target.speed if decisive else 0.0)
        self.is_assumed = own.rail == "assumed"
        self.times, brakes = times_of(self.supervised), self.supervised.brakes
        emergency = brakes.safe if self.is_assumed else own.nominal_emergency()
        self.fields = {"service": brake_field(self.supervised, track, brakes.service),
                       "emergency": brake_field(self.supervised, track, emergency)}  # fmt: skip
        if self.is_assumed:
            self.fields["emergency"] = self.fields["emergency"]._replace(cap=track.cap)
        self.follows = False
        self.begun: dict[str, float] = {}
        self.full = {"service": brakes.service_time, "emergency": brakes.emergency_time}

    def run(self, now: Moment, is_emergency: bool) -> tuple[Moment, Array, str]:
        """Brake until it is enough; return the end, the rows of the trace, and the brakes used."""
        can_serve = self.supervised.commands_service_brake and not is_emergency
        self.begun["service" if can_serve else "emergency"] = now.time
        rows = []
        while True:
            # once on the driver's curve, rounding must not lead off it
            self.follows = self.follows and now.speed >= self._own(now.place)[0] - NEAR_CURVE
            flags = self._flags(now)
            self.follows = flags[1]
            if flags[0]:
                self.begun["emergency"] = now.time
                continue
            if now.speed <= NEAR or flags[2]:
                break
            rate = self._acceleration(now, flags[1])
            seconds = self._until_change(now, rate)
            if self._flags(_later(now, rate, seconds)) != flags:
                seconds = self._located(now, rate, seconds, flags)
            rows.append(self._booked(now, rate, seconds))
            now = _later(now, rate, seconds)
        rows.append([*now, 0.0, 0.0, 0.0, self._own(now.place)[0]])
        return now, np.array(rows), ", ".join(self.begun)

    def _flags(self, now: Moment) -> tuple[bool, bool, bool]:
        """Say whether EBI is passed, the driver's own curve met, and all is in order again."""
        own = self._own(now.place)[0]
        is_at_own = not self.is_assumed and (self.follows or now.speed >= own)
        if "emergency" in self.begun:
            return False, is_at_own, False
        way = self.way_at(now.time)
        kept = min(self.onboard.kept(way, now.place), own + NEAR_CURVE if own > 0.0 else 0.0)
        is_past = now.speed > way.speeds(now.place)[EBI, 0] + EXCESS
        return is_past, is_at_own, now.speed <= kept

    def _own(self, place: float) -> tuple[float, float]:
        """Return speed and slope (an acceleration) of the driver's own ceiling; past it, 0."""
        bounds, squares, falls = self.lid
        if place >= bounds[-1]:
            return 0.0, -self.march.deceleration
        k = max(int(np.searchsorted(bounds, place + NEAR, side="right")) - 1, 0)
        return speed_of(squares[k] + falls[k] * (place - bounds[k])), 0.5 * float(falls[k])

    def _acceleration(self, now: Moment, at_own: bool) -> float:
        """Return what the brakes that have built up, the driver and the line give, [m/s²]."""
        later = now.time + NEAR
        brakes = [name for name, begun in self.begun.items() if later >= begun + self.full[name]]
        if self.is_assumed:
            if brakes:
                inner = max(now.speed - NEAR, 0.0), now.place + NEAR
                return -max(self.fields[name].at(*inner) for name in brakes)
            gained = max(self.supervised.acceleration, 0.0)
            has_cut = later >= min(self.begun.values()) + self.times.traction
            return min(gained, MOST_ACCELERATION) if has_cut else gained
        slope, drag = self._line(now.place + NEAR)
        train = self.march.train
        cut_off = min(self.begun.values()) + self.supervised.traction_cut_off_time
        pull = self.pull if later < cut_off else 0.0
        found = (pull - resistance(train, slope, drag, now.speed)) / train.dynamic_mass
        if brakes:
            given = max(self.fields[name].brake.at(max(now.speed - NEAR, 0.0)) for name in brakes)
            found = -given - GRAVITY * slope * train.weight / GRAVITY / train.dynamic_mass
        return min(found, self._own(now.place)[1]) if at_own else found

    def _line(self, place: float) -> tuple[float, float]:
        one = self.march.sections
        k = min(int(np.searchsorted(one.position, place, side="right")) - 1, one.slope.size - 1)
        return (float(one.slope[k] + one.slope_change[k] * (place - one.position[k])),
                float(one.drag[k]))  # fmt: skip

    def _until_change(self, now: Moment, rate: float) -> float:
        """Return the seconds until brake, line or ceiling step, the train stands, or `STEP`."""
        found = [STEP]
        cuts = (self.times.traction, self.supervised.traction_cut_off_time)
        marks = [begun + self.full[name] for name, begun in self.begun.items()]
        marks += [min(self.begun.values()) + cut for cut in cuts]
        marks.append(self.march.authority.next_renewal(now.time))
        found += [mark - now.time for mark in marks if mark - now.time > NEAR]
        if rate < 0.0:
            speeds = [0.0, *(v for one in self.fields.values() for v in one.speed_breaks())]
            found += [(v - now.speed) / rate for v in speeds if v < now.speed - NEAR]
        places = [x for one in self.fields.values() for x in one.position_breaks()]
        places += [*self.march.sections.position.tolist(), *self.lid[0].tolist()]
        reach = now.place + (now.speed + max(rate, 0.0) * STEP) * STEP
        for place in places:
            if now.place + NEAR < place <= reach:
                square = now.speed**2 + 2.0 * rate * (place - now.place)
                if square >= 0.0:
                    found.append(2.0 * (place - now.place) / (now.speed + math.sqrt(square)))
        return min(found)

    def _located(
        self, now: Moment, rate: float, seconds: float, flags: tuple[bool, bool, bool]
    ) -> float:
        low, high = 0.0, seconds
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if self._flags(_later(now, rate, middle)) == flags:
                low = middle
            else:
                high = middle
        return high

    def _booked(self, now: Moment, rate: float, seconds: float) -> list[float]:
        """Book the work of a step, and return its row of the trace."""
        train, out = self.march.train, np.zeros(SCRATCH)
        middle = _later(now, rate, 0.5 * seconds)
        row: list[float] = []
        for one, weight in ((now, 1.0), (middle, 4.0), (_later(now, rate, seconds), 1.0)):
            slope, drag = self._line(one.place)
            force = train.dynamic_mass * rate + resistance(train, slope, drag, one.speed)
            pull, brake = max(force, 0.0), max(-force, 0.0)
            book(train, one.speed, pull, brake, slope, drag, weight / 6.0 * seconds,
                 self.march.totals, out)  # fmt: skip
            if not row:
                row = [*now, pull, float(out[2]), float(out[3]), self._own(now.place)[0]]
        return row


def _later(now: Moment, rate: float, seconds: float) -> Moment:
    """Return where a constant acceleration leads."""
    speed = max(now.speed + rate * seconds, 0.0)
    return Moment(now.time + seconds, now.place + 0.5 * (now.speed + speed) * seconds, speed)
