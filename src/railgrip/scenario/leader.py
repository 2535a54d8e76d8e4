"""A slower train ahead on the same line: what it is, and how its authority is handed on."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.coasting import Coasting
from railgrip.scenario.line import LineStop
from railgrip.scenario.point_train import PointTrain
from railgrip.scenario.reference import Reference
from railgrip.scenario.units import Acceleration, Length, Speed, Time


class Leader(Model):
    """A leading train, driven flat out or with coasting. All defaults illustrative."""

    train: Annotated[PointTrain, Reference("point_train")] = Field(
        description="A shipped name, a file or a table."
    )
    stop: tuple[LineStop, ...] = Field(
        default=(), max_length=20_000, description="Where it stops; absent: as the train behind."
    )
    passing_speed: Speed = Field(
        default=0.0, ge=0, le=200, description="At its first and last stop; 0 is a stand."
    )
    braking: Acceleration | None = Field(
        default=None, gt=0, le=5, description="Of its braking curves; absent: its own."
    )
    coasting: Coasting | None = Field(
        default=None, description="Coasting-initiation of its own; absent: none."
    )
    headway: Time = Field(
        default=120.0, ge=0, le=1e5, description="So long before the train behind it sets off."
    )
    margin: Length = Field(
        default=100.0, ge=0, le=1e4, description="Between the end of authority and its rear."
    )
    renewal: Time = Field(
        default=10.0,
        ge=0,
        le=600,
        description="Of the authority, t_MA; 0: steadily.",
    )
    clears_after: Time = Field(
        default=60.0, ge=0, le=1e5, description="From its last stop until the track is free."
    )

    @model_validator(mode="after")
    def _is_renewed(self) -> Leader:
        if 0.0 < self.renewal < 1.0:
            what = "is so short that only a steady renewal makes sense"
            refuse([Problem("renewal", what, got=f"{self.renewal:g} s", allowed="0, or from 1 s")])
        return self
