"""Bogie and axle: what stands on the rail, turns, is braked and driven."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Counted, Name, Repeated, refuse
from railgrip.scenario.units import Dimensionless, Length, Mass


class Axle(Counted):
    """One wheelset with its brake and motor."""

    rotating_mass: Mass = Field(gt=0, le=20e3, description="Rotating mass at the tread.")
    wheel_radius: Length = Field(ge=0.1, le=1.5, description="True rolling radius.")
    believed_radius: Length = Field(
        default_factory=lambda data: data.get("wheel_radius", 0.5),
        ge=0.1,
        le=1.5,
        description="Radius that the controllers work with; absent: the true one.",
    )
    tread_radius_transverse: Length | None = Field(
        default=None,
        gt=0,
        le=100,
        description="Profile radius of the tread at the contact; absent: cone.",
    )
    brake: Name | None = Field(
        default=None, description="One of the train's brakes; absent: unbraked."
    )
    load_share: Dimensionless | None = Field(
        default=None,
        gt=0,
        le=1,
        description="Share of the vehicle's weight, normalised; absent: equal.",
    )
    friction_factor: Dimensionless = Field(
        default=1.0,
        ge=0,
        le=3,
        description="Friction of this axle's pads or blocks over that of their kind.",
    )
    isolated: bool = Field(
        default=False,
        strict=True,
        description="Whether its friction brake is cut out; the controllers do not know.",
    )
    motor: bool = Field(default=False, strict=True, description="Whether the axle is driven.")
    sander: bool = Field(default=False, strict=True, description="Whether sand falls before it.")


class Bogie(Counted):
    """A bogie, or the place of a single axle (wheelbase 0)."""

    wheelbase: Length = Field(default=0.0, ge=0, le=12, description="First to last axle.")
    mass: Mass = Field(gt=0, le=60e3, description="Of the bogie with its wheelsets.")
    height: Length = Field(default=0.6, ge=0, le=2, description="Centre of gravity over the rail.")
    traction_height: Length = Field(
        default=0.8, ge=0, le=2, description="Height at which body and bogie push each other."
    )
    axle: Annotated[tuple[Axle, ...], Repeated] = Field(
        min_length=1, max_length=12, description="From the front."
    )

    @model_validator(mode="after")
    def _has_room(self) -> Bogie:
        if len(self.axle) > 1 and self.wheelbase < 2 * max(a.wheel_radius for a in self.axle):
            refuse(
                [
                    Problem(
                        "wheelbase",
                        "is less than a wheel's diameter, so the wheels would touch",
                        got=f"{self.wheelbase:g} m",
                    )
                ]
            )
        return self
