"""The rail's condition: two friction states, what turns one into the other, and where."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.reference import Reference
from railgrip.scenario.units import Dimensionless, FrictionDecay, Length, LengthPerEnergy


class FrictionState(Model):
    """Friction of the contact in one state of the rail (Polach's parameters).

    friction = static_friction · [(1 − A) exp(−B w) + A], w the slip velocity.
    """

    static_friction: Dimensionless = Field(ge=0, le=1.2, description="μ0, without slip.")
    friction_ratio: Dimensionless = Field(
        default=0.4, gt=0, le=1, description="A, friction at great slip over μ0."
    )
    friction_decay: FrictionDecay = Field(default=0.6, ge=0, le=20, description="B.")
    adhesion_reduction: Dimensionless = Field(
        default=1.0, gt=0, le=1, description="k_A, in the area of adhesion."
    )
    slip_reduction: Dimensionless = Field(
        default=0.4, gt=0, le=1, description="k_S, in the area of slip."
    )

    @model_validator(mode="after")
    def _ordered(self) -> FrictionState:
        if self.slip_reduction > self.adhesion_reduction:
            refuse(
                [
                    Problem(
                        "slip_reduction",
                        "must not be more than adhesion_reduction",
                        got=f"{self.slip_reduction:g}, the other {self.adhesion_reduction:g}",
                    )
                ]
            )
        return self


DRY = FrictionState(static_friction=0.55)  # Polach 2005, "dry"


class RailCondition(Model):
    """What lies on the rail, and how wheels that slide over it rub it off."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    contaminated: FrictionState = Field(default=DRY, description="As the first wheel finds it.")
    clean: FrictionState = Field(
        default_factory=lambda data: data.get("contaminated", DRY),
        description="When all is rubbed off; absent: as contaminated.",
    )
    cleaning: LengthPerEnergy = Field(
        default=0.0,
        ge=0,
        le=1,
        description="Per friction energy and metre of rail; 0: never cleaned.",
    )


class RailPatch(Model):
    """A stretch of the line with another condition."""

    begin: Length = Field(alias="from", ge=0, le=1e6, description="Position on the line.")
    end: Length = Field(alias="to", ge=0, le=1e6, description="Position on the line.")
    condition: Annotated[RailCondition, Reference("rail_condition")] = Field(
        description="A shipped name, a file or a table."
    )

    @model_validator(mode="after")
    def _has_length(self) -> RailPatch:
        if self.end <= self.begin:
            refuse(
                [
                    Problem(
                        "to",
                        "must lie beyond 'from'",
                        got=f"from {self.begin:g} m to {self.end:g} m",
                    )
                ]
            )
        return self


class RandomField(Model):
    """Friction that varies at random along the line (lognormal, exponential correlation).

    The static friction is multiplied by a factor of mean 1 and standard deviation spread/mean;
    outside patches the condition's own friction is first brought to ``mean``.
    """

    mean: Dimensionless = Field(gt=0, le=1.2, description="Of the contaminated static friction.")
    spread: Dimensionless = Field(ge=0, le=1.2, description="Its standard deviation.")
    correlation_length: Length = Field(gt=0, le=1e5, description="Where 1/e of it is left.")
    seed: int | None = Field(
        default=None, ge=0, lt=2**63, description="Absent: the seed of the run."
    )


class Rail(Model):
    """The condition along the line."""

    condition: Annotated[RailCondition, Reference("rail_condition")] = Field(
        default=RailCondition(title="dry"), description="A shipped name, a file or a table."
    )
    patch: tuple[RailPatch, ...] = Field(
        default=(),
        max_length=10_000,
        description="Stretches with another condition, not overlapping.",
    )
    random: RandomField | None = Field(default=None, description="Random variation along the line.")

    @model_validator(mode="after")
    def _apart(self) -> Rail:
        ordered = sorted(enumerate(self.patch), key=lambda item: item[1].begin)
        refuse(
            [
                Problem(
                    f"patch[{later}]",
                    f"overlaps patch[{earlier}]",
                    got=f"{b.begin:g} to {b.end:g} m and {a.begin:g} to {a.end:g} m",
                )
                for (earlier, a), (later, b) in pairwise(ordered)
                if b.begin < a.end
            ]
        )
        return self
