"""The file of a safety case: train, speed steps, what scatters, what may fail."""

from __future__ import annotations

import itertools
import os
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, ValidationError, model_validator

from railgrip import data
from railgrip.campaign.campaign_parts import Correlation
from railgrip.campaign.completing import read_sample
from railgrip.campaign.distribution_kinds import Empirical
from railgrip.campaign.safety.variable import OF_PLANT, Variable
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.io.toml_file import read_toml
from railgrip.scenario import Scenario, Train
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.brake_control import BrakeControlLayer
from railgrip.scenario.explain import problems_of
from railgrip.scenario.files import is_path
from railgrip.scenario.reference import Reference
from railgrip.scenario.units import Acceleration, Dimensionless, Speed


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
    correlation: tuple[Correlation, ...] = Field(
        default=(), max_length=20, description="Which of them go together."
    )
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
        refuse([*problems, *self._needs_of_plant(), *self._impossible_correlations()])
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

    def _impossible_correlations(self) -> list[Problem]:
        """Return what is wrong with the names: variables that go together sit in one place."""
        labels = [row.label for row in self.variables]
        problems, seen = [], set[str]()
        for i, one in enumerate(self.correlation):
            where = f"correlation[{i}].variables"
            unknown = [name for name in one.variables if name not in labels]
            problems += [unknown_name(where, "variable", name, labels) for name in unknown]
            if unknown:
                continue
            twice = [name for name in one.variables if labels.count(name) > 1]
            problems += [
                Problem(where, f"'{name}' means several variables", cure="give each a name")
                for name in twice
            ]
            again = [
                name for name in one.variables if name in seen or one.variables.count(name) > 1
            ]
            problems += [Problem(where, f"'{name}' is correlated twice") for name in again]
            rows = [self.variables[labels.index(name)] for name in one.variables]
            if len({(row.per, row.brakes) for row in rows}) > 1:
                problems.append(Problem(where, "must have the same 'per' and 'brakes'"))
            seen.update(one.variables)
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
        case = SafetyCase.model_validate(table)
    except ValidationError as error:
        raise RailgripError(problems_of(error, SafetyCase)) from None
    folder = Path(path).parent
    rows = []
    for i, row in enumerate(case.variables):
        if row.file:
            named = Empirical(file=row.file, column=row.column)
            values = read_sample(named, folder, f"variables[{i}]").values
            row = row.model_copy(update={"values": values})
        rows.append(row)
    return case.model_copy(update={"variables": tuple(rows)})


def find_case(word: str) -> Path:
    """Return the file that a path or the name of a shipped case means."""
    if is_path(word):
        return Path(word)
    return data.path("safety", word)
