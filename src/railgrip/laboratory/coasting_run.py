"""A point-mass run under the coasting-initiation law, every change located as an event."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from railgrip.control.coasting.coasting_law import CoastingLaw
from railgrip.control.coasting.moving_authority import MovingAuthority
from railgrip.control.etcs.steps import Steps
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.coasting_events import events_after, located
from railgrip.laboratory.point_train import PointTrain
from railgrip.laboratory.train_control import CRAWL, TINY, Situation, TrainControl

Array = NDArray[np.float64]


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
    >>> from railgrip.control.etcs.steps import constant
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
        self.control = TrainControl(
            train, law, limits, station,
            gradient=gradient, authority=authority, with_coasting=with_coasting,
        )  # fmt: skip

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
        self.control.law.reset()
        time, state, event = 0.0, np.array([begin, speed, 0.0, 0.0]), "start"
        moments = [np.array([0.0])]
        states, changes, pulls, switchings = [state[:, None]], [], False, 0
        while time < at_most:
            now = self.control.decide(time, state)
            ready, acting = now.command.is_ready, now.command.is_acting
            changes.append(Change(time, state[0], state[1], event, now.mode, ready, acting))
            if self.control.station - state[0] <= TINY * 10 and state[1] <= CRAWL:
                break
            before = pulls
            pulls = bool(self.control.force(time, state, now) > TINY * self.control.train.mass)
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
        later = (
            np.inf if self.control.authority is None else self.control.authority.next_renewal(time)
        )
        if not np.isfinite(later):
            raise RailgripError(
                Problem("run", "the train stands and cannot go on", got=f"{state[0]:.6g} m")
            )
        return float(later)

    def _drive(
        self, time: float, state: Array, now: Situation, spacing: float
    ) -> tuple[float, Array, str, tuple[Array, Array]]:
        """Drive to the next event; return time, state, its name, and the piece driven."""

        def slope(t: float, y: Array) -> list[float]:
            power = self.control.force(t, y, now) * y[1]
            return [
                y[1],
                self.control.acceleration(t, y[1], now),
                max(power, 0.0),
                max(-power, 0.0),
            ]

        events = events_after(self.control, state, now)
        until = time + 2e4
        if self.control.authority is not None:
            until = min(until, self.control.authority.next_renewal(time))
        signs = [located(function, direction) for function, direction in events.values()]
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

    def _last_bit(self, time: float, state: Array, now: Situation) -> tuple[float, Array]:
        slowed = max(-self.control.acceleration(time, state[1], now), 1e-3)
        last = state[1] / slowed
        lost = 0.5 * self.control.train.inertia * state[1] ** 2 if now.mode == "brake" else 0.0
        position = state[0] + 0.5 * state[1] * last
        return time + last, np.array([position, 0.0, state[2], state[3] + lost])
