"""What a train has besides its friction brake: dynamic and track brake, sand, sensors."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.units import (
    Dimensionless,
    Force,
    FrictionDecay,
    LinearResistance,
    MassFlow,
    MassPerLength,
    Power,
    QuadraticResistance,
    Speed,
    Time,
    TorsionalDamping,
    TorsionalStiffness,
)


class DynamicBrake(Model):
    """Braking by the motors, per motored axle."""

    force: Force = Field(gt=0, le=200e3, description="Greatest force per motored axle.")
    power: Power = Field(gt=0, le=20e6, description="Greatest power per motored axle.")
    fade_start: Speed = Field(
        default=10 / 3.6, ge=0, le=50, description="Below it the force falls …"
    )
    fade_end: Speed = Field(default=5 / 3.6, ge=0, le=50, description="… to nothing here.")
    build_up: Time = Field(default=1.0, gt=0, le=30, description="From nothing to full force.")
    in_emergency: bool = Field(
        default=True, strict=True, description="Whether it also works in an emergency."
    )

    @model_validator(mode="after")
    def _fades_downwards(self) -> DynamicBrake:
        if self.fade_end >= self.fade_start:
            refuse(
                [
                    Problem(
                        "fade_end",
                        "must be below fade_start",
                        got=f"fade_end {self.fade_end * 3.6:.4g} km/h, "
                        f"fade_start {self.fade_start * 3.6:.4g} km/h",
                    )
                ]
            )
        return self


class TrackBrake(Model):
    """Magnetic track brake of one vehicle; works in an emergency."""

    force: Force = Field(gt=0, le=1e6, description="Attraction of all magnets of the vehicle.")
    friction: Dimensionless = Field(
        default=0.2, gt=0, le=1, description="Friction at walking pace."
    )
    friction_fall: FrictionDecay = Field(
        default=0.02,
        ge=0,
        le=1,
        description="b in friction/(1 + b v): how friction falls with speed.",
    )
    release_speed: Speed = Field(default=0.0, ge=0, le=50, description="Lifted below this speed.")
    build_up: Time = Field(default=1.0, gt=0, le=30, description="From command to full force.")


class Sander(Model):
    """Sanders, one for each axle that has ``sander = true``."""

    flow: MassFlow = Field(default=0.5 / 60, ge=0, le=0.2, description="Sand per axle and time.")
    delay: Time = Field(default=0.5, ge=0, le=10, description="From command to sand on the rail.")
    rail_friction: Dimensionless = Field(
        default=0.2, ge=0, le=1.2, description="Static friction of a rail with plenty of sand."
    )
    dose: MassPerLength = Field(
        default=0.005, gt=0, le=1, description="Sand per metre that brings 63 % of the effect."
    )
    cut_out_speed: Speed = Field(default=0.0, ge=0, le=50, description="No sand below this speed.")


class Sensor(Model):
    """Toothed-wheel speed sensor of every axle."""

    teeth: int = Field(default=100, ge=1, le=1000, description="Teeth of the pole wheel.")
    timer: Time = Field(
        default=1e-5, gt=0, le=0.01, description="Tick of the clock that times a tooth."
    )
    delay: Time = Field(
        default=0.01, ge=0, le=0.5, description="Age of the speed that is handed over."
    )


class Resistance(Model):
    """Running resistance A + B v + C v²."""

    constant: Force = Field(default=0.0, ge=0, le=1e6, description="A.")
    linear: LinearResistance = Field(default=0.0, ge=0, le=1e5, description="B.")
    quadratic: QuadraticResistance = Field(default=0.0, ge=0, le=1e4, description="C.")


class Driveline(Model):
    """Shaft between motor and wheelset, referred to the wheelset; the same on each motored axle."""

    stiffness: TorsionalStiffness = Field(
        gt=0, le=1e9, description="Torque that twists the shaft by one radian."
    )
    damping: TorsionalDamping = Field(
        default=0.0, ge=0, le=1e7, description="Torque for each radian a second of twisting."
    )
    motor_share: Dimensionless = Field(
        gt=0, lt=1, description="Share of the axle's rotating mass that turns with the motor."
    )


class Traction(Model):
    """Tractive effort of the whole train, in equal parts on its motored axles."""

    force: Force = Field(gt=0, le=5e6, description="Greatest tractive effort.")
    power: Power = Field(gt=0, le=100e6, description="Greatest power at the wheel.")
    build_up: Time = Field(default=2.0, gt=0, le=30, description="From nothing to full effort.")
    inverter: Literal["axle", "bogie", "vehicle"] = Field(
        default="axle",
        description="Motors that one inverter feeds: they are reduced together.",
    )
    driveline: Driveline | None = Field(
        default=None, description="Shaft between motor and wheelset; absent: rigid."
    )
