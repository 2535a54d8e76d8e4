"""A point-mass run under the coasting-initiation law, every change located as an event."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from railgrip.control.coasting.coasting_law import (
    AT_THE_CURVE,
    AnnouncedTarget,
    CoastingCommand,
    CoastingLaw,
    targets_ahead,
)
from railgrip.control.coasting.moving_authority import MovingAuthority
from railgrip.control.etcs.steps import Steps, constant
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.point_train import PointTrain

Array = NDArray[np.float64]
Signed = Callable[[float, Array], float]
TINY: Final = 1e-6
CRAWL: Final = 0.05
"""Below it the last bit of a stop is done by formula, m/s."""


class Change(NamedTuple):
    """Where the train's way of running changed: its new mode, and the event that led to it."""

    time: float
    position: float
    speed: float
    event: str
    mode: str
    is_ready: bool
    is_acting: bool


class CoastingRun(NamedTuple):
    """A run from standstill to standstill.

    Parameters
    ----------
    time, position, speed : ndarray (moment)
        [s], [m], [m/s].
    changes : list of Change
        The log, with the two indicators.
    energy, brake_work : float
        Of traction and of all braking at the wheel, [J].
    switchings : int
        Changes between traction > 0 and ≤ 0, the start included.
    """

    time: Array
    position: Array
    speed: Array
    changes: list[Change]
    energy: float
    brake_work: float
    switchings: int

    def at(self, event: str, number: int = 0) -> Change:
        """Return the change that an event led to, by its number."""
        return [change for change in self.changes if change.event == event][number]


class _Situation(NamedTuple):
    """What is constant until the next event."""

    mode: str
    command: CoastingCommand
    targets: list[AnnouncedTarget]
    limit: float
    gradient: float
    followed: AnnouncedTarget | None = None


class Driver:
    """A train control that accelerates, holds the permitted speed, obeys the law and brakes.

    Parameters
    ----------
    train : PointTrain
        What it drives.
    law : CoastingLaw
        Gives braking curve and coasting-initiation curve.
    limits : Steps
        Permitted speed over the position of the front, [m/s].
    station : float
        Where the train stops and the run ends, [m].
    gradient : Steps
        Uphill positive.
    authority : MovingAuthority, optional
        Behind a leading train.
    with_coasting : bool
        The train control's switch of the law.

    Notes
    -----
    Slow and exact: meant to show the law and to check faster journeys. Known wrong when: the
    train's length matters, for limits that rise and for gradients.

    Examples
    --------
    >>> from railgrip.control.coasting.coasting_parameters import CoastingParameters
    >>> train = PointTrain(200e3, 0.06, 150e3, 2.5e6, (2.5e3, 30.0, 6.0), 0.7)
    >>> law = CoastingLaw(CoastingParameters(0.7, coasting_deceleration=0.15))
    >>> run = Driver(train, law, constant(38.0), 4000.0).run()
    >>> round(run.at("coasting").position), round(run.energy / 3.6e6, 1)
    (917, 28.8)
    """

    def __init__(
        self,
        train: PointTrain,
        law: CoastingLaw,
        limits: Steps,
        station: float,
        *,
        gradient: Steps | None = None,
        authority: MovingAuthority | None = None,
        with_coasting: bool = True,
    ) -> None:
        self.train, self.law, self.limits, self.station = train, law, limits, station
        self.gradient = constant(0.0) if gradient is None else gradient
        self.authority, self.with_coasting = authority, with_coasting
        drops = [
            AnnouncedTarget(at, value)
            for at, value, before in zip(
                limits.begins[1:], limits.values[1:], limits.values, strict=False
            )
            if value < before and at < station
        ]
        self.targets = [*drops, AnnouncedTarget(station, 0.0, is_station=True)]

    def run(
        self,
        begin: float = 0.0,
        speed: float = 0.0,
        *,
        spacing: float = 20.0,
        at_most: float = 1e5,
    ) -> CoastingRun:
        """Drive until the train stands at the station.

        Parameters
        ----------
        begin, speed : float
            Where the front is at time 0, [m], and how fast, [m/s].
        spacing : float
            Greatest time between two moments of the record, > 0, [s].
        at_most : float
            Time after which the run is given up, [s].

        Returns
        -------
        CoastingRun
            Independent of any step: every change is located as a zero of a signed function.

        Raises
        ------
        RailgripError
            Where the train stalls.
        """
        self.law.reset()
        time, state, event = 0.0, np.array([begin, speed, 0.0, 0.0]), "start"
        moments = [np.array([0.0])]
        states, changes, pulls, switchings = [state[:, None]], [], False, 0
        while time < at_most:
            now = self._decide(time, state)
            ready, acting = now.command.is_ready, now.command.is_acting
            changes.append(Change(time, state[0], state[1], event, now.mode, ready, acting))
            if self.station - state[0] <= TINY * 10 and state[1] <= CRAWL:
                break
            before = pulls
            pulls = bool(self._force(time, state, now) > TINY * self.train.mass)
            switchings += int(pulls != before)
            if now.mode == "stand":
                time, event = self._wait(time, state), "renewal"
                continue
            time, state, event, piece = self._drive(time, state, now, spacing)
            moments.append(piece[0])
            states.append(piece[1])
        everything = np.concatenate(states, axis=1)
        return CoastingRun(
            np.concatenate(moments), everything[0], everything[1], changes,
            float(state[2]), float(state[3]), switchings,
        )  # fmt: skip

    def _wait(self, time: float, state: Array) -> float:
        later = np.inf if self.authority is None else self.authority.next_renewal(time)
        if not np.isfinite(later):
            raise RailgripError(
                Problem("run", "the train stands and cannot go on", got=f"{state[0]:.6g} m")
            )
        return float(later)

    def _decide(self, time: float, state: Array) -> _Situation:
        position, speed = float(state[0]), float(state[1])
        targets = targets_ahead(position, self._announced(time))
        command = self.law.step(position, speed, targets, by_control=self.with_coasting)
        gradient = self.gradient.at(position + TINY)
        limit = self.limits.at(position + TINY)
        if not targets:  # the leader stands right ahead
            return _Situation("stand", command, targets, limit, gradient)
        free = self._free(speed, gradient, command)
        mode, followed = "free", None
        if command.must_brake:
            followed = min(self._met(position, speed, targets), key=lambda t: self._foot(time, t))
            if self._needed(time, speed, followed) < free - TINY:
                mode = "brake"
        if mode == "free" and free > 0.0:
            if speed >= limit - TINY:
                mode = "cruise"
            elif command.holds_speed:
                mode = "hold"
        if speed <= CRAWL / 10 and (mode in ("brake", "hold") or free <= 0.0):
            mode = "stand"
        return _Situation(mode, command, targets, limit, gradient, followed)

    def _met(
        self, position: float, speed: float, targets: list[AnnouncedTarget]
    ) -> list[AnnouncedTarget]:
        """Return the targets whose braking curve is reached."""
        law = self.law
        return [t for t in targets if law.above_braking(position, speed, [t]) >= -2 * AT_THE_CURVE]

    def _foot(self, time: float, target: AnnouncedTarget) -> float:
        """Return how fast the foot of a target's braking curve moves."""
        if self.authority is None or target in self.targets:
            return 0.0
        return self.authority.speed(time)

    def _announced(self, time: float) -> list[AnnouncedTarget]:
        return self.targets + ([] if self.authority is None else [self.authority.target(time)])

    def _free(self, speed: float, gradient: float, command: CoastingCommand) -> float:
        return self.train.free_acceleration(speed, gradient, command.traction, command.brake)

    def _needed(self, time: float, speed: float, followed: AnnouncedTarget) -> float:
        """Return the acceleration that follows a braking curve."""
        foot = self._foot(time, followed)
        b = self.law.parameters.braking
        return b * (foot / max(speed, CRAWL) - 1.0) if foot > 0.0 else -b

    def _acceleration(self, time: float, speed: float, now: _Situation) -> float:
        if now.mode == "brake" and now.followed is not None:
            return self._needed(time, speed, now.followed)
        if now.mode in ("cruise", "hold"):
            return 0.0
        return self._free(speed, now.gradient, now.command)

    def _force(self, time: float, state: Array, now: _Situation) -> float:
        """Return the force at the wheel, traction positive."""
        if now.mode == "stand":
            return 0.0
        resistance = self.train.running_resistance(state[1], now.gradient)
        return self.train.inertia * self._acceleration(time, state[1], now) + resistance

    def _drive(
        self, time: float, state: Array, now: _Situation, spacing: float
    ) -> tuple[float, Array, str, tuple[Array, Array]]:
        """Drive to the next event; return time, state, its name, and the piece driven."""

        def slope(t: float, y: Array) -> list[float]:
            power = self._force(t, y, now) * y[1]
            return [y[1], self._acceleration(t, y[1], now), max(power, 0.0), max(-power, 0.0)]

        events = self._events(state, now)
        until = time + 2e4
        if self.authority is not None:
            until = min(until, self.authority.next_renewal(time))
        signs = [_event(function, direction) for function, direction in events.values()]
        done = solve_ivp(slope, (time, until), state, method="DOP853", events=signs,
                         rtol=1e-9, atol=1e-9, max_step=spacing)  # fmt: skip
        state, time, event = done.y[:, -1].copy(), float(done.t[-1]), "renewal"
        for name, found in zip(events, done.t_events, strict=True):
            if found.size:
                event = name
        if event == "permitted speed":
            state[1] = now.limit
        if event == "crawl":
            time, state = self._last_bit(time, state, now)
        return time, state, event, (done.t, done.y)

    def _last_bit(self, time: float, state: Array, now: _Situation) -> tuple[float, Array]:
        slowed = max(-self._acceleration(time, state[1], now), 1e-3)
        last = state[1] / slowed
        lost = 0.5 * self.train.inertia * state[1] ** 2 if now.mode == "brake" else 0.0
        position = state[0] + 0.5 * state[1] * last
        return time + last, np.array([position, 0.0, state[2], state[3] + lost])

    def _events(self, state: Array, now: _Situation) -> dict[str, tuple[Signed, float]]:
        """Return what may come next: signed function and direction, by name."""
        law, ahead, found = self.law, now.targets, dict[str, tuple[Signed, float]]()
        followed = now.followed if now.mode == "brake" else None
        free: Signed = lambda t, y: self._free(y[1], now.gradient, now.command)  # noqa: E731
        others = [target for target in ahead if target is not followed]
        above: Signed = lambda t, y: law.above_braking(  # noqa: E731
            y[0], y[1], self._current(t, others)
        )
        place = self._next_place(float(state[0]), ahead)
        name = "target" if any(target.position == place for target in ahead) else "line"
        found[name] = (lambda t, y: y[0] - place, 1.0)
        if now.command.is_acting:
            found["release"] = (
                lambda t, y: law.above_release(y[0], y[1], self._current(t, ahead)),
                -1.0,
            )
        elif now.command.is_ready and now.mode != "brake":
            found["coasting"] = (
                lambda t, y: law.above_coasting(y[0], y[1], self._current(t, ahead)),
                1.0,
            )
        found["braking"] = (above, 1.0)
        if followed is not None:
            needed: Signed = lambda t, y: self._needed(t, y[1], followed)  # noqa: E731
            found["off the curve"] = (lambda t, y: needed(t, y) + TINY - free(t, y), 1.0)
        elif now.command.must_brake:
            found["below"] = (lambda t, y: above(t, y) + TINY, -1.0)
        if law.parameters.least_speed > 0.0:
            rising = 1.0 if law.state.is_slow else -1.0
            found["least speed"] = (lambda t, y: law.above_least_speed(y[1]), rising)
        if law.past_station_limit(float(state[0]), ahead) < -TINY:
            found["station"] = (lambda t, y: law.past_station_limit(y[0], ahead), 1.0)
        if now.mode == "free":
            found["permitted speed"] = (lambda t, y: y[1] - now.limit, 1.0)
        if now.mode in ("cruise", "hold"):
            found["too slow"] = (free, -1.0)
        found["crawl"] = (lambda t, y: y[1] - CRAWL, -1.0)
        return found

    def _current(
        self, time: float, targets: Sequence[AnnouncedTarget]
    ) -> Sequence[AnnouncedTarget]:
        """Return the targets; the end of a continuous authority has moved since the last event."""
        if self.authority is None or self.authority.period > 0.0:
            return targets
        now = self.authority.target(time)
        return [target if target in self.targets else now for target in targets]

    def _next_place(self, position: float, ahead: Sequence[AnnouncedTarget]) -> float:
        """Return where the next target, limit or gradient begins."""
        moving = self.authority is not None and self.authority.period == 0.0
        places = [t.position for t in ahead if not moving or t in self.targets]
        places += [*self.limits.begins, *self.gradient.begins]
        return min((place for place in places if place > position + TINY), default=np.inf)


def _event(function: Signed, direction: float) -> Signed:
    def event(t: float, y: Array) -> float:
        return function(t, y)

    event.terminal = True  # type: ignore[attr-defined]
    event.direction = direction  # type: ignore[attr-defined]
    return event
