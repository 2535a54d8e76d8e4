"""A case for the ETCS supervision: train, track, target, national values."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, model_validator

from railgrip.control.etcs import train_data
from railgrip.control.etcs.steps import Steps
from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.supervised_brakes import (
    missing_level,
    track_under,
    train_before,
    turned_areas,
)
from railgrip.scenario.supervised_train import SupervisedTrain
from railgrip.scenario.supervision_values import FAST, Area, GradientFrom, NationalValues
from railgrip.scenario.units import Length, Speed


class SupervisedTarget(Model):
    """Where which speed must be reached."""

    at: Length = Field(ge=0, le=1e6, description="Position of target or end of authority.")
    speed: Speed = Field(default=0.0, ge=0, le=FAST, description="Speed there.")
    kind: Literal["end of authority", "speed limit"] = Field(
        default="end of authority", description="An end of authority has speed 0."
    )
    supervised_location: Length | None = Field(
        default=None, ge=0, le=1e6, description="Of an end of authority; itself if not given."
    )
    release_speed: Speed = Field(default=0.0, ge=0, le=FAST, description="Of an end of authority.")

    @model_validator(mode="after")
    def _fits(self) -> SupervisedTarget:
        problems = []
        if self.kind == "end of authority" and self.speed > 0.0:
            problems.append(Problem("speed", "an end of authority has speed 0",
                                    got=f"{3.6 * self.speed:g} km/h",
                                    cure='kind = "speed limit"'))  # fmt: skip
        if self.supervised_location is not None and self.supervised_location < self.at:
            problems.append(Problem("supervised_location", "must not lie before the target",
                                    got=f"{self.supervised_location:g} m"))  # fmt: skip
        refuse(problems)
        return self


class SupervisionCase(Model):
    """A question to the supervision, as its file asks it."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    train: SupervisedTrain = Field(description="Its brake and interfaces.")
    target: SupervisedTarget = Field(description="Where which speed must be reached.")
    gradient: Annotated[tuple[GradientFrom, ...], Field(max_length=20_000)] = Field(
        default=(), description="Ascending by position; level if not given."
    )
    reduced_adhesion: Annotated[tuple[Area, ...], Field(max_length=1000)] = Field(
        default=(), description="Stretches with reduced adhesion."
    )
    national: NationalValues = Field(default=NationalValues(), description="National values.")
    ceiling: Speed | None = Field(default=None, gt=0, le=FAST, description="Limit before it.")
    speed_step: Speed = Field(default=5 / 3.6, ge=0.1 / 3.6, le=FAST, description="Of the table.")
    driver_reacts: bool = Field(
        default=False, strict=True, description="T_indication with T_driver, SUBSET-026 v4."
    )
    as_era_tool: bool = Field(
        default=False, strict=True, description="Service brake above 180 km/h as ERA's tool v3.0."
    )

    @model_validator(mode="after")
    def _in_order(self) -> SupervisionCase:
        places = [point.at for point in self.gradient]
        problems = [
            Problem(f"gradient[{i + 1}].at", "must lie beyond the entry before it",
                    got=f"{b:g} m after {a:g} m")
            for i, (a, b) in enumerate(pairwise(places)) if b <= a
        ]  # fmt: skip
        problems += turned_areas(self.reduced_adhesion)
        problems += missing_level(self.train, self.national)
        if self.target.speed >= (self.ceiling or self.train.top_speed):
            problems.append(Problem("target.speed", "must be below the ceiling speed",
                                    got=f"{3.6 * self.target.speed:g} km/h"))  # fmt: skip
        refuse(problems)
        return self

    def supervised_train(self) -> train_data.SupervisedTrain:
        """Return the train as the supervision sees it, national values included."""
        return train_before(self.train, self.national, self.target.speed, self.as_era_tool)

    def supervised_track(self) -> train_data.Track:
        """Return gradient and reduced adhesion."""
        points = self.gradient or (GradientFrom(at=0.0, value=0.0),)
        gradient = Steps(tuple(p.at for p in points), tuple(p.value for p in points))
        return track_under(self.train, self.national, gradient, self.reduced_adhesion)

    def supervised_target(self) -> train_data.Target:
        """Return the target."""
        is_end = self.target.kind == "end of authority"
        place = self.target.supervised_location
        return train_data.Target(self.target.at, self.target.speed, is_end, place)
