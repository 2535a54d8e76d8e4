"""Brake control above the slide protection: friction estimate, deceleration controller, stop."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.friction import Pad
from railgrip.scenario.limit_rules import Rule
from railgrip.scenario.reference import Reference
from railgrip.scenario.units import Acceleration, Dimensionless, Length, Speed
from railgrip.scenario.units import Time as Seconds

Function = Literal["temperature", "speed", "clamp_force"]
FUNCTIONS: tuple[Function, ...] = ("temperature", "speed", "clamp_force")


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
