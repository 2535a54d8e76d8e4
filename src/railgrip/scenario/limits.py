"""What a run must keep: the command ends with exit code 1 where a limit is missed."""

from __future__ import annotations

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.units import (
    Acceleration,
    Dimensionless,
    Energy,
    Length,
    Temperature,
    Time,
    Volume,
)


class Limits(Model):
    """Limits by the name of the outcome; "least" in the description means from below."""

    stopping_distance: Length | None = Field(
        default=None, gt=0, le=1e6, description="Greatest allowed."
    )
    stopping_distance_least: Length | None = Field(
        default=None, ge=0, le=1e6, description="Least allowed."
    )
    deceleration_distance: Length | None = Field(
        default=None, gt=0, le=1e6, description="Greatest allowed."
    )
    stopping_time: Time | None = Field(default=None, gt=0, le=7200, description="Greatest allowed.")
    mean_deceleration: Acceleration | None = Field(
        default=None, ge=0, le=20, description="Least allowed."
    )
    mean_deceleration_greatest: Acceleration | None = Field(
        default=None, gt=0, le=20, description="Greatest allowed."
    )
    adhesion_utilisation: Dimensionless | None = Field(
        default=None, ge=0, le=1, description="Least allowed."
    )
    locked_time: Time | None = Field(
        default=None,
        ge=0,
        le=7200,
        description="Greatest allowed for the longest lock of any axle.",
    )
    slid_distance: Length | None = Field(
        default=None, ge=0, le=1e6, description="Greatest allowed, any axle."
    )
    slid_energy: Energy | None = Field(
        default=None, ge=0, le=1e12, description="Greatest, any axle."
    )
    flat_length: Length | None = Field(
        default=None, ge=0, le=10, description="Greatest, any wheel."
    )
    disc_temperature: Temperature | None = Field(
        default=None, ge=-60, le=2000, description="Greatest, any disc."
    )
    air_used: Volume | None = Field(
        default=None, ge=0, le=1000, description="Greatest, whole train, free air."
    )

    @model_validator(mode="after")
    def _can_be_kept(self) -> Limits:
        problems = []
        for low, high in (
            ("stopping_distance_least", "stopping_distance"),
            ("mean_deceleration", "mean_deceleration_greatest"),
        ):
            least, greatest = getattr(self, low), getattr(self, high)
            if least is not None and greatest is not None and least > greatest:
                problems.append(
                    Problem(
                        low, f"contradicts {high}", got=f"least {least:g}, greatest {greatest:g}"
                    )
                )
        refuse(problems)
        return self
