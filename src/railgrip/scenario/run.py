"""What the driver does, how long and how finely it is computed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Annotated, Any, NamedTuple

from pydantic import BeforeValidator, Field, GetJsonSchemaHandler, model_validator
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.conversion import si_value
from railgrip.scenario.reference import Plugin
from railgrip.scenario.units import RATIO, Angle, Dimensionless, Speed, Temperature, Time

_LEVELS = {"none": 0.0, "service": 1.0, "emergency": 1.0}
_ALLOWED = "'none', 'service', 'emergency' or a number from 0 to 1"


class Point(Model):
    """Something that holds from a time on."""

    at: Time = Field(default=0.0, ge=0, le=1e5, description="Time since the run began.")


class DemandPoint(Point):
    """What the driver asks for from a time on."""

    level: Dimensionless = Field(
        ge=0,
        le=1,
        description="Share of the full service brake; in files also none, service, emergency.",
    )
    emergency: bool = Field(default=False, strict=True, description="Whether it is an emergency.")

    @model_validator(mode="before")
    @classmethod
    def _words(cls, value: Any) -> Any:
        if not isinstance(value, dict) or not isinstance(value.get("level"), str):
            return value
        word = value["level"].strip()
        if word in _LEVELS:
            marked = {"emergency": True} if word == "emergency" else {}
            return {**value, "level": _LEVELS[word], **marked}
        try:
            return {**value, "level": RATIO.read(word)}
        except PydanticCustomError:
            raise _unknown_level(word) from None


def _unknown_level(word: str) -> PydanticCustomError:
    return PydanticCustomError(
        "railgrip",
        "{what}",
        {
            "what": "is no brake demand",
            "got": f"'{word[:60]}'",
            "allowed": _ALLOWED,
        },
    )


class DrivePoint(Point):
    """What the driver asks of the motors from a time on."""

    level: Dimensionless = Field(ge=0, le=1, description="Share of the full tractive effort.")


def _as_points(value: Any) -> Any:
    # 'emergency', 0.5 and a whole list are three ways to say it.
    if isinstance(value, (str, int, float)) and not isinstance(value, bool):
        return ({"at": 0.0, "level": value},)
    return value


class _ShortForm(NamedTuple):
    """Tells editors that a text or a number may stand for the whole."""

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return {"anyOf": [{"type": ["number", "string"]}, handler(schema)]}


Demand = Annotated[
    tuple[DemandPoint, ...],
    Field(min_length=1, max_length=10_000),
    BeforeValidator(_as_points),
    _ShortForm(),
]


Drive = Annotated[
    tuple[DrivePoint, ...], Field(max_length=10_000), BeforeValidator(_as_points), _ShortForm()
]


def _trace_for(data: dict[str, Any]) -> float:
    step = data.get("step", 0.01)
    return float(step * max(1, math.ceil(0.02 / step - 1e-9)))


class Run(Model):
    """One run: from this speed, with this demand, until the train stands."""

    speed: Speed = Field(default=160 / 3.6, ge=0, le=600 / 3.6, description="At the start.")
    demand: Demand = Field(
        default=(DemandPoint(level=1.0, emergency=True),),
        description=f"{_ALLOWED}, or a list of {{at, level}}.",
    )
    drive: Drive = Field(
        default=(),
        description="A share of the full tractive effort, or a list of {at, level}. Brake and "
        "motors may act together: that is how a train starts on a gradient.",
    )
    duration: Time | None = Field(
        default=None,
        gt=0,
        le=7200,
        description="Go on for so long, whatever the train does; absent: until it stands.",
    )
    step: Time = Field(default=0.01, ge=0.001, le=0.02, description="Of the computation.")
    trace: Time = Field(
        default_factory=_trace_for,
        ge=0.001,
        le=60,
        description="Between two points of the traces, a multiple of the step; absent: 20 ms.",
    )
    time_limit: Time = Field(default=300.0, gt=0, le=7200, description="When to give up.")
    after_stop: Time = Field(
        default=0.0, ge=0, le=600, description="How long to go on after the stop."
    )
    ambient: Temperature = Field(
        default=20.0, ge=-60, le=70, description="Of air and of all discs."
    )
    creep_law: Annotated[
        Text,
        Plugin(
            "railgrip.laws",
            "creep law",
            more_groups=("railgrip.rolling_laws", "railgrip.slow_rolling_laws"),
        ),
    ] = Field(
        default="polach_2005",
        description="A contact law by name; one of rolling contact is tabulated before the run.",
    )
    angle_of_attack: Angle = Field(
        default=0.0,
        ge=-0.05,
        le=0.05,
        description="Of every wheelset on the rail, throughout; the creep law is then tabulated.",
    )
    seed: int = Field(default=1, ge=0, lt=2**63, description="Of every random number.")

    @model_validator(mode="after")
    def _fits_together(self) -> Run:
        ticks = self.trace / self.step
        problems = []
        if ticks < 0.5 or abs(ticks - round(ticks)) > 1e-6:
            problems.append(
                Problem(
                    "trace",
                    "must be a multiple of the step",
                    got=f"{self.trace:g} s, step {self.step:g} s",
                )
            )
        problems += [*_not_later("demand", self.demand), *_not_later("drive", self.drive)]
        refuse(problems)
        return self


def _not_later(name: str, points: Sequence[Point]) -> list[Problem]:
    return [
        Problem(
            f"{name}[{i + 1}].at",
            "must be later than the entry before it",
            got=f"{b.at:g} s after {a.at:g} s",
        )
        for i, (a, b) in enumerate(pairwise(points))
        if b.at <= a.at
    ]


def _as_number(value: Any) -> Any:
    # Only the controller knows the dimension of its parameters: any unit is taken to SI.
    if isinstance(value, bool):
        return float(value)
    if isinstance(value, str):
        number = si_value(value)
        if number is None or not math.isfinite(number):
            raise PydanticCustomError(
                "railgrip",
                "{what}",
                {
                    "what": "is no number with a unit",
                    "allowed": "e.g. 0.2, '20 %', '5 km/h'",
                },
            )
        return number
    return RATIO.read(value)


Parameter = Annotated[float, BeforeValidator(_as_number), _ShortForm()]
