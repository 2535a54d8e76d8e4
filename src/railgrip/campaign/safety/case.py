"""The file of a safety case: train, speed steps, what scatters, what may fail."""

from __future__ import annotations

import itertools
import os
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, ValidationError, model_validator
from pydantic_core import PydanticCustomError

from railgrip import data
from railgrip.campaign.safety.marginals import NEEDS, problems_of_numbers
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.io.toml_file import read_toml
from railgrip.scenario import Scenario, Train
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.brake_control import BrakeControlLayer
from railgrip.scenario.explain import problems_of
from railgrip.scenario.files import is_path
from railgrip.scenario.quantity import Unit
from railgrip.scenario.reference import Reference
from railgrip.scenario.units import RATIO, Acceleration, Dimensionless, Speed

KELVIN = Unit("K", "K", 1.0, "5 K")
QUANTITIES: dict[str, Unit] = {
    "cylinder_pressure": Unit("Pa", "bar", 1e-5, "3.8 bar"),
    "rigging_efficiency": RATIO,
    "pad_friction": RATIO,
    "fill_time": Unit("s", "s", 1.0, "4 s"),
    "dead_time": Unit("s", "s", 1.0, "0.5 s"),
    "wheel_radius": Unit("m", "m", 1.0, "0.46 m"),
    "mass": Unit("kg", "kg", 1.0, "44 t"),
    "resistance": RATIO,
    "disc_temperature": Unit("degC", "°C", 1.0, "120 degC"),
    "temperature_error": KELVIN,
    "deceleration_scale": RATIO,
    "deceleration_offset": Unit("m/s^2", "m/s²", 1.0, "0.005 m/s^2"),
}
"""What may scatter, and the unit of its values and differences."""
OF_TRAIN = ("mass", "resistance", "deceleration_scale", "deceleration_offset")
"""Quantities that the whole train has once."""
MEANS = {
    "mass": "factor",
    "resistance": "factor",
    "pad_friction": "factor",
    "disc_temperature": "value",
    "temperature_error": "value",
    "deceleration_scale": "factor",
    "deceleration_offset": "value",
}
"""Quantities that have no one value in the train's file, or nothing but one: how they act."""
OF_PLANT = ("disc_temperature", "temperature_error", "deceleration_scale", "deceleration_offset")
"""Quantities that the formula does not know."""

Place = Literal["train", "vehicle", "bogie", "axle"]
Number = float | str | None


class Variable(Model):
    """One quantity that scatters."""

    quantity: Text = Field(description=f"One of: {', '.join(QUANTITIES)}.")
    per: Place = Field(default="axle", description="Who has a value of its own.")
    means: Literal["factor", "difference", "value"] = Field(
        default="factor", description="How the number acts on the train's own."
    )
    distribution: Text = Field(description=f"One of: {', '.join(NEEDS)}.")
    mean: Number = Field(default=None, description="Of normal and lognormal.")
    deviation: Number = Field(default=None, description="Standard deviation.")
    low: Number = Field(default=None, description="Least; cuts a normal distribution off.")
    mode: Number = Field(default=None, description="Most frequent; triangular.")
    high: Number = Field(default=None, description="Greatest; cuts a normal distribution off.")
    brakes: tuple[Text, ...] = Field(default=(), description="Only these; absent: all.")
    source: Text = Field(min_length=1, description="Where the numbers come from.")

    @model_validator(mode="after")
    def _is_possible(self) -> Variable:
        problems = []
        if self.quantity not in QUANTITIES:
            problems.append(unknown_name("quantity", "quantity", self.quantity, QUANTITIES))
        if self.distribution not in NEEDS:
            where = "distribution"
            problems.append(unknown_name(where, "distribution", self.distribution, NEEDS))
        refuse(problems)
        if self.quantity in OF_TRAIN and (self.per != "train" or self.brakes):
            problems.append(Problem("per", f"must be 'train' for {self.quantity}", got=self.per))
        means = MEANS.get(self.quantity, self.means)
        if self.means != means:
            what = f"must be '{means}' for {self.quantity}"
            problems.append(Problem("means", what, got=self.means))
        given, faults = self._read()
        problems += faults or problems_of_numbers(self.distribution, given)
        refuse(problems)
        return self

    @property
    def numbers(self) -> dict[str, float]:
        """The numbers of the distribution, SI."""
        return self._read()[0]

    def _read(self) -> tuple[dict[str, float], list[Problem]]:
        unit = RATIO if self.means == "factor" else QUANTITIES[self.quantity]
        given, faults = {}, []
        for name in ("mean", "deviation", "low", "mode", "high"):
            text = getattr(self, name)
            if text is None:
                continue
            try:
                is_span = name == "deviation" and unit.si == "degC"
                given[name] = (KELVIN if is_span else unit).read(text)
            except PydanticCustomError as error:
                told = error.context or {}
                faults.append(
                    Problem(name, str(told.get("what")), str(text), str(told.get("allowed", "")))
                )
        return given, faults


class Failure(Model):
    """Units that may have failed: the brake of an axle, a bogie or a vehicle gives nothing.

    Where the brake control fails, the brakes work as without it.
    """

    per: Literal["vehicle", "bogie", "axle", "control"] = Field(description="What fails as one.")
    latent: Dimensionless = Field(default=0.0, ge=0, le=1, description="Failed unnoticed before.")
    on_demand: Dimensionless = Field(default=0.0, ge=0, le=1, description="Fails when it is asked.")
    brakes: tuple[Text, ...] = Field(default=(), description="Only these; absent: all.")
    source: Text = Field(min_length=1, description="Where the numbers come from.")

    @property
    def probability(self) -> float:
        """Probability that such a unit is failed in a stop."""
        return 1.0 - (1.0 - self.latent) * (1.0 - self.on_demand)


class Wet(Model):
    """How K_wet is found: stops of the plant on wet rail, with slide protection."""

    condition: Annotated[Text, Field(min_length=1)] = Field(description="Rail condition.")
    controller: Text = Field(default="conventional", description="Slide protection.")
    runs: int = Field(default=64, ge=2, le=1_000_000, description="Stops for each speed step.")


class SafetyCase(Model):
    """What is to be shown: how surely this train brakes."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the case comes from.")
    train: Annotated[Train, Reference("train")] = Field(
        description="A shipped train, a file or a table."
    )
    speed_steps: tuple[Speed, ...] = Field(
        min_length=1, max_length=7, description="Upper speeds of the steps, rising."
    )
    method: Literal["formula", "plant"] = Field(
        default="formula", description="EN 14531 mean values, or the stop stepped in time."
    )
    runs: int = Field(default=20_000, ge=500, le=100_000_000, description="For each speed step.")
    seed: int = Field(default=1, ge=0, lt=2**63, description="Of all random numbers.")
    variables: tuple[Variable, ...] = Field(min_length=1, max_length=50, description="Scatter.")
    failures: tuple[Failure, ...] = Field(default=(), max_length=10, description="Failed units.")
    wet: Wet | None = Field(default=None, description="Absent: K_wet is left out, taken as 1.")
    brake_control: BrakeControlLayer | None = Field(
        default=None, description="Friction estimate, deceleration controller; with and without."
    )
    available_adhesion_weight: Dimensionless = Field(
        default=0.0, ge=0, le=1, description="M_NVAVADH of ETCS."
    )
    greatest_deceleration: Acceleration | None = Field(
        default=None, gt=0, le=5, description="A_NVMAXREDADH of ETCS; absent: no cap."
    )

    @model_validator(mode="after")
    def _fits_together(self) -> SafetyCase:
        problems = []
        steps = self.speed_steps
        if steps[0] <= 0.0 or any(b <= a for a, b in itertools.pairwise(steps)):
            got = ", ".join(f"{step * 3.6:g} km/h" for step in steps)
            problems.append(Problem("speed_steps", "must be above 0 and rise", got=got))
        if steps[-1] > 600 / 3.6:
            problems.append(Problem("speed_steps", "must not pass 600 km/h"))
        named: dict[str, list[tuple[str, ...]]] = {
            "variables": [row.brakes for row in self.variables],
            "failures": [row.brakes for row in self.failures],
        }
        for kind, rows in named.items():
            for i, row in enumerate(rows):
                problems += [
                    unknown_name(f"{kind}[{i}].brakes", "brake", name, self.train.brakes)
                    for name in row
                    if name not in self.train.brakes
                ]
        refuse([*problems, *self._needs_of_plant()])
        return self

    def _needs_of_plant(self) -> list[Problem]:
        """Return what only the plant knows and what only brake control has."""
        problems = []
        cure = "method = 'plant'"
        if self.method == "formula":
            problems += [
                Problem(f"variables[{i}].quantity", "is unknown to the formula",
                        got=row.quantity, cure=cure)
                for i, row in enumerate(self.variables) if row.quantity in OF_PLANT
            ]  # fmt: skip
            if self.brake_control is not None:
                problems.append(Problem("brake_control", "is unknown to the formula", cure=cure))
        if self.brake_control is None:
            problems += [
                Problem(f"failures[{i}].per", "fails a brake control that is not there",
                        got="control", cure="a table brake_control")
                for i, row in enumerate(self.failures) if row.per == "control"
            ]  # fmt: skip
        return problems

    def without_control(self) -> SafetyCase:
        """Return the same case without its brake control."""
        failures = tuple(row for row in self.failures if row.per != "control")
        return self.model_copy(update={"brake_control": None, "failures": failures})

    def scenario(self, speed: float, *, wet: bool = False) -> Scenario:
        """Return the stop from a speed: dry without slide protection, or wet with it."""
        rail, controller = "dry", "none"
        if wet and self.wet is not None:
            rail, controller = self.wet.condition, self.wet.controller
        return Scenario.model_validate(
            {
                "train": self.train,
                "rail": {"condition": rail},
                "run": {"speed": speed, "demand": "emergency"},
                "wsp": {"controller": controller},
                "brake_control": self.brake_control,
            }
        )


def read_safety_case(path: str | os.PathLike[str]) -> SafetyCase:
    """Return the checked case that a TOML file holds.

    Parameters
    ----------
    path : path
        The file; `docs/howto/safety.md` has one to begin with.

    Raises
    ------
    RailgripError
        Every problem at once, with key paths: ``speed_steps: must be above 0 and rise; got …``
    """
    table = read_toml(path)
    try:
        return SafetyCase.model_validate(table)
    except ValidationError as error:
        raise RailgripError(problems_of(error, SafetyCase)) from None


def find_case(word: str) -> Path:
    """Return the file that a path or the name of a shipped case means."""
    if is_path(word):
        return Path(word)
    return data.path("safety", word)
