"""ETCS supervision of a journey: what is known of the train, and what it may do."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from railgrip.control.etcs import train_data
from railgrip.control.etcs.steps import Steps
from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.line import Line
from railgrip.scenario.supervised_brakes import (
    emergency_of,
    missing_level,
    track_under,
    train_before,
    turned_areas,
)
from railgrip.scenario.supervised_train import SupervisedTrain
from railgrip.scenario.supervision_values import FAST, Area, NationalValues
from railgrip.scenario.units import Length, Speed

LEAST = 1.0
"""Between a stop and the end of authority without a release speed, m."""


class JourneySupervision(Model):
    """The supervision above a journey. Places and release speed: defaults illustrative."""

    mode: Literal["report", "drive", "intervene"] = Field(
        default="report",
        description="It only reports; the train is driven below the permitted speed; it brakes.",
    )
    train: SupervisedTrain = Field(description="Its brake and interfaces.")
    national: NationalValues = Field(default=NationalValues(), description="National values.")
    past_stop: Length = Field(
        default=50.0, ge=0, le=1e4, description="End of authority, beyond each stop."
    )
    overlap: Length = Field(
        default=0.0, ge=0, le=1e4, description="Supervised location, beyond the end of authority."
    )
    release_speed: Speed = Field(default=0.0, ge=0, le=FAST, description="Of ends of authority.")
    reduced_adhesion: Annotated[tuple[Area, ...], Field(max_length=1000)] = Field(
        default=(), description="Stretches with reduced adhesion."
    )
    driver_reacts: bool = Field(
        default=False, strict=True, description="T_indication with T_driver, SUBSET-026 v4."
    )
    as_era_tool: bool = Field(
        default=False, strict=True, description="Service brake above 180 km/h as ERA's tool v3.0."
    )
    rail: Literal["dry", "assumed"] = Field(
        default="dry", description="An intervention gives the nominal, or just the safe brake."
    )

    @model_validator(mode="after")
    def _fits(self) -> JourneySupervision:
        problems = [
            *turned_areas(self.reduced_adhesion),
            *missing_level(self.train, self.national),
        ]
        if self.mode != "report" and self.past_stop < LEAST and self.release_speed == 0.0:
            what = "so near the stop the permitted speed falls so slowly that no train arrives"
            problems.append(
                Problem("past_stop", what, got=f"{self.past_stop:g} m, and no release_speed",
                        allowed=f"from {LEAST:g} m",
                        cure="past_stop = '50 m', or release_speed = '20 km/h'")
            )  # fmt: skip
        refuse(problems)
        return self

    def train_before(self, target_speed: float) -> train_data.SupervisedTrain:
        """Return the train as the supervision sees it before a target of some speed."""
        return train_before(self.train, self.national, target_speed, self.as_era_tool)

    def track(self, line: Line) -> train_data.Track:
        """Return gradient and reduced adhesion of a line."""
        points = [(point.at, point.value) for point in line.gradient]
        if not points or points[0][0] > 0.0:
            points.insert(0, (0.0, 0.0))
        at, value = zip(*points, strict=True)
        return track_under(self.train, self.national, Steps(at, value), self.reduced_adhesion)

    def nominal_emergency(self) -> Steps:
        """Return A_brake_emergency without any factor, [m/s²] over [m/s]."""
        return emergency_of(self.train)
