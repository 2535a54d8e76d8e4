"""One quantity of a safety case that scatters: which, whose, and how."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from railgrip.campaign.safety.marginals import NEEDS, problems_of_numbers
from railgrip.core.errors import Problem, unknown_name
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.quantity import Unit
from railgrip.scenario.units import RATIO

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
NUMBERS = ("mean", "deviation", "low", "mode", "high")


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
    values: Annotated[tuple[float | str, ...], Field(max_length=100_000)] = Field(
        default=(), description="Of empirical: what was measured."
    )
    file: Text = Field(default="", description="Of empirical: a CSV file instead of values.")
    column: Text = Field(default="", description="Its column, where there are several.")
    name: Text = Field(default="", description="For correlations; absent: the quantity.")
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
        problems += [] if faults else self._problems_of_sample()
        refuse(problems)
        return self

    @property
    def label(self) -> str:
        """Name that correlations call it by."""
        return self.name or self.quantity

    @property
    def numbers(self) -> dict[str, float]:
        """The numbers of the distribution, SI."""
        return self._read()[0]

    @property
    def sample(self) -> tuple[float, ...]:
        """What was measured, SI; of an empirical distribution."""
        unit = self._unit()
        return tuple(unit.read(value) for value in self.values)

    def _unit(self) -> Unit:
        return RATIO if self.means == "factor" else QUANTITIES[self.quantity]

    def _problems_of_sample(self) -> list[Problem]:
        if self.distribution != "empirical":
            given = [name for name in ("values", "file", "column") if getattr(self, name)]
            what = f"does not belong to distribution '{self.distribution}'"
            return [Problem(name, what, cure="distribution = 'empirical'") for name in given]
        if bool(self.file) == bool(self.values):
            return [Problem("values", "give either file or values")]
        if self.values and len(set(self.sample)) < 2:
            return [Problem("values", "a sample needs at least two different values")]
        return []

    def _read(self) -> tuple[dict[str, float], list[Problem]]:
        unit = self._unit()
        given: dict[str, float] = {}
        faults = []
        told = [(name, getattr(self, name)) for name in NUMBERS]
        told += [(f"values[{i}]", value) for i, value in enumerate(self.values)]
        for name, text in told:
            if text is None:
                continue
            try:
                is_span = name == "deviation" and unit.si == "degC"
                number = (KELVIN if is_span else unit).read(text)
                if name in NUMBERS:
                    given[name] = number
            except PydanticCustomError as error:
                why = error.context or {}
                faults.append(
                    Problem(name, str(why.get("what")), str(text), str(why.get("allowed", "")))
                )
        return given, faults
