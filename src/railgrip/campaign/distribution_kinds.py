"""Distributions that stand alone: bells, ranges, events, lists of values and samples."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.run import Parameter

Values = NDArray[Any]


class Normal(Model):
    """Gauss's bell."""

    kind: Literal["normal"] = "normal"
    mean: Parameter = Field(description="Mean.")
    deviation: Parameter = Field(description="Standard deviation.")

    @model_validator(mode="after")
    def _is_possible(self) -> Normal:
        refuse(not_positive("deviation", self.deviation))
        return self

    def ppf(self, u: Values) -> Values:
        """Return the values below which the shares u of all draws lie."""
        from scipy.special import ndtri

        return np.asarray(self.mean + self.deviation * ndtri(u))

    def cdf(self, x: Values) -> Values:
        """Return the share of all draws below the values x."""
        from scipy.special import ndtr

        return np.asarray(ndtr((np.asarray(x) - self.mean) / self.deviation))


class LogNormal(Model):
    """The exponential of a normal variable: positive, with a long tail upwards."""

    kind: Literal["lognormal"] = "lognormal"
    mean: Parameter = Field(description="Mean of the variable itself.")
    deviation: Parameter = Field(description="Standard deviation of the variable itself.")

    @model_validator(mode="after")
    def _is_possible(self) -> LogNormal:
        problems = not_positive("deviation", self.deviation)
        refuse([*problems, *not_positive("mean", self.mean)])
        return self

    def _logarithm(self) -> tuple[float, float]:
        variance = math.log1p((self.deviation / self.mean) ** 2)
        return math.log(self.mean) - variance / 2, math.sqrt(variance)

    def ppf(self, u: Values) -> Values:
        """Return the values below which the shares u of all draws lie."""
        from scipy.special import ndtri

        middle, spread = self._logarithm()
        return np.asarray(np.exp(middle + spread * ndtri(u)))

    def cdf(self, x: Values) -> Values:
        """Return the share of all draws below the values x."""
        from scipy.special import ndtr

        middle, spread = self._logarithm()
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(x > 0, ndtr((np.log(np.maximum(x, 1e-300)) - middle) / spread), 0.0)


class Uniform(Model):
    """Any value of a range alike."""

    kind: Literal["uniform"] = "uniform"
    low: Parameter = Field(description="Least value.")
    high: Parameter = Field(description="Greatest value.")

    @model_validator(mode="after")
    def _is_possible(self) -> Uniform:
        refuse(not_above(self.low, self.high))
        return self

    def ppf(self, u: Values) -> Values:
        """Return the values below which the shares u of all draws lie."""
        return self.low + (self.high - self.low) * np.asarray(u)

    def cdf(self, x: Values) -> Values:
        """Return the share of all draws below the values x."""
        return np.clip((np.asarray(x) - self.low) / (self.high - self.low), 0.0, 1.0)


class Triangular(Model):
    """A range with a most likely value."""

    kind: Literal["triangular"] = "triangular"
    low: Parameter = Field(description="Least value.")
    mode: Parameter = Field(description="Most likely value.")
    high: Parameter = Field(description="Greatest value.")

    @model_validator(mode="after")
    def _is_possible(self) -> Triangular:
        problems = not_above(self.low, self.high)
        if not problems and not self.low <= self.mode <= self.high:
            allowed = f"{self.low:g} to {self.high:g}"
            problems = [Problem("mode", "lies outside low and high", f"{self.mode:g}", allowed)]
        refuse(problems)
        return self

    def ppf(self, u: Values) -> Values:
        """Return the values below which the shares u of all draws lie."""
        u = np.asarray(u)
        width, rise = self.high - self.low, self.mode - self.low
        below = self.low + np.sqrt(u * width * rise)
        above = self.high - np.sqrt((1.0 - u) * width * (width - rise))
        return np.where(u * width < rise, below, above)

    def cdf(self, x: Values) -> Values:
        """Return the share of all draws below the values x."""
        x = np.clip(x, self.low, self.high)
        width, rise = self.high - self.low, self.mode - self.low
        below = (x - self.low) ** 2 / (width * max(rise, 1e-300))
        above = 1.0 - (self.high - x) ** 2 / (width * max(width - rise, 1e-300))
        return np.where(x < self.mode, below, above)


class Event(Model):
    """True with a probability, else false: a unit failed, a brake isolated, a fault."""

    kind: Literal["event"] = "event"
    probability: Parameter = Field(ge=0, le=1, description="Of true.")

    def ppf(self, u: Values) -> Values:
        """Return the values below which the shares u of all draws lie."""
        return np.asarray(u) > 1.0 - self.probability


class Discrete(Model):
    """One of several values: numbers, names or truth values."""

    kind: Literal["discrete"] = "discrete"
    values: Annotated[tuple[bool | float | Text, ...], Field(min_length=1, max_length=10_000)] = (
        Field(description="In any order.")
    )
    weights: Annotated[tuple[float, ...], Field(max_length=10_000)] = Field(
        default=(), description="How often each comes, relative; absent: all alike."
    )

    @model_validator(mode="after")
    def _is_possible(self) -> Discrete:
        problems = []
        if self.weights and len(self.weights) != len(self.values):
            got = f"{len(self.weights)} for {len(self.values)} values"
            problems.append(Problem("weights", "must be as many as values", got))
        problems += bad_weights(self.weights)
        refuse(problems)
        return self

    def ppf(self, u: Values) -> Values:
        """Return the values below which the shares u of all draws lie."""
        weights = np.array(self.weights or np.ones(len(self.values)))
        edges = np.cumsum(weights / weights.sum())[:-1]
        kinds = {type(value) for value in self.values}
        table = np.array(self.values, dtype=None if len(kinds) == 1 else object)
        return np.asarray(table[np.searchsorted(edges, u, side="left")])


class Empirical(Model):
    """As measured: between the sorted values of a sample, linearly."""

    kind: Literal["empirical"] = "empirical"
    file: Text = Field(default="", description="CSV file with one number a line, or columns.")
    column: Text = Field(default="", description="Name of the column, where there are several.")
    values: Annotated[tuple[Parameter, ...], Field(max_length=100_000)] = Field(
        default=(), description="The sample itself, instead of a file."
    )

    @model_validator(mode="after")
    def _is_possible(self) -> Empirical:
        problems = []
        if bool(self.file) == bool(self.values):
            problems.append(Problem("values", "give either file or values"))
        if len(self.values) == 1:
            problems.append(Problem("values", "a sample needs at least two values"))
        refuse(problems)
        return self

    def ppf(self, u: Values) -> Values:
        """Return the values below which the shares u of all draws lie."""
        ordered = np.sort(np.array(self.values, dtype=float))
        ranks = (np.arange(len(ordered)) + 0.5) / len(ordered)
        return np.asarray(np.interp(u, ranks, ordered))

    def cdf(self, x: Values) -> Values:
        """Return the share of all draws below the values x."""
        ordered = np.sort(np.array(self.values, dtype=float))
        ranks = (np.arange(len(ordered)) + 0.5) / len(ordered)
        return np.asarray(np.interp(x, ordered, ranks, left=0.0, right=1.0))


def not_positive(name: str, value: float) -> list[Problem]:
    """Return the problem of a value that must be more than 0, if it is not."""
    if value > 0.0:
        return []
    return [Problem(name, "must be more than 0", got=f"{value:g}")]


def not_above(low: float, high: float) -> list[Problem]:
    """Return the problem of bounds that hold nothing between them, if they do not."""
    if high > low:
        return []
    return [Problem("high", "must be above low", got=f"{low:g} and {high:g}")]


def bad_weights(weights: tuple[float, ...]) -> list[Problem]:
    """Return the problem of weights that are negative or all 0, if they are given."""
    if not weights or (min(weights) >= 0.0 and 0.0 < sum(weights) < math.inf):
        return []
    return [Problem("weights", "must not be negative, nor all 0")]
