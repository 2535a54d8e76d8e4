"""Coasting-initiation in a journey: the curve, what happens above it, and who switches it."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from railgrip.control.coasting.coasting_parameters import CoastingParameters
from railgrip.scenario.base import Model
from railgrip.scenario.units import Acceleration, Dimensionless, Length, Speed


class Coasting(Model):
    """A second curve below the braking curve, where traction ends. All defaults illustrative."""

    shape: Literal["parabolic", "straight"] = Field(default="parabolic", description="Of it.")
    coasting_deceleration: Acceleration = Field(
        default=0.1, gt=0, le=5, description="Of the parabolic curve, below that of the brake."
    )
    distance_gain: Dimensionless = Field(
        default=0.01, gt=0, le=1, description="k1 of the straight curve, 1/s."
    )
    speed_gain: Dimensionless = Field(
        default=1.0, ge=1, le=10, description="k2 of the straight curve."
    )
    hysteresis: Speed = Field(
        default=10 / 3.6, gt=0, le=50, description="So far below the curve traction comes back."
    )
    action: Literal["cut", "reduced", "light braking"] = Field(
        default="cut", description="What happens above the curve."
    )
    reduced_share: Dimensionless = Field(
        default=0.3, ge=0, le=1, description="Share of the effort, if reduced."
    )
    light_deceleration: Acceleration = Field(
        default=0.1, gt=0, le=5, description="Of light braking, beside the running resistance."
    )
    least_speed: Speed = Field(
        default=20 / 3.6,
        ge=0,
        le=100,
        description="Below it, it is off: no train is left standing.",
    )
    station_distance: Length = Field(
        default=0.0, ge=0, le=1e5, description="So near a stop it is off."
    )
    at_station: Literal["accelerate", "hold"] = Field(
        default="accelerate", description="What the train may do there."
    )
    switch: Literal["hand", "control", "both"] = Field(
        default="control", description="Who switches it on."
    )
    by_hand: bool = Field(default=True, strict=True, description="The driver's switch.")
    by_control: bool = Field(default=True, strict=True, description="The train control's switch.")
    flat_braking: Acceleration = Field(
        default=0.0, ge=0, le=5, description="Braking curves below it are flat, and raise it."
    )
    knee_speed: Speed = Field(default=0.0, ge=0, le=200, description="Above it, it is raised.")
    lift: Dimensionless = Field(default=0.0, ge=0, le=10, description="By how much, k_h.")

    @property
    def is_switched_on(self) -> bool:
        """Whether those who must have switched it on."""
        switched = {
            "hand": self.by_hand,
            "control": self.by_control,
            "both": self.by_hand and self.by_control,
        }
        return switched[self.switch]

    def parameters(self, braking: float) -> CoastingParameters:
        """Return the law's parameters beside a braking curve of so many m/s²."""
        own = self.model_dump(exclude={"by_hand", "by_control"})
        return CoastingParameters(braking, **own)
