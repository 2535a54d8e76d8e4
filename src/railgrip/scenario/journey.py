"""A journey without slip: train, line, stops with times, and how it is driven."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.coasting import Coasting
from railgrip.scenario.journey_supervision import JourneySupervision
from railgrip.scenario.leader import Leader
from railgrip.scenario.line import Line, LineStop
from railgrip.scenario.point_train import PointTrain
from railgrip.scenario.reference import Reference
from railgrip.scenario.units import Acceleration, Dimensionless, Speed, Time


class Journey(Model):
    """From the first stop to the last."""

    title: Text = Field(default="", description="Name for people.")
    train: Annotated[PointTrain, Reference("point_train")] = Field(
        description="A shipped name, a file or a table."
    )
    line: Annotated[Line, Reference("line")] = Field(
        description="A shipped name, a file or a table."
    )
    stop: tuple[LineStop, ...] = Field(
        default=(), max_length=20_000, description="Instead of the line's own stops."
    )
    passing_speed: Speed = Field(
        default=0.0, ge=0, le=200, description="At the first and the last stop; 0 is a stand."
    )
    braking: Acceleration | None = Field(
        default=None, gt=0, le=5, description="Of the braking curves; absent: the train's own."
    )
    gradient_under: Literal["front", "train"] = Field(
        default="front", description="The gradient that counts."
    )
    curve_resistance: bool = Field(
        default=False, strict=True, description="Whether curves resist (Roeckl)."
    )
    supplement: Dimensionless | None = Field(
        default=None, ge=0, le=10, description="Time beyond the least possible, for the optimum."
    )
    time: Time | None = Field(
        default=None, gt=0, le=1e6, description="Running time without dwells, for the optimum."
    )
    coasting: Coasting | None = Field(
        default=None, description="Coasting-initiation; absent: none."
    )
    leader: Leader | None = Field(
        default=None, description="A train ahead on the same line; absent: none."
    )
    supervision: JourneySupervision | None = Field(
        default=None, description="ETCS supervision; absent: none."
    )
    step: Time = Field(default=1.0, gt=0, le=5, description="Longest step of the fast journey.")

    @model_validator(mode="after")
    def _fits_together(self) -> Journey:
        refuse(
            [*self._limits(), *self._stops(), *self._times(), *self._curve(), *self._supervised()]
        )
        return self

    def stops(self) -> tuple[LineStop, ...]:
        """Where the train stops; the ends of the line if nothing else is said."""
        if self.stop:
            return self.stop
        if len(self.line.stop) >= 2:
            return self.line.stop
        return (LineStop(at=0.0), LineStop(at=self.line.length))

    def deceleration(self) -> float | None:
        """Return that of the braking curves, m/s², or None if only forces limit it."""
        return self.braking if self.braking is not None else self.train.max_deceleration

    def _limits(self) -> list[Problem]:
        first = self.line.speed_limit[0].at if self.line.speed_limit else None
        begin = self.stops()[0].at
        if first is not None and first <= begin:
            return []
        got = "none at all" if first is None else f"the first at {first:g} m"
        return [
            Problem(
                "line.speed_limit",
                f"leaves a gap where the journey begins, at {begin:g} m",
                got=got,
                cure="a limit from there on",
            )
        ]

    def _stops(self) -> list[Problem]:
        stops = self.stops()
        problems = [
            Problem(
                f"stop[{i}].at",
                "lies off the line",
                got=f"{stop.at:g} m",
                allowed=f"0 to {self.line.length:g} m",
            )
            for i, stop in enumerate(stops)
            if stop.at > self.line.length
        ]
        if len(stops) < 2:
            problems.append(Problem("stop", "needs at least two", got=f"{len(stops)}"))
        return problems + [
            Problem(f"stop[{i + 1}].at", "must lie beyond the stop before it", got=f"{b.at:g} m")
            for i, (a, b) in enumerate(pairwise(stops))
            if b.at <= a.at
        ]

    def _times(self) -> list[Problem]:
        if self.supplement is not None and self.time is not None:
            return [Problem("time", "and supplement say the same; give one of them")]
        return []

    def _curve(self) -> list[Problem]:
        own, asked = self.train.max_deceleration, self.braking
        if own is not None and asked is not None and asked > own + 1e-9:
            return [
                Problem(
                    "braking",
                    "is more than the train allows",
                    got=f"{asked:g} m/s²",
                    allowed=f"up to {own:g} m/s²",
                )
            ]
        return []

    def _supervised(self) -> list[Problem]:
        if self.supervision is None:
            return []
        problems, length = [], self.supervision.train.length
        if length < self.train.length - 0.5:  # it would miss gradients under the train
            what = "is less than that of the train itself"
            problems.append(Problem("supervision.train.length", what, got=f"{length:g} m",
                                    allowed=f"from {self.train.length:g} m"))  # fmt: skip
        if self.leader is not None and self.leader.renewal == 0.0:
            what = "has no steady form: an ETCS authority comes in messages"
            problems.append(Problem("supervision", what, got="leader.renewal = 0",
                                    cure="leader.renewal = '5 s'"))  # fmt: skip
        return problems
