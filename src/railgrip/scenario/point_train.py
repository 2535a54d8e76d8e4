"""What a journey without slip needs of a train: mass, effort, resistance, brakes, efficiency."""

from __future__ import annotations

from itertools import pairwise
from typing import Literal

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.equipment import Resistance
from railgrip.scenario.units import (
    Acceleration,
    Area,
    Dimensionless,
    Force,
    Length,
    Mass,
    Power,
    QuadraticResistance,
    Speed,
    WearRate,
)


class EffortPoint(Model):
    """One entry of a table of tractive effort."""

    speed: Speed = Field(ge=0, le=200, description="Speed of the entry.")
    force: Force = Field(ge=0, le=1e7, description="Tractive effort at the wheel.")


class Effort(Model):
    """Tractive effort: greatest force and power, or a table."""

    force: Force | None = Field(default=None, gt=0, le=1e7, description="Greatest force.")
    power: Power | None = Field(default=None, gt=0, le=1e9, description="Greatest wheel power.")
    table: tuple[EffortPoint, ...] = Field(
        default=(), max_length=5000, description="Instead of force and power; from speed 0."
    )
    between: Literal["linear", "held"] = Field(
        default="linear", description="Between two entries: a line, or the entry below holds."
    )

    @model_validator(mode="after")
    def _one_of_two(self) -> Effort:
        problems = []
        if bool(self.table) == (self.force is not None or self.power is not None):
            problems.append(Problem("", "needs either force and power or a table"))
        elif not self.table and (self.force is None or self.power is None):
            problems.append(Problem("", "needs both force and power"))
        if self.table and self.table[0].speed != 0.0:
            problems.append(Problem("table[0].speed", "must be 0"))
        problems += [
            Problem(f"table[{i + 1}].speed", "must be above the entry before it")
            for i, (a, b) in enumerate(pairwise(self.table))
            if b.speed <= a.speed
        ]
        refuse(problems)
        return self


class Regeneration(Model):
    """Braking by the motors, with what the net takes back."""

    force: Force = Field(ge=0, le=1e7, description="Greatest force.")
    power: Power = Field(ge=0, le=1e9, description="Greatest power at the wheel.")
    fade_start: Speed = Field(default=0.0, ge=0, le=50, description="Below it the force falls …")
    fade_end: Speed = Field(default=0.0, ge=0, le=50, description="… to nothing here.")
    receptivity: Dimensionless = Field(
        default=1.0, ge=0, le=1, description="Share of the returned energy that the net takes."
    )

    @model_validator(mode="after")
    def _fades_downwards(self) -> Regeneration:
        if self.fade_end > self.fade_start:
            refuse([Problem("fade_end", "must not be above fade_start")])
        return self


class EfficiencyMap(Model):
    """Efficiency over speed and over the share of the greatest effort."""

    speed: tuple[Speed, ...] = Field(min_length=2, max_length=200, description="Ascending.")
    share: tuple[Dimensionless, ...] = Field(min_length=2, max_length=200, description="Ascending.")
    value: tuple[tuple[Dimensionless, ...], ...] = Field(
        description="One row for each speed, one entry for each share, 0 to 1."
    )

    @model_validator(mode="after")
    def _rectangular(self) -> EfficiencyMap:
        problems = []
        for name in ("speed", "share"):
            if any(b <= a for a, b in pairwise(getattr(self, name))):
                problems.append(Problem(name, "must ascend"))
        if len(self.value) != len(self.speed) or any(
            len(row) != len(self.share) for row in self.value
        ):
            problems.append(Problem("value", "must have one row a speed and one entry a share"))
        if any(not 0 < entry <= 1 for row in self.value for entry in row):
            problems.append(Problem("value", "must lie above 0 and not above 1"))
        refuse(problems)
        return self


class Efficiency(Model):
    """Of the chain pantograph – DC link – wheel."""

    traction: Dimensionless = Field(default=0.85, gt=0, le=1, description="DC link to wheel.")
    regeneration: Dimensionless = Field(default=0.85, ge=0, le=1, description="Wheel to DC link.")
    converter: Dimensionless = Field(
        default=1.0, gt=0, le=1, description="Pantograph to DC link, either way."
    )
    map: EfficiencyMap | None = Field(
        default=None, description="Instead of the constants between DC link and wheel."
    )


class TunnelResistance(Model):
    """Additional drag in tunnels of one cross-section."""

    cross_section: Area = Field(gt=0, le=1000, description="Of the tunnel.")
    quadratic: QuadraticResistance = Field(ge=0, le=1e4, description="Added to the open line's C.")


class PointTrain(Model):
    """A train as one mass, or as a strip of it if it has a length."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    mass: Mass = Field(gt=0, le=1e8, description="With its load.")
    rotating: Dimensionless = Field(default=0.06, ge=0, le=1, description="Rotating mass/mass.")
    length: Length = Field(default=0.0, ge=0, le=5000, description="0: a point.")
    rear_clears: bool = Field(
        default=True,
        strict=True,
        description="Whether a higher limit waits until the rear has left the lower one.",
    )
    max_speed: Speed = Field(gt=0, le=600 / 3.6, description="Of the train itself.")
    resistance: Resistance = Field(default=Resistance(), description="On the open line.")
    tunnel_resistance: tuple[TunnelResistance, ...] = Field(
        default=(), max_length=100, description="The nearest cross-section counts."
    )
    effort: Effort = Field(description="Tractive effort.")
    max_acceleration: Acceleration | None = Field(
        default=None, gt=0, le=5, description="Preset acceleration; absent: full power."
    )
    max_deceleration: Acceleration | None = Field(
        default=None, gt=0, le=5, description="Of service braking."
    )
    regeneration: Regeneration = Field(
        default=Regeneration(force=0.0, power=0.0), description="Brake of the motors."
    )
    friction_brake: Force | None = Field(
        default=None, ge=0, le=1e9, description="Greatest force; absent: as much as is asked."
    )
    pad_wear: WearRate = Field(
        default=0.3e-12,
        ge=0,
        le=1e-10,
        description="Volume that pads and blocks lose by friction work; default illustrative.",
    )
    efficiency: Efficiency = Field(default=Efficiency(), description="Of the traction chain.")
    auxiliaries: Power = Field(default=0.0, ge=0, le=1e8, description="Drawn from the DC link.")

    @model_validator(mode="after")
    def _can_stop(self) -> PointTrain:
        if self.friction_brake is None and self.max_deceleration is None:
            refuse(
                [
                    Problem(
                        "max_deceleration",
                        "is needed where friction_brake has no limit",
                        cure="max_deceleration = '0.7 m/s^2'",
                    )
                ]
            )
        return self

    @property
    def dynamic_mass(self) -> float:
        """Mass that is accelerated, kg."""
        return self.mass * (1.0 + self.rotating)

    def tunnel_quadratic(self, cross_section: float) -> float:
        """Return the drag coefficient that a tunnel adds, N s²/m²; the nearest one listed."""
        if not self.tunnel_resistance:
            return 0.0
        nearest = min(
            self.tunnel_resistance, key=lambda one: abs(one.cross_section - cross_section)
        )
        return nearest.quadratic
