"""What a tuner is asked: which parameters, on which scenarios, judged by what."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, ValidationError, model_validator

from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.io.toml_file import load, read_toml
from railgrip.report.metrics import SOURCES
from railgrip.scenario import Scenario
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.explain import problems_of
from railgrip.scenario.run import Parameter

FROM_TRACES = {"adhesion_utilisation"}
"""Metrics that need the curves of a run, which a batch does not keep."""
JUDGES = sorted(set(SOURCES) - FROM_TRACES)
"""Metrics that can judge a batch of runs."""


class Range(Model):
    """Where the tuner may look for one parameter."""

    low: Parameter = Field(description="Least value.")
    high: Parameter = Field(description="Greatest value.")
    log: bool = Field(default=False, strict=True, description="Search in powers of ten.")

    @model_validator(mode="after")
    def _is_a_range(self) -> Range:
        problems = []
        if self.high <= self.low:
            problems.append(
                Problem("high", "must be above low", got=f"{self.low:g} and {self.high:g}")
            )
        if self.log and self.low <= 0.0:
            problems.append(Problem("low", "must be above 0 with log", got=f"{self.low:g}"))
        refuse(problems)
        return self


class TuningScenario(Model):
    """One situation in which the controller is judged."""

    use: Text = Field(min_length=1, description="A shipped scenario or a file.")
    runs: int = Field(default=1, ge=1, le=100_000, description="How many, each on its own rail.")
    weight: float = Field(default=1.0, gt=0, le=1e6, description="In the mean over all scenarios.")
    changes: dict[Text, Any] = Field(default={}, alias="set", description="key = value.")


class TuningPlan(Model):
    """A question to the tuner, as its file asks it."""

    title: Text = Field(default="", description="Name for people.")
    controller: Text = Field(
        default="conventional", description="A registered controller or a file."
    )
    fixed: dict[Text, Parameter] = Field(default={}, description="Parameters that stay.")
    parameters: dict[Text, Range] = Field(min_length=1, max_length=50, description="To be tuned.")
    scenario: Annotated[tuple[TuningScenario, ...], Field(min_length=1, max_length=1000)] = Field(
        description="Where it is judged."
    )
    objective: dict[Text, float] = Field(
        default={},
        description="Metric → weight; each counts relative to the untuned controller. A negative "
        "weight asks for more of it.",
    )
    front: Annotated[tuple[Text, ...], Field(max_length=3)] = Field(
        default=(), description="Two or three metrics to trade off, instead of one objective."
    )
    limit: dict[Text, Parameter] = Field(
        default={}, description="Metric → greatest value in any scenario, SI or with units."
    )
    trials: int = Field(default=100, ge=1, le=100_000, description="How many sets are tried.")
    seed: int = Field(default=1, ge=0, lt=2**32, description="Of the search.")

    @model_validator(mode="after")
    def _can_be_judged(self) -> TuningPlan:
        names = [*(("objective", n) for n in self.objective), *(("front", n) for n in self.front),
                 *(("limit", n) for n in self.limit)]  # fmt: skip
        problems = [unknown_name(where, "metric", n, JUDGES) for where, n in names
                    if n not in JUDGES]  # fmt: skip
        if bool(self.objective) == bool(self.front):
            problems.append(Problem("objective", "give either objective or front"))
        if len(self.front) == 1:
            problems.append(Problem("front", "needs two or three metrics", got=self.front[0]))
        if self.objective and not any(self.objective.values()):
            problems.append(Problem("objective", "all weights are zero"))
        refuse(problems)
        return self

    def scenarios(self, folder: Path) -> list[Scenario]:
        """Return the situations, each under the controller as far as it is fixed.

        Parameters
        ----------
        folder : Path
            Where relative file names begin.
        """
        controller = self.controller
        if controller.endswith(".py"):
            controller = str((folder / controller).resolve())
        wsp = {"controller": controller, "parameters": dict(self.fixed)}
        found = []
        for one in self.scenario:
            place = folder / one.use
            source = str(place) if place.is_file() else one.use
            found.append(load(source).with_({**one.changes, "wsp": wsp}))
        return found


def read_tuning_plan(path: str | os.PathLike[str]) -> TuningPlan:
    """Return the checked plan that a TOML file holds.

    Parameters
    ----------
    path : path
        The file; `docs/howto/tune.md` has one to begin with.

    Raises
    ------
    RailgripError
        Every problem at once, with key paths: ``objective: metric 'stoping_distance' unknown; …``
    """
    table = read_toml(path)
    try:
        return TuningPlan.model_validate(table)
    except ValidationError as error:
        raise RailgripError(problems_of(error, TuningPlan)) from None
