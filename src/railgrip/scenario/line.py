"""The line under the train: gradients, curves and speed limits by position."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.reference import Reference
from railgrip.scenario.units import Area, Gradient, Length, Speed, Time


class GradientPoint(Model):
    """A gradient that holds from here on."""

    at: Length = Field(ge=0, le=1e6, description="Position on the line.")
    value: Gradient = Field(ge=-0.3, le=0.3, description="Positive uphill.")


class Curve(Model):
    """A stretch of constant radius."""

    begin: Length = Field(alias="from", ge=0, le=1e6, description="Position on the line.")
    end: Length = Field(alias="to", ge=0, le=1e6, description="Position on the line.")
    radius: Length = Field(ge=20, le=1e6, description="Left or right alike.")


class SpeedLimit(Model):
    """A permitted speed that holds from here on."""

    at: Length = Field(ge=0, le=1e6, description="Position on the line.")
    value: Speed = Field(gt=0, le=600 / 3.6, description="Permitted speed.")


class Tunnel(Model):
    """A stretch in a tunnel."""

    begin: Length = Field(alias="from", ge=0, le=1e6, description="Position on the line.")
    end: Length = Field(alias="to", ge=0, le=1e6, description="Position on the line.")
    cross_section: Area = Field(gt=0, le=1000, description="Free cross-section of the tube.")


class LineStop(Model):
    """A place where trains stop."""

    at: Length = Field(ge=0, le=1e6, description="Position of the train's front.")
    name: Text = Field(default="", description="Name for people.")
    dwell: Time = Field(default=30.0, ge=0, le=86_400, description="Time at the platform.")


class Line(Model):
    """A line from position 0 to its length."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    length: Length = Field(gt=0, le=1e6, description="Length of the line.")
    gradient: tuple[GradientPoint, ...] = Field(
        default=(), max_length=20_000, description="Ascending by position; level before the first."
    )
    curve: tuple[Curve, ...] = Field(
        default=(), max_length=20_000, description="Ascending by position, not overlapping."
    )
    speed_limit: tuple[SpeedLimit, ...] = Field(
        default=(), max_length=20_000, description="Ascending by position; none before the first."
    )
    tunnel: tuple[Tunnel, ...] = Field(
        default=(), max_length=20_000, description="Ascending by position, not overlapping."
    )
    stop: tuple[LineStop, ...] = Field(
        default=(), max_length=20_000, description="Ascending by position."
    )
    altitude: Length = Field(
        default=0.0, ge=-1000, le=9000, description="Height above the sea at position 0."
    )

    @model_validator(mode="after")
    def _in_order(self) -> Line:
        points = [self._points(name) for name in ("gradient", "speed_limit", "stop")]
        stretches = [self._stretches(name) for name in ("curve", "tunnel")]
        refuse([problem for found in (*points, *stretches) for problem in found])
        return self

    def _points(self, name: str) -> list[Problem]:
        positions = [point.at for point in getattr(self, name)]
        problems = [
            Problem(
                f"{name}[{i + 1}].at",
                "must lie beyond the entry before it",
                got=f"{b:g} m after {a:g} m",
            )
            for i, (a, b) in enumerate(pairwise(positions))
            if b <= a
        ]
        return problems + [
            Problem(
                f"{name}[{i}].at",
                "lies beyond the end of the line",
                got=f"{at:g} m",
                allowed=f"0 to {self.length:g} m",
            )
            for i, at in enumerate(positions)
            if at > self.length
        ]

    def _stretches(self, name: str) -> list[Problem]:
        stretches = getattr(self, name)
        problems = [
            Problem(
                f"{name}[{i}].to",
                "must lie beyond 'from'",
                got=f"from {stretch.begin:g} m to {stretch.end:g} m",
            )
            for i, stretch in enumerate(stretches)
            if stretch.end <= stretch.begin
        ]
        return problems + [
            Problem(
                f"{name}[{i + 1}].from",
                f"must not lie before the end of the {name} before it",
                got=f"{b.begin:g} m before {a.end:g} m",
            )
            for i, (a, b) in enumerate(pairwise(stretches))
            if b.begin < a.end
        ]


LEVEL = Line(title="Level straight line", source="illustrative", length=50_000.0)


class Route(Model):
    """Which line the train runs on, and where it begins."""

    use: Annotated[Line, Reference("line")] = Field(
        default=LEVEL, description="A shipped name, a file or a table."
    )
    start: Length = Field(
        default=0.0, ge=0, le=1e6, description="Position of the train's front when the run begins."
    )

    @model_validator(mode="after")
    def _starts_on_it(self) -> Route:
        if self.start >= self.use.length:
            refuse(
                [
                    Problem(
                        "start",
                        "lies beyond the end of the line",
                        got=f"{self.start:g} m",
                        allowed=f"0 to less than {self.use.length:g} m",
                    )
                ]
            )
        return self
