"""Bounds and weights of a friction estimate, and the rules for when they hold."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.units import Dimensionless, Force, Speed, Temperature
from railgrip.scenario.units import Time as Seconds

Share = Annotated[Dimensionless, Field(ge=0, le=1)]
_POINTS = "a share, or up to four points [[at, share], …]; constant outside them"


def _as_points(value: Any) -> Any:
    # one share everywhere is the short form of a single point
    return ((0.0, value),) if isinstance(value, (int, float, str)) else value


TemperatureWeight = Annotated[
    tuple[tuple[Temperature, Share], ...],
    Field(min_length=1, max_length=4, description=f"By disc temperature: {_POINTS}."),
    BeforeValidator(_as_points),
]
SpeedWeight = Annotated[
    tuple[tuple[Speed, Share], ...],
    Field(min_length=1, max_length=4, description=f"By rubbing speed: {_POINTS}."),
    BeforeValidator(_as_points),
]
ForceWeight = Annotated[
    tuple[tuple[Force, Share], ...],
    Field(min_length=1, max_length=4, description=f"By clamp force: {_POINTS}."),
    BeforeValidator(_as_points),
]
Bound = Annotated[Dimensionless, Field(gt=0, le=3)]


class Bounds(Model):
    """How far one function of the estimate may go."""

    least: Bound | None = Field(default=None, description="Least value; absent: any.")
    greatest: Bound | None = Field(default=None, description="Greatest value; absent: any.")

    @model_validator(mode="after")
    def _in_order(self) -> Bounds:
        if self.least is not None and self.greatest is not None and self.least > self.greatest:
            refuse(
                [Problem("least", "is more than greatest", f"{self.least:g}, {self.greatest:g}")]
            )
        return self


class TemperatureLimits(Bounds):
    """Bounds and weight of the function of disc temperature."""

    weight: TemperatureWeight = ((0.0, 1.0),)


class SpeedLimits(Bounds):
    """Bounds and weight of the function of rubbing speed."""

    weight: SpeedWeight = ((0.0, 1.0),)


class ForceLimits(Bounds):
    """Bounds and weight of the function of clamp force."""

    weight: ForceWeight = ((0.0, 1.0),)


class LimitSet(Model):
    """Bounds and weights of the three functions."""

    temperature: TemperatureLimits = Field(default=TemperatureLimits(), description="Of f1.")
    speed: SpeedLimits = Field(default=SpeedLimits(), description="Of f2.")
    clamp_force: ForceLimits = Field(default=ForceLimits(), description="Of f3.")
    weight: Dimensionless = Field(default=1.0, ge=0, le=2, description="Common to all three.")


class ControlLimitSet(LimitSet):
    """Bounds and weights that limit what the control makes of the model."""

    form: Literal["functions", "result", "deviation"] = Field(
        default="functions", description="What the weights act on."
    )

    @model_validator(mode="after")
    def _result_is_not_nothing(self) -> ControlLimitSet:
        weights = [self.temperature.weight, self.speed.weight, self.clamp_force.weight]
        least = self.weight * min(share for points in weights for _, share in points)
        if self.form == "result" and least <= 0:
            refuse(
                [
                    Problem(
                        "weight",
                        "of the result must be more than 0: it multiplies the friction",
                        got=f"{least:g}",
                        cure="form = 'deviation', where 0 is no compensation",
                    )
                ]
            )
        return self


class Rule(Model):
    """Sets of bounds and weights, and when they hold; the last rule that holds decides."""

    brake: Literal["any", "service", "emergency"] = Field(default="any", description="Kind.")
    pads: Literal["any", "new", "worn"] = Field(default="any", description="State of the pads.")
    train_speed: tuple[Speed | None, Speed | None] = Field(
        default=(None, None), description="[from, to]; null: open."
    )
    time: tuple[Seconds | None, Seconds | None] = Field(
        default=(None, None), description="Since the brake command, [from, to]."
    )
    disc_temperature: tuple[Temperature | None, Temperature | None] = Field(
        default=(None, None), description="[from, to]."
    )
    rubbing_speed: tuple[Speed | None, Speed | None] = Field(
        default=(None, None), description="[from, to]."
    )
    clamp_force: tuple[Force | None, Force | None] = Field(
        default=(None, None), description="[from, to]."
    )
    model: LimitSet = Field(default=LimitSet(), description="C_M, g_M: physics.")
    control: ControlLimitSet = Field(default=ControlLimitSet(), description="C_S, g_S: safety.")

    @model_validator(mode="after")
    def _ranges_in_order(self) -> Rule:
        names = ("train_speed", "time", "disc_temperature", "rubbing_speed", "clamp_force")
        refuse(
            [
                Problem(name, "must rise", got=f"{low:g} to {high:g}")
                for name in names
                for low, high in [getattr(self, name)]
                if low is not None and high is not None and low > high
            ]
        )
        return self
