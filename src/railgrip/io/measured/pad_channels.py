"""Which channel of a measurement is which quantity of a pad, and what shall be found."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError, model_validator

from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.io.measured.channel_map import TimeColumn
from railgrip.laboratory.pad_fit import INFLUENCES, Plan, Shape
from railgrip.laboratory.pad_fit.laws import Lags
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.conversion import conversion
from railgrip.scenario.explain import problems_of
from railgrip.scenario.files import parse, printable, read_text
from railgrip.scenario.units import Dimensionless, Force, Length, Speed, Temperature, Time

QUANTITIES = {
    "pad_friction": "",
    "brake_torque": "N*m",
    "brake_force": "N",
    "clamp_force": "N",
    "rubbing_speed": "m/s",
    "train_speed": "m/s",
    "disc_temperature": "degC",
    "stop": "",
}
"""What a channel may hold, and its SI unit; ``stop`` numbers the stops."""

LAGGING = {"disc_temperature": "temperature", "rubbing_speed": "speed", "train_speed": "speed",
           "clamp_force": "clamp_force"}  # fmt: skip
"""Signals that are influences, and of which."""


class PadChannel(Model):
    """One channel: value = reading × scale + offset, in its unit."""

    column: Text = Field(description="Name of the column or channel.")
    group: Text = Field(default="", description="Its group, in TDMS files.")
    signal: Text = Field(description="What it holds, e.g. 'pad_friction'.")
    unit: Text = Field(default="", description="Unit of the values; '' for plain numbers.")
    scale: float = Field(default=1.0, allow_inf_nan=False, description="Factor.")
    offset: float = Field(default=0.0, allow_inf_nan=False, description="Added after scaling.")
    lag: Time | Literal["fit"] | None = Field(
        default=None,
        description="First-order lag of the sensor; 'fit': to be found. Not given: found for "
        "disc_temperature, 0 for the others.",
    )

    @model_validator(mode="after")
    def _fits(self) -> PadChannel:
        if self.signal not in QUANTITIES:
            refuse([unknown_name("signal", "signal", printable(self.signal), QUANTITIES)])
        if conversion(self.unit, QUANTITIES[self.signal]) is None:
            what = f"'{printable(self.unit)}' is no unit of {self.signal}"
            wanted = QUANTITIES[self.signal] or "a plain number ('') or '%'"
            refuse([Problem("unit", what, allowed=f"{wanted} or what converts to it")])
        if self.lag == "fit" and self.signal not in LAGGING:
            refuse([Problem("lag", "cannot be found for this signal", cure="give a time")])
        return self

    def si(self) -> tuple[float, float]:
        """Factor and offset from reading to SI."""
        factor, base = conversion(self.unit, QUANTITIES[self.signal]) or (1.0, 0.0)
        return self.scale * factor, self.offset * factor + base


class Geometry(Model):
    """Where the pad rubs; needed for torque, force at the tread and speed of the train."""

    friction_radius: Length | None = Field(default=None, gt=0, le=1, description="Of the pad.")
    wheel_diameter: Length | None = Field(default=None, gt=0.2, le=2, description="Of the wheel.")


class Cutting(Model):
    """How stops are found and which samples of them count."""

    rate: float | None = Field(default=None, gt=0, le=1e5, description="Samples a second to keep.")
    low_pass: float | None = Field(default=None, gt=0, le=1e4, description="Filter, Hz.")
    gap: Time = Field(default=2.0, gt=0, le=1e5, description="Longer gaps end a stop.")
    least_force: Force = Field(default=1e3, ge=0, le=500e3, description="Below: not braking.")
    least_speed: Speed = Field(default=1.0, ge=0, le=100, description="Below: not counted.")
    least_samples: int = Field(default=20, ge=2, le=10**6, description="Of a stop that counts.")


class FunctionPlan(Model):
    """Shape of one function."""

    points: int = Field(default=2, ge=2, le=4, description="How many points.")
    ends: Literal["flat", "open"] = Field(default="flat", description="What lies outside them.")
    at: tuple[float, ...] = Field(default=(), max_length=4, description="Places, where known, SI.")

    def shape(self) -> Shape:
        """Return it as the fit knows it."""
        return Shape(self.points, self.ends, self.at)


class ReferencePoint(Model):
    """Where all factors are 1."""

    temperature: Annotated[Temperature, Field(ge=-60, le=1500)] = 100.0
    speed: Annotated[Speed, Field(ge=0, le=170)] = 15.0
    clamp_force: Annotated[Force, Field(ge=0, le=500e3)] = 25e3


class FitPlan(Model):
    """What shall be found."""

    temperature: FunctionPlan | None = FunctionPlan()
    speed: FunctionPlan | None = FunctionPlan()
    clamp_force: FunctionPlan | None = FunctionPlan()
    leave_out: tuple[Literal["temperature", "speed", "clamp_force"], ...] = ()
    reference: ReferencePoint = ReferencePoint()
    method: Literal["together", "one_at_a_time"] = "together"
    nearness: Dimensionless = Field(default=0.15, gt=0, le=1)


class PadChannelMap(Model):
    """How a measurement of a pad is read, and what is found in it."""

    title: Text = Field(default="Measured pad", description="Name of the pad.")
    source: Text = Field(default="", description="Where the measurement comes from.")
    delimiter: Literal[",", ";", "\t", "|"] = Field(default=",", description="Of CSV cells.")
    decimal: Literal[".", ","] = Field(default=".", description="Decimal mark in CSV files.")
    skip_lines: int = Field(default=0, ge=0, le=10000, description="Lines before the header.")
    time: TimeColumn = Field(default=TimeColumn(column="time"), description="The time.")
    channel: tuple[PadChannel, ...] = Field(min_length=1, max_length=20, description="The others.")
    pad: Geometry = Geometry()
    stops: Cutting = Cutting()
    fit: FitPlan = FitPlan()

    @model_validator(mode="after")
    def _agrees(self) -> PadChannelMap:
        problems = []
        has = {channel.signal for channel in self.channel}
        if len(has) < len(self.channel):
            problems.append(Problem("channel", "names a signal twice"))
        if not has & {"pad_friction", "brake_torque", "brake_force"}:
            cure = '[[channel]] column = "…", signal = "pad_friction"'
            problems.append(Problem("channel", "has no friction, torque or brake force", cure=cure))
        if "pad_friction" not in has and "clamp_force" not in has:
            what = "has no 'clamp_force', without which torque or force say nothing of friction"
            problems.append(Problem("channel", what))
        needs = {"brake_torque": "friction_radius", "brake_force": "friction_radius wheel_diameter",
                 "train_speed": "friction_radius wheel_diameter"}  # fmt: skip
        for signal, keys in needs.items():
            for key in keys.split():
                if signal in has and getattr(self.pad, key) is None:
                    problems.append(Problem(f"pad.{key}", f"is needed for {signal}"))
        refuse(problems)
        return self

    def plan(self) -> Plan:
        """Return what shall be found, for the fit."""
        given = dict.fromkeys(INFLUENCES, 0.0)
        fitted, friction = [], 0.0
        for channel in self.channel:
            name = LAGGING.get(channel.signal)
            lag = channel.lag
            if lag is None:
                lag = "fit" if channel.signal == "disc_temperature" else 0.0
            if lag == "fit":
                fitted.append(str(name))
            elif name is not None:
                given[name] = float(lag)
            elif channel.signal != "stop":
                friction = max(friction, float(lag))
        lags = Lags((given["temperature"], given["speed"], given["clamp_force"]), tuple(fitted),
                    friction)  # fmt: skip
        shapes = {
            name: one.shape()
            for name in INFLUENCES
            if (one := getattr(self.fit, name)) is not None and name not in self.fit.leave_out
        }
        reference = self.fit.reference.model_dump()
        return Plan(shapes, reference, lags, self.fit.method, self.fit.nearness)


def read_pad_channels(source: str | os.PathLike[str] | Mapping[str, Any]) -> PadChannelMap:
    """Return the map that a TOML file or a table describes.

    Raises
    ------
    RailgripError
        Every problem at once with its key path, e.g.
        ``channels.toml: channel[0].signal: signal 'pad_fricton' unknown; known: …``

    Examples
    --------
    >>> table = {"channel": [{"column": "mu", "signal": "pad_friction", "unit": "%"}]}
    >>> read_pad_channels(table).channel[0].si()
    (0.01, 0.0)
    """
    where = "" if isinstance(source, Mapping) else printable(str(source), 300)
    table = dict(source) if isinstance(source, Mapping) else parse(read_text(Path(source)), where)
    try:
        return PadChannelMap.model_validate(table)
    except ValidationError as error:
        problems = problems_of(error, PadChannelMap)
        raise RailgripError(
            [replace(p, where=": ".join(x for x in (where, p.where) if x)) for p in problems]
        ) from None
