"""A trip: the train of a scenario driven from stop to stop, with everything beneath it."""

from __future__ import annotations

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.coasting import Coasting
from railgrip.scenario.journey_supervision import JourneySupervision
from railgrip.scenario.line import LineStop
from railgrip.scenario.units import Acceleration, Dimensionless, Time


class Trip(Model):
    """Where the train goes, and how the automatic driver drives it."""

    stop: tuple[LineStop, ...] = Field(
        default=(), max_length=20_000, description="Instead of the line's own stops."
    )
    braking: Acceleration | None = Field(
        default=None, gt=0, le=5, description="Of the braking curves; absent: 0.7 of full service."
    )
    max_acceleration: Acceleration | None = Field(
        default=None, gt=0, le=5, description="Preset acceleration; absent: full power."
    )
    coasting: Coasting | None = Field(
        default=None, description="Coasting-initiation; absent: none."
    )
    supervision: JourneySupervision | None = Field(
        default=None, description="ETCS supervision; absent: none."
    )
    supplement: Dimensionless = Field(
        default=0.05, ge=0, le=10, description="Of the timetable, over the time on dry rail."
    )
    period: Time = Field(default=0.1, gt=0, le=1, description="Of the driver's decisions.")
    foresight: Time | None = Field(
        default=None, ge=0, le=10, description="For brakes that fill; absent: half their time."
    )
    gain: Dimensionless = Field(
        default=0.4, gt=0, le=5, description="Acceleration per deviation of the speed, 1/s."
    )

    @model_validator(mode="after")
    def _is_only_watched(self) -> Trip:
        if self.supervision is not None and self.supervision.mode == "intervene":
            what = "is for journeys without slip; on the plant no brake is commanded by it"
            refuse([Problem("supervision.mode", what, got="intervene", allowed="report, drive")])
        return self
