"""National values of the ETCS supervision, and quantities that change in steps."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from pydantic import Field, model_validator

from railgrip.control.etcs.steps import Steps
from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.units import Acceleration, Dimensionless, Gradient, Length, Speed

FAST = 600 / 3.6
"""No train is faster, m/s."""


class DecelerationStep(Model):
    """A deceleration that holds from a speed upwards."""

    begin: Speed = Field(default=0.0, alias="from", ge=0, le=FAST, description="Speed.")
    value: Acceleration = Field(gt=0, le=10, description="Deceleration.")


class CorrectionStep(Model):
    """Kn, which holds from a speed upwards."""

    begin: Speed = Field(default=0.0, alias="from", ge=0, le=FAST, description="Speed.")
    value: Acceleration = Field(ge=0, le=10, description="Times the gradient.")


class FactorStep(Model):
    """A factor that holds from a speed upwards."""

    begin: Speed = Field(default=0.0, alias="from", ge=0, le=FAST, description="Speed.")
    value: Dimensionless = Field(gt=0, le=2, description="Factor.")


class PairStep(Model):
    """Two factors of a passenger train that hold from a speed upwards."""

    begin: Speed = Field(default=0.0, alias="from", ge=0, le=FAST, description="Speed.")
    weak: Dimensionless = Field(gt=0, le=2, description="Up to A_NVP12.")
    strong: Dimensionless = Field(gt=0, le=2, description="From A_NVP23 on.")


class LengthStep(Model):
    """A factor that holds for trains longer than a length."""

    begin: Length = Field(default=0.0, alias="over", ge=0, le=1e4, description="Train length.")
    value: Dimensionless = Field(gt=0, le=2, description="Factor.")


class DrySteps(Model):
    """Kdry for one confidence level."""

    confidence_level: int = Field(ge=0, le=9, description="M_NVEBCL: 0 (50 %) to 9.")
    steps: tuple[FactorStep, ...] = Field(min_length=1, max_length=50, description="Over speed.")


class GradientFrom(Model):
    """A gradient that holds from here on; the first one holds before it too."""

    at: Length = Field(ge=-1e6, le=1e6, description="Position.")
    value: Gradient = Field(ge=-0.3, le=0.3, description="Positive uphill.")


class Area(Model):
    """A stretch with reduced adhesion."""

    begin: Length = Field(alias="from", ge=-1e6, le=1e6, description="Position.")
    end: Length = Field(alias="to", ge=-1e6, le=1e6, description="Position.")


class NationalValues(Model):
    """What the infrastructure asks of the supervision; defaults as in SUBSET-026, A.3.2."""

    available_adhesion: Dimensionless = Field(default=0.0, ge=0, le=1, description="M_NVAVADH.")
    confidence_level: int = Field(default=9, ge=0, le=9, description="M_NVEBCL.")
    reduced_adhesion: tuple[Acceleration, Acceleration, Acceleration] = Field(
        default=(1.0, 0.7, 0.7), description="A_NVMAXREDADH1 to 3."
    )
    kv_freight: tuple[FactorStep, ...] = Field(
        default=(FactorStep(value=0.7),), min_length=1, max_length=50, description="Kv_int."
    )
    kv_passenger: tuple[PairStep, ...] = Field(
        default=(PairStep(weak=0.7, strong=0.7),),
        min_length=1, max_length=50, description="Kv_int, both tables.",
    )  # fmt: skip
    a_nvp12: Acceleration = Field(default=1.0, gt=0, le=10, description="Lower pivot of Kv_int.")
    a_nvp23: Acceleration = Field(default=1.3, gt=0, le=10, description="Upper pivot of Kv_int.")
    kr: tuple[LengthStep, ...] = Field(
        default=(LengthStep(value=0.9),), min_length=1, max_length=50, description="Kr_int."
    )
    kt: Dimensionless = Field(default=1.1, gt=0, le=10, description="Kt_int.")
    guidance: bool = Field(default=False, strict=True, description="Q_NVGUIPERM.")
    compensate_speed: bool = Field(
        default=False,
        strict=True,
        description="Whether the speed's inaccuracy is compensated (Q_NVINHSMICPERM no).",
    )
    service_brake: bool = Field(
        default=True, strict=True, description="Q_NVSBTSMPERM: it may be commanded."
    )

    @model_validator(mode="after")
    def _in_order(self) -> NationalValues:
        problems = [p for name in ("kv_freight", "kv_passenger", "kr")
                    for p in unordered(name, getattr(self, name))]  # fmt: skip
        if self.a_nvp23 <= self.a_nvp12:
            got = f"{self.a_nvp12:g} and {self.a_nvp23:g} m/s²"
            problems.append(Problem("a_nvp23", "must be above a_nvp12", got=got))
        refuse(problems)
        return self


def steps_of(items: Sequence[DecelerationStep | CorrectionStep | FactorStep]) -> Steps:
    """Return the steps that entries of a file describe."""
    return Steps(tuple(item.begin for item in items), tuple(item.value for item in items))


def unordered(
    name: str,
    items: Sequence[DecelerationStep | CorrectionStep | FactorStep | PairStep | LengthStep],
) -> list[Problem]:
    """Return what is wrong with the order of a list of steps."""
    return [
        Problem(f"{name}[{i + 1}]", "must begin above the entry before it")
        for i, (a, b) in enumerate(pairwise(items)) if b.begin <= a.begin
    ]  # fmt: skip
