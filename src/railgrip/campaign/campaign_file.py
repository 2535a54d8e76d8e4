"""What a campaign is: a scenario, what varies in it, how it is sampled, when it ends."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, ValidationError, field_validator, model_validator

from railgrip import data
from railgrip.campaign.distribution_kinds import Empirical
from railgrip.campaign.distributions import Distribution
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.io.toml_file import load, read_toml
from railgrip.report.metrics import SOURCES
from railgrip.scenario import Scenario
from railgrip.scenario.base import Model, Name, Text, refuse
from railgrip.scenario.explain import problems_of
from railgrip.scenario.files import is_path, read_text
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


class CampaignFile(Model):
    """A campaign as its file describes it; complete after `resolved`."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the distributions come from.")
    scenario: Any = Field(description="A shipped scenario, a file or a table.")
    changes: dict[Text, Any] = Field(default={}, alias="set", description="key = value.")
    variable: Annotated[tuple[Variable, ...], Field(max_length=500)] = Field(
        default=(), description="What varies."
    )
    correlation: Annotated[tuple[Correlation, ...], Field(max_length=100)] = Field(
        default=(), description="What goes together."
    )
    sampling: Sampling = Field(default=Sampling(), description="How runs are drawn.")
    runs: int = Field(default=1000, ge=1, le=10**10, description="At most so many.")
    until: Until | None = Field(default=None, description="End earlier, when this is known.")
    chunk: int = Field(
        default=4096, ge=16, le=65536, description="Runs in one part of the results."
    )
    keep: Annotated[tuple[Text, ...], Field(min_length=1, max_length=100)] = Field(
        default=USUAL, description="Figures of each run that are kept."
    )
    collector: Text = Field(
        default="", description="Own figures: a registered collector, or file.py:function."
    )
    design: Annotated[tuple[Design, ...], Field(max_length=1000)] = Field(
        default=(), description="Variants, all drawn alike; absent: the scenario alone."
    )
    condition: Annotated[tuple[Design, ...], Field(max_length=1000)] = Field(
        default=(), description="Conditions in which every design is tried."
    )

    @field_validator("keep")
    @classmethod
    def _are_known(cls, keep: tuple[str, ...]) -> tuple[str, ...]:
        refuse([unknown_name("", "figure", n, FIGURES) for n in keep if n not in FIGURES])
        return keep

    @model_validator(mode="after")
    def _fits_together(self) -> CampaignFile:
        labels = [variable.label for variable in self.variable]
        problems = [
            Problem(f"variable[{i}].name", f"'{label}' is the name of another variable too")
            for i, label in enumerate(labels)
            if label in labels[:i] or label in (*FIGURES, "run", "status")
        ]
        for i, correlation in enumerate(self.correlation):
            problems += self._correlated(f"correlation[{i}].variables", correlation)
        for kind, entries in (("design", self.design), ("condition", self.condition)):
            names = [entry.name for entry in entries]
            problems += [
                Problem(f"{kind}[{i}].name", f"'{name}' stands there twice")
                for i, name in enumerate(names)
                if name in names[:i]
            ]
        refuse(problems)
        return self

    def _correlated(self, where: str, correlation: Correlation) -> list[Problem]:
        known = {variable.label: variable for variable in self.variable}
        missing = [name for name in correlation.variables if name not in known]
        if missing:
            return [unknown_name(where, "variable", name, known) for name in missing]
        if len({known[name].scope for name in correlation.variables}) > 1:
            return [Problem(where, "variables of one correlation must have the same scope")]
        earlier = [name for other in self.correlation[: self.correlation.index(correlation)]
                   for name in other.variables]  # fmt: skip
        return [
            Problem(where, f"'{name}' is correlated twice; join the matrices")
            for name in correlation.variables
            if name in earlier
        ]

    def base(self) -> Scenario:
        """Return the scenario that the campaign varies."""
        scenario = load(self.scenario)
        seeded = {"run.seed": self.sampling.seed, **self.changes}
        return scenario.with_(seeded)


def read_campaign_file(source: str | os.PathLike[str]) -> CampaignFile:
    """Return the checked campaign of a TOML file or a shipped name, complete in itself.

    Raises
    ------
    RailgripError
        Every problem at once, with key paths: ``variable[0].distribution.deviation: must be more
        than 0; got -2``.

    Examples
    --------
    >>> read_campaign_file("dry_emergency").runs
    20000
    """
    word = os.fspath(source)
    path = Path(word)
    if not is_path(word) and not path.exists():
        path = data.path("campaigns", word)
    table = read_toml(path)
    return campaign_from(table, path.parent)


def campaign_from(table: dict[str, Any], folder: Path) -> CampaignFile:
    """Return the checked campaign of a table whose file names begin in a folder."""
    try:
        found = CampaignFile.model_validate(table)
    except ValidationError as error:
        raise RailgripError(problems_of(error, CampaignFile)) from None
    return _resolved(found, folder)


def _resolved(campaign: CampaignFile, folder: Path) -> CampaignFile:
    """Return the campaign with scenario, samples and the collector's place written out."""
    word = campaign.scenario
    if isinstance(word, str) and is_path(word):
        word = folder / word
    if not isinstance(word, (str, Path, dict)):
        raise RailgripError(Problem("scenario", "must be a name, a file or a table"))
    scenario = load(word).model_dump(mode="json", by_alias=True, exclude_unset=True)
    variables = []
    for i, variable in enumerate(campaign.variable):
        where = f"variable[{i}].distribution"
        if isinstance(variable.distribution, Empirical) and variable.distribution.file:
            read = read_sample(variable.distribution, folder, where)
            variable = variable.model_copy(update={"distribution": read})
        variables.append(variable)
    collector = campaign.collector
    file, colon, function = collector.rpartition(":")
    if colon and file.endswith(".py"):
        collector = f"{os.path.abspath(folder / file)}:{function}"
    changes = {"scenario": scenario, "variable": tuple(variables), "collector": collector}
    return campaign.model_copy(update=changes)


def read_sample(distribution: Empirical, folder: Path, where: str) -> Empirical:
    """Return the distribution with the values of its file, whose name begins in a folder."""
    lines = [line for line in read_text(folder / distribution.file).splitlines() if line.strip()]
    rows = [[cell.strip() for cell in line.split(",")] for line in lines if line[:1] != "#"]
    column = 0
    if distribution.column:
        if not rows or distribution.column not in rows[0]:
            heads = rows[0] if rows else []
            problem = unknown_name(f"{where}.column", "column", distribution.column, heads)
            raise RailgripError(problem)
        column, rows = rows[0].index(distribution.column), rows[1:]
    try:
        values = tuple(float(row[column]) for row in rows)
        return Empirical(values=values)
    except (ValueError, IndexError, ValidationError):
        what = f"'{distribution.file}' does not hold two or more numbers, one a line"
        raise RailgripError(Problem(f"{where}.file", what)) from None
