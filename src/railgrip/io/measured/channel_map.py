"""Which column of a measured file is which signal, in which unit."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, ValidationError, model_validator

from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.core.signals import SIGNALS
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.conversion import conversion
from railgrip.scenario.explain import problems_of
from railgrip.scenario.files import parse, printable, read_text
from railgrip.scenario.units import Speed, Time

TRAIN_SIGNALS = tuple(name for name, s in SIGNALS.items() if s.dims == ("time",))
AXLE_SIGNALS = tuple(name for name, s in SIGNALS.items() if s.dims == ("axle", "time"))


class TimeColumn(Model):
    """The column with the time; time = reading × scale + offset, in its unit."""

    column: Text = Field(description="Name in the header of the CSV file.")
    unit: Text = Field(default="s", description="Unit of time, e.g. 's' or 'ms'.")
    scale: float = Field(default=1.0, gt=0, allow_inf_nan=False, description="Factor.")
    offset: float = Field(default=0.0, allow_inf_nan=False, description="Added after scaling.")

    @model_validator(mode="after")
    def _unit_fits(self) -> TimeColumn:
        _check_unit(self.unit, "s", "time")
        return self

    def si(self) -> tuple[float, float]:
        """Factor and offset from reading to SI."""
        return _chain(self.scale, self.offset, self.unit, "s")


class Channel(Model):
    """One column: value = reading × scale + offset, in its unit."""

    column: Text = Field(description="Name in the header of the CSV file.")
    signal: Text = Field(description="Name of the signal catalogue, e.g. 'train_speed'.")
    unit: Text = Field(description="Unit of the values, e.g. 'km/h'; '' for plain numbers.")
    axle: Text = Field(default="", description="Label of the axle, e.g. 'C1-V1-B1-A1'.")
    scale: float = Field(default=1.0, allow_inf_nan=False, description="Factor.")
    offset: float = Field(default=0.0, allow_inf_nan=False, description="Added after scaling.")

    @model_validator(mode="after")
    def _fits(self) -> Channel:
        if self.signal not in (*TRAIN_SIGNALS, *AXLE_SIGNALS):
            known = (*TRAIN_SIGNALS, *AXLE_SIGNALS)
            refuse([unknown_name("signal", "signal", printable(self.signal), known)])
        if self.signal in AXLE_SIGNALS and not self.axle:
            what = f"is missing: '{self.signal}' belongs to one axle"
            refuse([Problem("axle", what, cure='axle = "C1-V1-B1-A1"')])
        if self.signal in TRAIN_SIGNALS and self.axle:
            what = f"does not fit: '{self.signal}' belongs to the whole train"
            refuse([Problem("axle", what, cure="leave it out")])
        if self.scale == 0:
            refuse([Problem("scale", "must not be 0")])
        _check_unit(self.unit, _target(self.signal), self.signal)
        return self

    def si(self) -> tuple[float, float]:
        """Factor and offset from reading to SI."""
        return _chain(self.scale, self.offset, self.unit, _target(self.signal))


class Align(Model):
    """Where measured and simulated stop are laid together: one of the two."""

    brake_command: Time | None = Field(
        default=None, description="Measured time of the brake command."
    )
    speed_crossing: Speed | None = Field(
        default=None, gt=0, description="Speed that both fall through at the same time."
    )

    @model_validator(mode="after")
    def _one(self) -> Align:
        if self.brake_command is not None and self.speed_crossing is not None:
            refuse([Problem("speed_crossing", "contradicts brake_command", cure="give one")])
        return self


class ChannelMap(Model):
    """How a measured CSV file is read."""

    title: Text = Field(default="Measured", description="Name in legends and tables.")
    source: Text = Field(default="", description="Where the measurement comes from.")
    delimiter: Literal[",", ";", "\t", "|", " "] = Field(default=",", description="Between cells.")
    decimal: Literal[".", ","] = Field(default=".", description="Decimal mark.")
    encoding: Literal["utf-8", "latin-1", "cp1252", "utf-16"] = Field(
        default="utf-8", description="Of the text."
    )
    skip_lines: int = Field(default=0, ge=0, le=10000, description="Lines before the header.")
    units_line: bool = Field(default=False, description="Whether units stand under the header.")
    time: TimeColumn = Field(description="The column with the time.")
    channel: tuple[Channel, ...] = Field(min_length=1, max_length=5000, description="The others.")
    align: Align = Field(default=Align(), description="How it is laid over a simulated stop.")

    @model_validator(mode="after")
    def _agrees(self) -> ChannelMap:
        problems = []
        if self.delimiter == self.decimal:
            problems.append(Problem("decimal", "is the delimiter too", cure="delimiter = ';'"))
        seen: dict[tuple[str, str], int] = {}
        for k, channel in enumerate(self.channel):
            first = seen.setdefault((channel.signal, channel.axle), k)
            if first != k:
                what = f"'{channel.signal}' {channel.axle}".rstrip()
                problems.append(Problem(f"channel[{k}]", f"{what} is channel[{first}] already"))
        if ("train_speed", "") not in seen:
            cure = '[[channel]] column = "…", signal = "train_speed", unit = "km/h"'
            problems.append(Problem("channel", "has no 'train_speed'", cure=cure))
        refuse(problems)
        return self


def read_channel_map(source: str | os.PathLike[str] | Mapping[str, Any]) -> ChannelMap:
    """Return the channel map that a TOML file or a table describes.

    Parameters
    ----------
    source : path or mapping
        File, or its content.

    Returns
    -------
    ChannelMap
        Checked.

    Raises
    ------
    RailgripError
        Every problem at once with its key path, e.g.
        ``stop.toml: channel[0].unit: 'bar' is no unit of train_speed; …``

    Examples
    --------
    >>> channels = read_channel_map({
    ...     "time": {"column": "t"},
    ...     "channel": [{"column": "v", "signal": "train_speed", "unit": "km/h"}]})
    >>> round(channels.channel[0].si()[0], 6)
    0.277778
    """
    where = ""
    if isinstance(source, Mapping):
        table = dict(source)
    else:
        path = Path(source)
        where = printable(str(path), 300)
        table = parse(read_text(path), where)
    try:
        return ChannelMap.model_validate(table)
    except ValidationError as error:
        problems = problems_of(error, ChannelMap)
        if where:
            problems = [
                replace(p, where=f"{where}: {p.where}" if p.where else where) for p in problems
            ]
        raise RailgripError(problems) from None


def _target(signal: str) -> str:
    unit = SIGNALS[signal].unit
    return "" if unit == "1" else unit


def _check_unit(unit: str, target: str, signal: str) -> None:
    if conversion(unit, target) is None:
        what = f"'{printable(unit)}' is no unit of {signal}"
        wanted = target or "a plain number ('') or '%'"
        refuse([Problem("unit", what, allowed=f"{wanted} or what converts to it")])


def _chain(scale: float, offset: float, unit: str, target: str) -> tuple[float, float]:
    factor, base = conversion(unit, target) or (1.0, 0.0)
    return scale * factor, offset * factor + base
