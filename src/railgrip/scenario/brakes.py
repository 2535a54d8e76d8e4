"""The friction brake of an axle, its air, its heat."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.friction import Pad
from railgrip.scenario.reference import Reference
from railgrip.scenario.units import (
    Area,
    Conductance,
    Dimensionless,
    Force,
    HeatTransfer,
    Length,
    Mass,
    Pressure,
    Speed,
    Time,
    Volume,
    VolumeFlow,
)


class Disc(Model):
    """Heat model of one brake disc: two nodes, ring and hub."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    ring_mass: Mass = Field(gt=0, le=1000, description="Mass of the friction ring.")
    hub_mass: Mass = Field(gt=0, le=1000, description="Mass of the hub.")
    conductance: Conductance = Field(ge=0, le=1e5, description="Between ring and hub.")
    surface: Area = Field(gt=0, le=20, description="Surface that gives heat to the air.")
    heat_share: Dimensionless = Field(
        default=0.9, gt=0, le=1, description="Share of the friction heat that goes into the disc."
    )
    film_still: HeatTransfer = Field(
        default=9.0, ge=0, le=500, description="Heat transfer to the air at standstill."
    )
    film_wind: Dimensionless = Field(
        default=3.0, ge=0, le=100, description="Times v^0.8 (v in m/s) added to it, W/(m²K)."
    )
    emissivity: Dimensionless = Field(default=0.7, ge=0, le=1, description="Of the disc's surface.")


class FrictionBrake(Model):
    """Cylinder, rigging and pads or blocks of one braked axle.

    F_C = p A η + spring; F_b = F_C i η + spring, per cylinder.
    """

    kind: Literal["disc", "block"] = Field(description="Pads on a disc, or blocks on the tread.")
    cylinder_pressure: Pressure = Field(gt=0, le=12e5, description="Gauge, in an emergency.")
    cylinder_area: Area = Field(gt=0, le=1, description="Piston area of one cylinder.")
    cylinder_efficiency: Dimensionless = Field(
        default=1.0, gt=0, le=1, description="Of the cylinder."
    )
    cylinder_spring: Force = Field(
        default=0.0, ge=-50e3, le=0, description="Return spring of the cylinder, negative."
    )
    rigging_ratio: Dimensionless = Field(gt=0, le=100, description="Force ratio of the rigging.")
    rigging_efficiency: Dimensionless = Field(
        default=1.0, gt=0, le=1, description="Of the rigging."
    )
    rigging_spring: Force = Field(
        default=0.0, ge=-50e3, le=0, description="Return spring or slack adjuster, negative."
    )
    units: Dimensionless = Field(
        default=1.0, gt=0, le=12, description="Cylinders per axle; 0.25: one for four axles."
    )
    friction_radius: Length | None = Field(
        default=None, gt=0, le=1, description="Mean radius of the pads on the disc; discs only."
    )
    blocks: int = Field(default=1, ge=1, le=64, description="Blocks per cylinder; blocks only.")
    pad: Annotated[Pad, Reference("pad")] = Field(
        description="Pad or block: a shipped name, a file or a table."
    )
    hysteresis: Dimensionless = Field(
        default=0.0, ge=0, le=0.5, description="Share by which the clamp force lags on release."
    )
    fill: Literal["linear", "orifice", "lag"] = Field(
        default="orifice",
        description="Shape of the filling; lag: an electro-mechanical brake, whose clamp force "
        "follows the demand with a first-order lag.",
    )
    lag: Time = Field(
        default=0.06, gt=0, le=10, description="Time constant of an electro-mechanical brake."
    )
    dead_time: Time = Field(
        default=0.3, ge=0, le=60, description="From command to first pressure, t_a."
    )
    fill_time: Time = Field(
        default=2.0,
        gt=0,
        le=120,
        description="From first pressure to 95 % (orifice) or full (linear).",
    )
    inshot: Dimensionless = Field(
        default=0.0, ge=0, le=0.9, description="Share of the pressure that comes at once."
    )
    release_time: Time = Field(default=4.0, gt=0, le=120, description="From full pressure to 5 %.")
    disc: Annotated[Disc, Reference("disc")] | None = Field(
        default=None,
        description="Heat of the disc: a shipped name, a file or a table; absent: cold.",
    )

    @model_validator(mode="after")
    def _fits_its_kind(self) -> FrictionBrake:
        problems = []
        if self.kind == "disc" and self.friction_radius is None:
            problems.append(Problem("friction_radius", "is needed for kind 'disc'"))
        if self.kind == "block" and self.friction_radius is not None:
            problems.append(
                Problem(
                    "friction_radius",
                    "contradicts kind 'block', which rubs at the wheel radius",
                    cure="leave it out, or write kind = 'disc'",
                )
            )
        refuse(problems)
        return self

    @property
    def greatest_clamp_force(self) -> float:
        """F_b per cylinder at full pressure, N."""
        cylinder = self.cylinder_pressure * self.cylinder_area * self.cylinder_efficiency
        piston = cylinder + self.cylinder_spring
        return piston * self.rigging_ratio * self.rigging_efficiency + self.rigging_spring


class BrakeControl(Model):
    """How the driver's demand reaches the vehicles."""

    kind: Literal["ep", "pipe"] = Field(
        default="ep",
        description="ep: every vehicle is told at once; pipe: a wave along the brake pipe.",
    )
    wave_speed: Speed = Field(
        default=250.0, ge=50, le=400, description="Speed of the wave in the brake pipe; pipe only."
    )


class DumpValve(Model):
    """The pair of valves with which the slide protection empties and fills a cylinder."""

    vent_delay: Time = Field(default=0.05, ge=0, le=1, description="From command to flow, venting.")
    fill_delay: Time = Field(default=0.06, ge=0, le=1, description="From command to flow, filling.")
    vent_time: Time = Field(default=0.7, gt=0, le=20, description="From 3.8 to 0.4 bar.")
    fill_time_valve: Time = Field(default=1.0, gt=0, le=20, description="From 0.4 to 3.6 bar.")
    cylinder_volume: Volume = Field(
        default=0.012, gt=0, le=0.2, description="Cylinders and pipe of one axle."
    )


class Reservoir(Model):
    """Compressed air that each vehicle has for braking."""

    volume: Volume = Field(default=0.15, gt=0, le=10, description="Of one vehicle.")
    pressure: Pressure = Field(default=7e5, gt=0, le=15e5, description="Gauge, at the start.")
    recharge: VolumeFlow = Field(
        default=0.0, ge=0, le=1, description="Free air that flows in while braking, per vehicle."
    )
