"""Brake control above the slide protection: friction estimate, deceleration controller, stop."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.friction import Pad
from railgrip.scenario.reference import Reference
from railgrip.scenario.units import Acceleration, Dimensionless, Force, Length, Speed, Temperature
from railgrip.scenario.units import Time as Seconds

Function = Literal["temperature", "speed", "clamp_force"]
FUNCTIONS: tuple[Function, ...] = ("temperature", "speed", "clamp_force")

Share = Annotated[Dimensionless, Field(ge=0, le=1)]
_POINTS = "a share, or up to four points [[at, share], …]; constant outside them"


def _as_points(value: Any) -> Any:
    # one share everywhere is the short form of a single point
    return ((0.0, value),) if isinstance(value, (int, float, str)) else value


_One = tuple[tuple[float, Share], ...]
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


class Estimator(Model):
    """Estimate of pad friction, fed forward."""

    per: Literal["unit", "train"] = Field(
        default="unit", description="One estimate in each local unit, or one for the train."
    )
    functions: tuple[Function, ...] = Field(
        default=FUNCTIONS, description="Which influences it knows; any subset."
    )
    pad: Annotated[Pad, Reference("pad")] | None = Field(
        default=None, description="What is known of the pads; absent: the axle's own pad."
    )
    temperature: Literal["sensor", "model"] = Field(
        default="sensor", description="Disc temperature: measured, or from a model of the disc."
    )
    sensor_lag: Seconds = Field(
        default=4.0, ge=0, le=120, description="Time constant of the temperature sensors."
    )
    pads_are: Literal["new", "worn"] = Field(default="new", description="State, for the rules.")
    passed_on: Literal["always", "past_threshold"] = Field(
        default="always", description="past_threshold: only once the deceleration deviates so far."
    )
    rule: tuple[Rule, ...] = Field(
        default=(Rule(),), max_length=20, description="Bounds and weights; the last that holds."
    )


class DecelerationControl(Model):
    """Controller of the train's deceleration. All gains illustrative."""

    acts: Literal["always", "past_threshold"] = Field(
        default="always", description="All the time, or once the deviation is past its threshold."
    )
    proportional: Dimensionless = Field(
        default=0.3, ge=0, le=5, description="Correction per relative deviation."
    )
    integral: Dimensionless = Field(
        default=0.7, ge=0, le=5, description="Growth of the correction, 1/s per deviation."
    )
    greatest: Dimensionless = Field(
        default=0.4, ge=0, le=1, description="Greatest correction, over what is asked."
    )
    rate: Dimensionless = Field(
        default=0.5, gt=0, le=100, description="Fastest change of the correction, 1/s."
    )
    settling: Seconds | None = Field(
        default=None,
        ge=0,
        le=60,
        description="Waits after a new demand; absent: as the brakes fill.",
    )
    measuring_lag: Seconds = Field(default=0.2, gt=0, le=10, description="Filter of the sensor.")
    delay: Seconds = Field(default=0.1, ge=0, le=3, description="From central to local units.")


class Thresholds(Model):
    """Deviation of the deceleration past which what waits for it begins to act."""

    service: Acceleration = Field(default=0.1, ge=0, le=2, description="In a service braking.")
    emergency: Acceleration = Field(default=0.05, ge=0, le=2, description="In an emergency.")
    degraded_share: Dimensionless = Field(
        default=0.5, ge=0, le=1, description="What counts of both once a brake has failed."
    )


class BrakeControlLayer(Model):
    """Central unit, local units, estimators: what is asked, and with which pressure."""

    period: Seconds = Field(default=0.05, ge=0.01, le=1, description="Between two looks.")
    local_unit: Literal["axle", "bogie", "vehicle"] = Field(
        default="bogie", description="What one local unit looks after."
    )
    pressure_reserve: Dimensionless = Field(
        default=1.15,
        ge=1,
        le=2,
        description="Greatest cylinder pressure over the nominal full one.",
    )
    adapts: Literal["coefficient", "characteristic"] = Field(
        default="coefficient", description="What the estimate changes."
    )
    estimator: Estimator | None = Field(
        default=None, description="Absent: the reference friction, always."
    )
    deceleration: DecelerationControl | None = Field(
        default=None, description="Absent: none; what is fed forward must do."
    )
    threshold: Thresholds = Field(default=Thresholds(), description="For what waits for it.")
    jerk_service: Dimensionless | None = Field(
        default=None, gt=0, le=100, description="Of the asked deceleration, m/s³; absent: any."
    )
    jerk_emergency: Dimensionless | None = Field(
        default=None, gt=0, le=100, description="The same in an emergency."
    )
    gradient_compensation: Dimensionless = Field(
        default=0.0, ge=0, le=1, description="Share; in an emergency downhill only."
    )
    redistributes: bool = Field(
        default=False, strict=True, description="Sound brakes take over from failed ones."
    )
    stop_at: Length | None = Field(
        default=None, ge=0, le=1e7, description="Place on the line to stop at; absent: none."
    )
    response: Seconds = Field(
        default=0.6, ge=0, le=5, description="By which the brakes follow late, for stop_at."
    )
    least_stopping_speed: Speed = Field(
        default=0.4, gt=0, le=5, description="Below it the last deceleration is kept."
    )

    @model_validator(mode="after")
    def _fits_together(self) -> BrakeControlLayer:
        problems = []
        late = self.deceleration.delay if self.deceleration is not None else 0.0
        if late > 60 * self.period:
            problems.append(
                Problem(
                    "deceleration.delay",
                    "must be at most 60 periods",
                    got=f"{late:g} s with a period of {self.period:g} s",
                    cure="a longer period",
                )
            )
        refuse(problems)
        return self
