"""Distributions of random variables, each given by its inverse: ``ppf(u)`` for u in (0, 1).

One uniform number makes one value, whatever the distribution: so random numbers, Sobol points and
a Latin hypercube serve alike, a copula can bind variables of any kind, and two designs can be
compared on the same draws. Here are those made of others; those that stand alone are in
`distribution_kinds`.
"""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from railgrip.campaign.distribution_kinds import (
    Discrete,
    Empirical,
    Event,
    LogNormal,
    Normal,
    Triangular,
    Uniform,
    Values,
    not_above,
)
from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, refuse
from railgrip.scenario.run import Parameter

BISECTIONS = 60
"""Halvings in the inversion of a mixture: its bracket shrinks to the last bit."""

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
        problems = not_above(self.low, self.high)
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
