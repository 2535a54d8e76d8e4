"""Pads and blocks: how their friction depends on temperature, speed and force."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.units import Dimensionless, Force, Speed, Temperature

Factor = Annotated[Dimensionless, Field(ge=0, le=3)]
TemperaturePoint = tuple[Annotated[Temperature, Field(ge=-60, le=1500)], Factor]
SpeedPoint = tuple[Annotated[Speed, Field(ge=0, le=170)], Factor]
ForcePoint = tuple[Annotated[Force, Field(ge=0, le=500e3)], Factor]

_POINTS = "at most four points, ascending; held constant outside them"


class ConstantPad(Model):
    """A pad or block with one friction at all times."""

    law: Literal["constant"] = "constant"
    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    friction: Dimensionless = Field(gt=0, le=1, description="Friction of pad or block.")


class KarwatzkiPad(Model):
    """A block by Karwatzki's form: base · (F + a)/(F + b) · (v + c)/(v + d) (1950).

    The defaults are a composite block; cast iron takes the same form with other constants.
    """

    law: Literal["karwatzki_1950"] = "karwatzki_1950"
    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    base: Dimensionless = Field(default=0.055, gt=0, le=1, description="Friction in the limit.")
    force_high: Force = Field(default=200e3, gt=0, le=2e6, description="a, force per block.")
    force_low: Force = Field(default=50e3, gt=0, le=2e6, description="b, force per block.")
    speed_high: Speed = Field(default=150 / 3.6, gt=0, le=500, description="c.")
    speed_low: Speed = Field(default=75 / 3.6, gt=0, le=500, description="d.")


class PiecewisePad(Model):
    """A pad whose friction is a reference times piecewise linear factors."""

    law: Literal["piecewise"] = "piecewise"
    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    reference_friction: Dimensionless = Field(gt=0, le=1, description="Friction at factor 1.")
    temperature: tuple[TemperaturePoint, ...] = Field(
        default=((100.0, 1.0),),
        min_length=1,
        max_length=4,
        description=f"Factor by disc temperature, [[°C, factor], …]: {_POINTS}.",
    )
    speed: tuple[SpeedPoint, ...] = Field(
        default=((15.0, 1.0),),
        min_length=1,
        max_length=4,
        description=f"Factor by sliding speed at the pad, [[m/s, factor], …]: {_POINTS}.",
    )
    clamp_force: tuple[ForcePoint, ...] = Field(
        default=((25e3, 1.0),),
        min_length=1,
        max_length=4,
        description=f"Factor by clamp force per disc, [[N, factor], …]: {_POINTS}.",
    )

    @model_validator(mode="after")
    def _ascending(self) -> PiecewisePad:
        refuse(
            [
                Problem(name, "must ascend", got=f"{[point[0] for point in points]}")
                for name in ("temperature", "speed", "clamp_force")
                for points in [getattr(self, name)]
                if any(a[0] >= b[0] for a, b in pairwise(points))
            ]
        )
        return self


Pad = Annotated[ConstantPad | KarwatzkiPad | PiecewisePad, Field(discriminator="law")]
"""Friction of a pad or block, told apart by ``law``."""

PAD_LAWS = ("constant", "karwatzki_1950", "piecewise")
