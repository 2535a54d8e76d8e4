"""A vehicle on its bogies: masses, places of the axles, load and brake force."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Counted, Repeated, Text, places, refuse
from railgrip.scenario.bogie import Bogie
from railgrip.scenario.equipment import Resistance, TrackBrake
from railgrip.scenario.units import Dimensionless, Length, Mass


class Vehicle(Counted):
    """One vehicle, standing on its bogies."""

    name: Text = Field(default="", description="Name for people.")
    length: Length = Field(gt=0, le=200, description="Over couplers.")
    tare: Mass = Field(gt=0, le=500e3, description="Mass without payload, bogies included.")
    payload: Mass = Field(default=0.0, ge=0, le=500e3, description="As loaded in normal service.")
    payload_max: Mass = Field(
        default_factory=lambda data: data.get("payload", 0.0),
        ge=0,
        le=500e3,
        description="When laden; absent: the payload.",
    )
    body_height: Length = Field(
        default=1.7, gt=0, le=4, description="Centre of gravity of the body over the rail."
    )
    pivot_distance: Length = Field(
        default=0.0, ge=0, le=100, description="First to last bogie pivot."
    )
    resistance: Resistance | None = Field(default=None, description="Added to the train's.")
    load_braking: Literal["none", "continuous", "changeover"] = Field(
        default="none", description="How the brake force follows the load."
    )
    changeover_mass: Mass | None = Field(
        default=None, gt=0, le=500e3, description="Vehicle mass from which it brakes as laden."
    )
    empty_factor: Dimensionless | None = Field(
        default=None,
        gt=0,
        le=1,
        description="Brake force when empty over that when laden; absent: as the masses.",
    )
    track_brake: TrackBrake | None = Field(default=None, description="Magnetic track brake.")
    bogie: Annotated[tuple[Bogie, ...], Repeated] = Field(
        min_length=1, max_length=20, description="From the front."
    )

    @model_validator(mode="after")
    def _fits_together(self) -> Vehicle:
        refuse([*self._masses(), *self._lengths(), *self._shares()])
        return self

    def _masses(self) -> list[Problem]:
        problems = []
        bogies = sum(bogie.mass for bogie in self.bogie)
        if bogies >= self.tare:
            problems.append(
                Problem(
                    "tare",
                    "must be more than the bogies alone",
                    got=f"{self.tare:g} kg, bogies {bogies:g} kg",
                )
            )
        if self.payload > self.payload_max:
            problems.append(
                Problem(
                    "payload",
                    "is more than payload_max",
                    got=f"{self.payload:g} kg, payload_max {self.payload_max:g} kg",
                )
            )
        if self.load_braking == "changeover" and self.changeover_mass is None:
            problems.append(
                Problem(
                    "changeover_mass",
                    "is needed for load_braking 'changeover'",
                )
            )
        return problems

    def _lengths(self) -> list[Problem]:
        problems = []
        if len(self.bogie) > 1 and self.pivot_distance == 0:
            problems.append(Problem("pivot_distance", "is needed with more than one bogie"))
        axles = self.axle_offsets()
        if axles[0] < 0 or axles[-1] > self.length:
            problems.append(
                Problem(
                    "length",
                    "is shorter than the wheel base of the vehicle",
                    got=f"{self.length:g} m for {axles[-1] - axles[0]:g} m",
                )
            )
        if any(later <= earlier for earlier, later in pairwise(axles)):
            problems.append(
                Problem(
                    "pivot_distance",
                    "is so short that bogies overlap",
                    got=f"{self.pivot_distance:g} m",
                )
            )
        return problems

    def _shares(self) -> list[Problem]:
        axles = [axle for bogie in self.bogie for axle in bogie.axle]
        shares = [axle.load_share for axle in axles if axle.load_share is not None]
        if not shares:
            return []
        if len(shares) < len(axles):
            missing = next(
                f"bogie[{i}].axle[{k}].load_share"
                for i, bogie in places(self.bogie)
                for k, axle in places(bogie.axle)
                if axle.load_share is None
            )
            return [Problem(missing, "is missing, while other axles of the vehicle have one")]
        if not math.isclose(sum(shares), 1.0, abs_tol=1e-3):
            return [
                Problem(
                    "bogie", "the load_share of all axles must sum to 1", got=f"{sum(shares):.6g}"
                )
            ]
        return []

    def pivot_offsets(self) -> tuple[float, ...]:
        """Distance of each bogie's middle behind the vehicle's front, m."""
        return _spread(self.length / 2, self.pivot_distance, len(self.bogie))

    def axle_offsets(self) -> tuple[float, ...]:
        """Distance of each axle behind the vehicle's front, m."""
        return tuple(
            offset
            for pivot, bogie in zip(self.pivot_offsets(), self.bogie, strict=True)
            for offset in _spread(pivot, bogie.wheelbase, len(bogie.axle))
        )

    def load_shares(self) -> tuple[float, ...]:
        """Share of the vehicle's weight on each axle at rest; they sum to 1."""
        shares = [axle.load_share or 1.0 for bogie in self.bogie for axle in bogie.axle]
        return tuple(share / sum(shares) for share in shares)

    def brake_factor(self, payload: float) -> float:
        """Brake force at this payload over the full one, as the load-dependent brake sets it."""
        laden = self.tare + self.payload_max
        empty = self.tare / laden if self.empty_factor is None else self.empty_factor
        if self.load_braking == "changeover" and self.changeover_mass is not None:
            return 1.0 - (1.0 - empty) * (self.tare + payload < self.changeover_mass)
        if self.load_braking == "continuous" and self.payload_max > 0:
            return empty + (1 - empty) * payload / self.payload_max
        return 1.0


def _spread(middle: float, span: float, n: int) -> tuple[float, ...]:
    if n == 1:
        return (middle,)
    return tuple(middle - span / 2 + span * i / (n - 1) for i in range(n))
