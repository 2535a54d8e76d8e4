"""What a campaign's file is made of: variables, correlations, sampling, its end, designs."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, model_validator

from railgrip.campaign.distributions import Distribution
from railgrip.core.errors import Problem
from railgrip.report.metrics import SOURCES
from railgrip.scenario.base import Model, Name, Text, refuse
from railgrip.scenario.run import Parameter

FROM_TRACES = {"adhesion_utilisation"}
"""Figures that need the curves of a run, which a batch does not keep."""
FIGURES = sorted(set(SOURCES) - FROM_TRACES)
"""Figures of a run that a campaign can keep."""
USUAL = (
    "stopping_distance", "stopping_time", "mean_deceleration", "slide_activity", "greatest_slip",
    "locked_time", "flat_length", "disc_temperature",
)  # fmt: skip


class Variable(Model):
    """A quantity of the scenario that varies from run to run."""

    quantity: Text = Field(
        min_length=1, description="Key path in the scenario; [*] and * stand for every entry."
    )
    name: Name | None = Field(
        default=None, description="Name of the column; absent: the path's last key."
    )
    scope: Literal["train", "vehicle", "bogie", "axle"] = Field(
        default="train", description="One draw for all places, or one for each of these."
    )
    apply: Literal["value", "factor", "offset"] = Field(
        default="value", description="The draw itself, or a factor on, or added to, the scenario's."
    )
    distribution: Distribution = Field(description="How it is spread.")

    @property
    def label(self) -> str:
        """Name of its columns."""
        return self.name or self.quantity.rpartition(".")[2].partition("[")[0]


class Correlation(Model):
    """Variables that go together: a Gaussian copula."""

    variables: Annotated[tuple[Text, ...], Field(min_length=2, max_length=200)] = Field(
        description="Names of variables of the same scope."
    )
    matrix: Annotated[tuple[tuple[float, ...], ...], Field(max_length=200)] = Field(
        description="Correlations of their normal scores."
    )

    @model_validator(mode="after")
    def _is_possible(self) -> Correlation:
        n = len(self.variables)
        if len(self.matrix) != n or any(len(row) != n for row in self.matrix):
            refuse([Problem("matrix", "must have a row and a column for each variable", f"{n}")])
        matrix = np.array(self.matrix)
        problems = []
        if not (np.allclose(matrix, matrix.T) and np.allclose(np.diag(matrix), 1.0)):
            problems.append(Problem("matrix", "must be symmetric with ones on its diagonal"))
        elif not np.linalg.eigvalsh(matrix)[0] > 1e-10:
            least = np.linalg.eigvalsh(matrix)[0]
            what = "is not positive definite: no variables can be correlated like this"
            problems.append(Problem("matrix", what, f"least eigenvalue {least:.3g}",
                                    cure="smaller correlations"))  # fmt: skip
        refuse(problems)
        return self


class Sampling(Model):
    """How the random space is filled."""

    method: Literal["random", "sobol", "latin"] = Field(
        default="random", description="Philox; scrambled Sobol points; a Latin hypercube."
    )
    seed: int = Field(default=1, ge=0, lt=2**63, description="Of every draw and random rail.")


class Until(Model):
    """A confidence width that ends the campaign."""

    figure: Text = Field(default="stopping_distance", description="Column that is judged.")
    statistic: Literal["mean", "quantile", "exceedance"] = Field(
        default="mean", description="What of it."
    )
    level: float = Field(default=0.5, gt=0, lt=1, description="Of the quantile.")
    threshold: Parameter = Field(default=0.0, description="That is exceeded, SI or with a unit.")
    width: Parameter = Field(gt=0, description="Half the width of the 95 % interval, SI.")


class Design(Model):
    """One variant in a study: what is different in it."""

    name: Name = Field(description="Name in tables and folders.")
    changes: dict[Text, Any] = Field(default={}, alias="set", description="key = value.")
