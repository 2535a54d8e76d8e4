"""A train as the ETCS supervision knows it: gamma, or braked weight (lambda)."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from railgrip.control.etcs.braked_weight import FASTEST, GREATEST, LEAST, LONGEST
from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.supervision_values import (
    FAST,
    CorrectionStep,
    DecelerationStep,
    DrySteps,
    FactorStep,
    unordered,
)
from railgrip.scenario.units import Acceleration, Dimensionless, Length, Percentage, Speed, Time


class SupervisedTrain(Model):
    """A train, by its brake's deceleration (gamma) or by its braked weight percentage (lambda)."""

    length: Length = Field(gt=0, le=5000, description="Length.")
    top_speed: Speed = Field(default=FASTEST, gt=0, le=FAST, description="Maximum speed.")
    braked_weight: Percentage | None = Field(default=None, description="λ, per cent.")
    position: Literal["passenger P", "freight P", "freight G"] = Field(
        default="passenger P", description="Brake position."
    )
    emergency: tuple[DecelerationStep, ...] = Field(
        default=(), max_length=50, description="A_brake_emergency."
    )
    service: tuple[DecelerationStep, ...] = Field(
        default=(), max_length=50, description="A_brake_service."
    )
    normal_service: tuple[DecelerationStep, ...] = Field(
        default=(), max_length=50, description="A_brake_normal_service, for the guidance curve."
    )
    kn_uphill: tuple[CorrectionStep, ...] = Field(default=(), max_length=50, description="Kn+.")
    kn_downhill: tuple[CorrectionStep, ...] = Field(default=(), max_length=50, description="Kn−.")
    emergency_time: Time | None = Field(default=None, ge=0, le=100, description="Build-up time.")
    service_time: Time | None = Field(default=None, ge=0, le=100, description="Build-up time.")
    kdry: tuple[DrySteps, ...] = Field(default=(), max_length=10, description="Kdry_rst.")
    kwet: tuple[FactorStep, ...] = Field(default=(), max_length=50, description="Kwet_rst.")
    rotating_mass: Dimensionless | None = Field(
        default=None, ge=0, le=1, description="Nominal share; else 15 % uphill, 2 % downhill."
    )
    service_brake_interface: bool = Field(
        default=False, strict=True, description="Whether the service brake can be commanded."
    )
    traction_cut_off_interface: bool = Field(
        default=False, strict=True, description="Whether the warning cuts traction off."
    )
    traction_cut_off_time: Time = Field(default=0.0, ge=0, le=100, description="T_traction_cutoff.")
    adhesion_independent_brake: bool = Field(
        default=False, strict=True, description="Whether magnets count on bad rail."
    )
    acceleration: Acceleration = Field(default=0.0, ge=-5, le=5, description="Estimated.")

    @model_validator(mode="after")
    def _has_one_brake(self) -> SupervisedTrain:
        names = ("emergency", "service", "normal_service", "kn_uphill", "kn_downhill", "kwet")
        problems = [p for name in names for p in unordered(name, getattr(self, name))]
        gamma = {"emergency": self.emergency, "service": self.service,
                 "emergency_time": self.emergency_time is not None,
                 "service_time": self.service_time is not None}  # fmt: skip
        if self.braked_weight is None:
            problems += [
                Problem(name, "is missing", cure="give it, or braked_weight")
                for name, given in gamma.items() if not given
            ]  # fmt: skip
        else:
            problems += [
                Problem(name, "contradicts braked_weight", cure="give one of them")
                for name in (*gamma, "kdry", "kwet") if gamma.get(name, getattr(self, name))
            ]  # fmt: skip
            problems += self._outside_conversion(self.braked_weight)
        refuse(problems)
        return self

    def _outside_conversion(self, percentage: float) -> list[Problem]:
        longest = LONGEST[self.position]
        checks = (
            ("braked_weight", percentage, LEAST, GREATEST, 1.0, "%"),
            ("length", self.length, 0.0, longest, 1.0, f"m for {self.position}"),
            ("top_speed", self.top_speed, 0.0, FASTEST, 3.6, "km/h"),
        )
        return [
            Problem(name, "is outside the conversion of braked weight", got=f"{k * value:g}",
                    allowed=f"{k * low:g} to {k * high:g} {unit}")
            for name, value, low, high, k, unit in checks if not low <= value <= high * (1 + 1e-12)
        ]  # fmt: skip
