"""The march behind a train whose authority is renewed all the time: its braking curve moves."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.engine.journey import kernel
from railgrip.engine.journey.drive import DrivingLaw
from railgrip.engine.journey.forces import speed_of
from railgrip.engine.journey.legs import Leg, leg_of
from railgrip.engine.journey.marching import WORTH_MOVING, Authority, March, Part
from railgrip.engine.journey.profile import ceiling
from railgrip.engine.plug_ins import first_class
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]
Lid = tuple[Array, ...]

LONGEST = 0.5
"""Longest step along the moving curve, s: the way within it is taken for one of constant force."""
AT = 1e-9
"""A square of speed counts as on the moving curve within so much of itself."""
HALVINGS = 40
STANDS = 1e-3
"""A train so slow right before the end of authority stands, m/s."""
ROUNDING = 1e-8
"""A square of speed that has left the curve by so much of itself at the end of a step is on it."""


def frozen(position: float, speed: float, parameters: Any, state: Any, demand: Any) -> None:
    """Demand what was decided before the step."""
    demand[0] = parameters[0]
    demand[1] = parameters[1]


class _Now(NamedTuple):
    """What has been decided: demand, whether the train is on the moving curve, the law's state."""

    share: float
    retard: float
    follows: bool
    state: Array


class Pursuit(March):
    """The march with an authority whose end moves with the leading train.

    Notes
    -----
    With the end at E(t) the braking curve is ``v² = 2 b (E(t) − x)``. Between two corners of the
    leader's record E moves at a constant speed w, and the kernel is given the curve as a ceiling
    of constant acceleration that ends on it after each step. Where law or curve change what is
    demanded, the step is halved until the place is known.
    """

    def __init__(self, journey: Journey, law: DrivingLaw, authority: Authority) -> None:
        super().__init__(journey, law, authority)
        self.free_law, self.called = self.called, first_class(frozen, kernel.LAW)

    def leg(self, stop: float, final: float, *, is_first: bool = True) -> None:
        """Drive to the next stop."""
        lid = ceiling(self.journey, self.place, stop, final, self.deceleration)
        self.state = self.law.setup(self._told(lid, stop, final))[1]
        while self.authority.end(self.clock) < stop:
            if self._ahead(self.clock) < WORTH_MOVING and self.speed < STANDS:
                self.speed = 0.0
                self.clock += self._wait()
                continue
            told = self._told(lid, stop, final)
            self.told.append((sum(map(len, self.traces)), told))
            now = self._decided(self.clock, self.place, self.speed, told)
            seconds = self._longest(now)
            part = self._step(lid, now, seconds)
            if not self._goes_on(part, now, lid, stop, final):
                low, high = 0.0, seconds
                for _ in range(HALVINGS):
                    seconds = 0.5 * (low + high)
                    part = self._step(lid, now, seconds)
                    if self._goes_on(part, now, lid, stop, final):
                        low = seconds
                    else:
                        high = seconds
                    if high - low < 1e-9:
                        break
                part = self._step(lid, now, high)
            self.accept(part._replace(state=now.state))
            ended = self._decided(self.clock, self.place, self.speed, self._told(lid, stop, final))
            self.state = ended.state
            if part.status == kernel.ARRIVED and self.place >= stop - 1e-6:
                return
        # from here on no train is ahead
        self.called, pursued = self.free_law, self.called
        super().leg(stop, final, is_first=False)
        self.called = pursued

    def _told(self, lid: Lid, stop: float, final: float) -> Leg:
        """Return what the law is told now: the targets up to the end of authority, and that."""
        end = self.authority.end(self.clock)
        return self._told_at(end, lid, stop, final)

    def _told_at(self, end: float, lid: Lid, stop: float, final: float) -> Leg:
        one = leg_of((lid[0], lid[1], lid[2]), self.deceleration, final == 0.0)
        if end >= stop:
            return one._replace(authority=end)
        targets = (*(target for target in one.targets if target[0] < end), (end, 0.0))
        return one._replace(targets=targets, authority=end)

    def _ahead(self, time: float) -> float:
        return self.authority.end(time) - self.place

    def _square(self, time: float, place: float) -> float:
        """Return the square of the speed on the moving curve."""
        return max(2.0 * self.deceleration * (self.authority.end(time) - place), 0.0)

    def _foot(self, time: float) -> float:
        """Return how fast the end of authority moves just after a time."""
        assert self.authority.record is not None
        return self.authority.record.speed(time + 1e-9)

    def _decided(self, time: float, place: float, speed: float, told: Leg) -> _Now:
        """Return what the law demands, which the moving curve overrules."""
        parameters, _ = self.law.setup(told)
        demand = np.zeros(2 + self.state.size)
        self.law.demand(place, speed, parameters, self.state, demand)
        square = self._square(time, place)
        follows = speed * speed >= square * (1.0 - AT) - 1e-12
        share = 1.0 if follows else float(demand[0])
        retard = 0.0 if follows else float(demand[1])
        return _Now(share, retard, follows, demand[2:].copy())

    def _longest(self, now: _Now) -> float:
        corner = min(self.authority.next_renewal(self.clock), self.authority.free_from)
        step = self.journey.step
        if now.follows:  # and so short that it does not come to a stand in a step
            step = min(LONGEST, step, max(self.speed, 0.02) / (2.0 * self.deceleration))
        return max(min(step, corner - self.clock), 1e-6)

    def _wait(self) -> float:
        """Return the seconds for which a standing train stands."""
        foot = self._foot(self.clock)
        corner = min(self.authority.next_renewal(self.clock), self.authority.free_from)
        left = corner - self.clock
        if foot > 0.0:
            left = min(left, (1.001 * WORTH_MOVING - self._ahead(self.clock)) / foot)
        return max(left, 1e-6)

    def _step(self, lid: Lid, now: _Now, seconds: float) -> Part:
        """March for some seconds with what has been decided."""
        demand = np.array([now.share, now.retard])
        if not now.follows:
            return self._march(_from(lid, self.place), demand, seconds)
        foot, square = self._foot(self.clock), self._square(self.clock, self.place)
        slope = _slope(speed_of(square), foot, self.deceleration, seconds)
        line = _under(_from(lid, self.place), self.place, square, slope)
        part = self._march(line, demand, seconds)
        on_curve = self._square(self.clock + part.time, part.place)
        if abs(part.speed**2 - on_curve) < ROUNDING * on_curve:
            part = part._replace(speed=speed_of(on_curve))
        return part

    def _march(self, lid: Lid, demand: Array, seconds: float) -> Part:
        told = Leg(self.place, float(lid[0][-1]), (), self.deceleration, ceiling=lid)
        kept, self.state = self.state, np.zeros(0)
        part = self.part(told, demand, seconds)
        self.state = kept
        return part

    def _goes_on(self, part: Part, now: _Now, lid: Lid, stop: float, final: float) -> bool:
        """Say whether at the end of a step the same is demanded."""
        time = self.clock + part.time
        told = self._told_at(self.authority.end(time), lid, stop, final)
        kept, self.state = self.state, now.state
        then = self._decided(time, part.place, part.speed, told)
        self.state = kept
        return (then.share, then.retard, then.follows) == (now.share, now.retard, now.follows)


def _slope(speed: float, foot: float, deceleration: float, seconds: float) -> float:
    """Return the slope of the square of the speed that ends a step on the moving curve again.

    The acceleration is constant in it, so ``v₁² = v₀² + 2 b (w h − s)``, ``s = (v₀ + v₁) h/2``.
    """
    if foot == 0.0:
        return -2.0 * deceleration
    gained = deceleration * seconds
    rest = speed * speed + gained * (2.0 * foot - speed)
    then = 0.5 * (math.sqrt(gained * gained + 4.0 * max(rest, 0.0)) - gained)
    return 2.0 * (then - speed) / seconds


def _from(lid: Lid, place: float) -> Lid:
    """Return a ceiling from a place on."""
    position, square, slope = lid
    k = int(np.searchsorted(position[1:-1], place, side="right"))
    first = square[k] + slope[k] * (place - position[k])
    return (np.concatenate([[place], position[k + 1 :]]),
            np.concatenate([[first], square[k + 1 :]]), slope[k:].copy())  # fmt: skip


def _under(lid: Lid, place: float, square: float, slope: float) -> Lid:
    """Return a ceiling below a line through its first place, for as long as the line is lower."""
    position, squares, slopes = lid
    square = min(square, float(squares[0]))  # rounding where both meet
    end = position[-1] if slope >= 0.0 else min(position[-1], place - square / slope)
    rows = [(place, square, slope)]
    for k in range(slopes.size):
        begin, until = float(position[k]), min(float(position[k + 1]), end)
        if begin >= end:
            break
        own = squares[k]
        line = square + slope * (begin - place)
        # where the own ceiling crosses the line from above
        if own < line - 1e-9:
            rows.append((begin, float(own), float(slopes[k])))
            return _lid(rows, until)
        gap = slope - slopes[k]
        if gap > 0.0:
            cross = begin + (own - line) / gap
            if cross < until:
                rows.append((max(cross, begin), float(own + slopes[k] * (cross - begin)),
                             float(slopes[k])))  # fmt: skip
                return _lid(rows, until)
    return _lid(rows, end)


def _lid(rows: list[tuple[float, float, float]], end: float) -> Lid:
    rows = [row for row in rows if row[0] < end]
    table = np.array(rows)
    return np.append(table[:, 0], end), table[:, 1].copy(), table[:, 2].copy()
