"""A set of parameters judged: scenarios run with it, metrics against those untuned."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from railgrip.campaign.tuning_plan import TuningPlan
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.status import ENDED_WELL
from railgrip.engine.controllers import find_controller
from railgrip.engine.simulate import simulate
from railgrip.report.metrics import SOURCES
from railgrip.scenario import Scenario

FAILED = 1e3
"""Score of a set with which a train does not do what was asked."""
EXCESS = 10.0
"""How hard a passed limit weighs: score added for passing it by its own size."""
Figures = dict[str, float]


class Trial(NamedTuple):
    """One set of parameters and what became of it.

    Attributes
    ----------
    parameters : dict of float
        The tuned ones, SI.
    score : tuple of float
        One number, or one for each metric of the front; 1 is as good as untuned, less is better.
    figures : list of dict
        For each scenario the mean of every metric that was asked for, SI.
    keeps_limits : bool
        Whether every run ended well and within the limits.
    """

    parameters: dict[str, float]
    score: tuple[float, ...]
    figures: list[Figures]
    keeps_limits: bool


class Judge:
    """Runs the scenarios with a set of parameters and turns what happened into a score."""

    def __init__(self, plan: TuningPlan, folder: Path, threads: int) -> None:
        self.plan, self.threads = plan, threads
        self.scenarios = plan.scenarios(folder)
        self.metrics = [*plan.objective, *plan.front, *plan.limit]
        _refuse_unknown_parameters(plan, self.scenarios[0])
        untuned = [self._figures(scenario, one.runs) for scenario, one in self._situations()]
        self._base = [figures for figures, _ in untuned]
        self.untuned = self._trial({}, untuned)

    def _situations(self) -> list[tuple[Scenario, Any]]:
        return list(zip(self.scenarios, self.plan.scenario, strict=True))

    def __call__(self, parameters: dict[str, float]) -> Trial:
        """Return what becomes of a set of parameters; one the controller refuses has failed."""
        found = []
        for scenario, one in self._situations():
            given = {**scenario.wsp.parameters, **parameters}
            try:
                changed = scenario.with_({"wsp.parameters": given})
                found.append(self._figures(changed, one.runs))
            except RailgripError:
                found.append((dict.fromkeys(self.metrics, math.nan), 0.0))
        return self._trial(parameters, found)

    def _figures(self, scenario: Scenario, runs: int) -> tuple[Figures, float]:
        """Return the mean of each metric over the runs, and the share of runs that ended well."""
        result = simulate(scenario, runs=runs, traces=False, threads=self.threads)
        data = result.data
        well = float(np.isin(data["status"].values, ENDED_WELL).mean())
        figures = {}
        for name in self.metrics:
            source = SOURCES[name]
            values = data[source.variable].values if source.variable in data else np.full(1, np.nan)
            if source.over_axles:
                values = getattr(np, {"greatest": "nanmax", "sum": "nansum"}[source.over_axles])(
                    values, axis=1
                )
            is_limit = name in self.plan.limit and name not in self.plan.objective
            figures[name] = float(values.max() if is_limit else values.mean())
        return figures, well

    def _trial(self, parameters: dict[str, float], found: list[tuple[Figures, float]]) -> Trial:
        penalty = sum(self._penalty(figures, well) for figures, well in found)
        figures = [one for one, _ in found]
        weights = [one.weight for one in self.plan.scenario]

        def mean(name: str) -> float:
            shares = [_relative(f[name], b[name]) for f, b in zip(figures, self._base, strict=True)]
            return float(np.average(shares, weights=weights))

        if self.plan.front:
            score = tuple(mean(name) + penalty for name in self.plan.front)
        else:
            total = sum(abs(weight) for weight in self.plan.objective.values())
            objective = sum(weight * mean(name) for name, weight in self.plan.objective.items())
            score = (objective / total + penalty,)
        score = tuple(one if math.isfinite(one) else FAILED for one in score)
        return Trial(parameters, score, figures, penalty == 0.0)

    def _penalty(self, figures: Figures, well: float) -> float:
        penalty = FAILED * (1.0 - well)
        for name, limit in self.plan.limit.items():
            over = figures[name] - limit
            if not over <= 0.0:
                penalty += EXCESS * (over / max(abs(limit), 1e-9)) if over == over else FAILED
        return penalty


def _relative(value: float, base: float) -> float:
    return value / base if base else 1.0 + value


def _refuse_unknown_parameters(plan: TuningPlan, scenario: Scenario) -> None:
    """Let the controller say which parameters it does not know."""
    middle = {name: 0.5 * (one.low + one.high) for name, one in plan.parameters.items()}
    given = {**dict(plan.fixed), **middle}
    both = [name for name in plan.parameters if name in plan.fixed]
    if both:
        raise RailgripError(Problem(f"parameters.{both[0]}", "is fixed and to be tuned"))
    try:
        find_controller(
            scenario.wsp.model_copy(update={"parameters": given}), scenario.run.step
        )  # fmt: skip
    except RailgripError as error:
        unknown = [problem for problem in error.problems if "unknown" in problem.what]
        if unknown:
            raise RailgripError(unknown) from None
