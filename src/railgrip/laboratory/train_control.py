"""A train control: it accelerates, holds the permitted speed, obeys the coasting law, brakes."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.control.coasting.coasting_law import (
    AT_THE_CURVE,
    AnnouncedTarget,
    CoastingCommand,
    CoastingLaw,
    targets_ahead,
)
from railgrip.control.coasting.moving_authority import MovingAuthority
from railgrip.control.etcs.steps import Steps, constant
from railgrip.laboratory.point_train import PointTrain

Array = NDArray[np.float64]
TINY: Final = 1e-6
CRAWL: Final = 0.05
"""Below it the last bit of a stop is done by formula, m/s."""


class Situation(NamedTuple):
    """What is constant until the next event."""

    mode: str
    command: CoastingCommand
    targets: list[AnnouncedTarget]
    limit: float
    gradient: float
    followed: AnnouncedTarget | None = None


class TrainControl:
    """What a train does in a situation, and how it moves until the next event.

    Parameters
    ----------
    train, law, limits, station, gradient, authority, with_coasting
        As in `coasting_run.Driver`.
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

    def decide(self, time: float, state: Array) -> Situation:
        """Ask the law and return what the train does from here on."""
        position, speed = float(state[0]), float(state[1])
        targets = targets_ahead(position, self.announced(time))
        command = self.law.step(position, speed, targets, by_control=self.with_coasting)
        gradient = self.gradient.at(position + TINY)
        limit = self.limits.at(position + TINY)
        if not targets:  # the leader stands right ahead
            return Situation("stand", command, targets, limit, gradient)
        free = self.free(speed, gradient, command)
        mode, followed = "free", None
        if command.must_brake:
            followed = min(self._met(position, speed, targets), key=lambda t: self.foot(time, t))
            if self.needed(time, speed, followed) < free - TINY:
                mode = "brake"
        if mode == "free" and free > 0.0:
            if speed >= limit - TINY:
                mode = "cruise"
            elif command.holds_speed:
                mode = "hold"
        if speed <= CRAWL / 10 and (mode in ("brake", "hold") or free <= 0.0):
            mode = "stand"
        return Situation(mode, command, targets, limit, gradient, followed)

    def _met(
        self, position: float, speed: float, targets: list[AnnouncedTarget]
    ) -> list[AnnouncedTarget]:
        """Return the targets whose braking curve is reached."""
        law = self.law
        return [t for t in targets if law.above_braking(position, speed, [t]) >= -2 * AT_THE_CURVE]

    def foot(self, time: float, target: AnnouncedTarget) -> float:
        """Return how fast the foot of a target's braking curve moves."""
        if self.authority is None or target in self.targets:
            return 0.0
        return self.authority.speed(time)

    def announced(self, time: float) -> list[AnnouncedTarget]:
        """Return all targets, the end of authority as it is known, too."""
        return self.targets + ([] if self.authority is None else [self.authority.target(time)])

    def free(self, speed: float, gradient: float, command: CoastingCommand) -> float:
        """Return the acceleration that traction or light brake give, [m/s²]."""
        return self.train.free_acceleration(speed, gradient, command.traction, command.brake)

    def needed(self, time: float, speed: float, followed: AnnouncedTarget) -> float:
        """Return the acceleration that follows a braking curve."""
        foot = self.foot(time, followed)
        b = self.law.parameters.braking
        return b * (foot / max(speed, CRAWL) - 1.0) if foot > 0.0 else -b

    def acceleration(self, time: float, speed: float, now: Situation) -> float:
        """Return the acceleration in a situation, [m/s²]."""
        if now.mode == "brake" and now.followed is not None:
            return self.needed(time, speed, now.followed)
        if now.mode in ("cruise", "hold"):
            return 0.0
        return self.free(speed, now.gradient, now.command)

    def force(self, time: float, state: Array, now: Situation) -> float:
        """Return the force at the wheel, traction positive."""
        if now.mode == "stand":
            return 0.0
        resistance = self.train.running_resistance(state[1], now.gradient)
        return self.train.inertia * self.acceleration(time, state[1], now) + resistance
