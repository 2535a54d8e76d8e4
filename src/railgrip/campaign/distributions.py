"""Distributions of random variables, each given by its inverse: ``ppf(u)`` for u in (0, 1).

One uniform number makes one value, whatever the distribution: so random numbers, Sobol points and
a Latin hypercube serve alike, a copula can bind variables of any kind, and two designs can be
compared on the same draws.
"""

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
BISECTIONS = 60
"""Halvings in the inversion of a mixture: its bracket shrinks to the last bit."""


class Normal(Model):
    """Gauss's bell."""

    kind: Literal["normal"] = "normal"
    mean: Parameter = Field(description="Mean.")
    deviation: Parameter = Field(description="Standard deviation.")

    @model_validator(mode="after")
    def _is_possible(self) -> Normal:
        refuse(_not_positive("deviation", self.deviation))
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
        problems = _not_positive("deviation", self.deviation)
        refuse([*problems, *_not_positive("mean", self.mean)])
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
        refuse(_not_above(self.low, self.high))
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
        problems = _not_above(self.low, self.high)
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
        problems += _bad_weights(self.weights)
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


Continuous = Annotated[
    Normal | LogNormal | Uniform | Triangular | Empirical, Field(discriminator="kind")
]


class Truncated(Model):
    """Another distribution, as far as it lies between bounds."""

    kind: Literal["truncated"] = "truncated"
    of: Continuous = Field(description="The distribution that is cut.")
    low: Parameter = Field(default=-1e300, description="Least value; absent: not cut.")
    high: Parameter = Field(default=1e300, description="Greatest value; absent: not cut.")

    @model_validator(mode="after")
    def _is_possible(self) -> Truncated:
        problems = _not_above(self.low, self.high)
        if not problems and not self.of.cdf(np.array(self.high)) > self.of.cdf(np.array(self.low)):
            got = f"{self.low:g} to {self.high:g}"
            problems = [Problem("low", "nothing of the distribution lies between the bounds", got)]
        refuse(problems)
        return self

    def ppf(self, u: Values) -> Values:
        """Return the values below which the shares u of all draws lie."""
        low, high = self.of.cdf(np.array(self.low)), self.of.cdf(np.array(self.high))
        value = self.of.ppf(np.clip(low + (high - low) * np.asarray(u), 1e-300, 1.0 - 1e-16))
        return np.asarray(np.clip(value, self.low, self.high))

    def cdf(self, x: Values) -> Values:
        """Return the share of all draws below the values x."""
        low, high = self.of.cdf(np.array(self.low)), self.of.cdf(np.array(self.high))
        return np.asarray(np.clip((self.of.cdf(x) - low) / (high - low), 0.0, 1.0))


class Part(Model):
    """One of the distributions that are mixed."""

    weight: float = Field(gt=0, le=1e9, description="How often it comes, relative.")
    of: Annotated[
        Normal | LogNormal | Uniform | Triangular | Empirical | Truncated,
        Field(discriminator="kind"),
    ] = Field(description="The distribution.")


class Mixture(Model):
    """Now from one distribution, now from another: dry rail, wet rail, leaves."""

    kind: Literal["mixture"] = "mixture"
    parts: Annotated[tuple[Part, ...], Field(min_length=2, max_length=100)] = Field(
        description="What is mixed."
    )

    def cdf(self, x: Values) -> Values:
        """Return the share of all draws below the values x."""
        whole = sum(part.weight for part in self.parts)
        return np.asarray(sum(part.weight / whole * part.of.cdf(x) for part in self.parts))

    def ppf(self, u: Values) -> Values:
        """Return the values below which the shares u of all draws lie, by bisection."""
        bounds = np.array([part.of.ppf(np.asarray(u)) for part in self.parts])
        low, high = bounds.min(axis=0), bounds.max(axis=0)
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            is_below = self.cdf(middle) < u
            low, high = np.where(is_below, middle, low), np.where(is_below, high, middle)
        return np.asarray(high)


Distribution = Annotated[
    Normal | LogNormal | Uniform | Triangular | Truncated | Event | Discrete | Empirical | Mixture,
    Field(discriminator="kind"),
]
"""How a random variable is spread, told apart by ``kind``."""


def _not_positive(name: str, value: float) -> list[Problem]:
    if value > 0.0:
        return []
    return [Problem(name, "must be more than 0", got=f"{value:g}")]


def _not_above(low: float, high: float) -> list[Problem]:
    if high > low:
        return []
    return [Problem("high", "must be above low", got=f"{low:g} and {high:g}")]


def _bad_weights(weights: tuple[float, ...]) -> list[Problem]:
    if not weights or (min(weights) >= 0.0 and 0.0 < sum(weights) < math.inf):
        return []
    return [Problem("weights", "must not be negative, nor all 0")]
