"""Find better parameters of a controller: an optimiser asks, the engine answers.

The search is Optuna's: a tree-structured Parzen estimator for one objective, NSGA-II for a
trade-off front. Every trial is written down before the next begins, so a search that was
interrupted goes on where it stopped.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import railgrip
from railgrip.campaign.tuning_plan import TuningPlan
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.status import ENDED_WELL
from railgrip.engine.controllers import find_controller
from railgrip.engine.simulate import simulate
from railgrip.report.metrics import SOURCES
from railgrip.scenario import Scenario

LOG = "trials.log"
ASKED = "asked.json"
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


class Tuning(NamedTuple):
    """What a search has found.

    Attributes
    ----------
    plan : TuningPlan
        What was asked.
    untuned : Trial
        The controller as it comes.
    trials : list of Trial
        In the order in which they were tried.
    best : list of Trial
        The best one, or the front, sorted by its first metric; the untuned one where none is
        better.
    """

    plan: TuningPlan
    untuned: Trial
    trials: list[Trial]
    best: list[Trial]


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


def tune(
    plan: TuningPlan,
    out: Path,
    *,
    folder: Path = Path(),
    threads: int = 1,
    progress: Callable[[int, int, float], None] | None = None,
) -> Tuning:
    """Search for better parameters; go on with the search that lies in the folder, if there is one.

    Parameters
    ----------
    plan : TuningPlan
        What to tune, where, judged by what.
    out : Path
        Folder of the search; made if it is not there.
    folder : Path
        Where relative file names in the plan begin.
    threads : int
        Threads that share the runs of a trial; the result does not depend on it.
    progress : callable, optional
        Called after each trial with its number, the number of all, and the best score so far.

    Returns
    -------
    Tuning
        All trials and the best.

    Raises
    ------
    RailgripError
        ``out: holds the search of another plan; …``; ``optuna is not installed; try: pip install
        'railgrip[tune]'``; what is wrong with a scenario or a parameter.

    Notes
    -----
    A score is the weighted mean of metric/metric of the untuned controller over all scenarios. A
    passed limit adds `EXCESS` times the share by which it is passed, a run that does not end well
    up to `FAILED`. The same plan, interrupted or not, tries sets from the same ranges; the search
    itself is random, and a resumed one draws other sets than one that was never interrupted.

    References
    ----------
    .. [1] T. Akiba and others, Optuna, KDD 2019, doi:10.1145/3292500.3330701.
    .. [2] K. Deb and others, A fast and elitist multiobjective genetic algorithm: NSGA-II, IEEE
       Trans. Evol. Comp. 6 (2002) 182–197, doi:10.1109/4235.996017.
    """
    optuna = _optuna()
    _claim(out, plan)
    judge = Judge(plan, folder, threads)
    study = _study(optuna, plan, out / LOG)
    ranges = {
        name: optuna.distributions.FloatDistribution(one.low, one.high, log=one.log)
        for name, one in plan.parameters.items()
    }
    done = _finished(optuna, study)
    for number in range(len(done), plan.trials):
        asked = study.ask(ranges)
        trial = judge(dict(asked.params))
        asked.set_user_attr("figures", trial.figures)
        asked.set_user_attr("keeps_limits", trial.keeps_limits)
        study.tell(asked, list(trial.score))
        done.append(trial)
        if progress is not None:
            progress(number + 1, plan.trials, min(one.score[0] for one in done))
    return Tuning(plan, judge.untuned, done, _best(plan, judge.untuned, done))


def _optuna() -> Any:
    try:
        import optuna
    except ImportError:
        cure = "pip install 'railgrip[tune]'"
        raise RailgripError(Problem("", "optuna is not installed", cure=cure)) from None
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    return optuna


def _claim(out: Path, plan: TuningPlan) -> None:
    """Take the folder for this plan, or refuse one that holds the search of another."""
    from railgrip.core.atomic import write_aside

    asked = json.loads(plan.model_dump_json(by_alias=True, exclude={"trials"}))
    note = {"plan": asked, "railgrip_version": railgrip.__version__}
    try:
        out.mkdir(parents=True, exist_ok=True)
        written = (out / ASKED).read_text(encoding="utf-8") if (out / ASKED).exists() else ""
    except OSError as error:
        raise RailgripError(Problem(str(out), "cannot be used", got=error.strerror or "")) from None
    if not written and any(out.iterdir()):
        raise RailgripError(
            Problem(str(out), "is not empty and holds no search", cure="another --out")
        )
    if written and json.loads(written) != note:
        what = "holds the search of another plan or version"
        raise RailgripError(Problem(str(out), what, cure="another --out"))
    if not written:
        with write_aside(out / ASKED) as aside:
            aside.write_text(json.dumps(note, indent=2), encoding="utf-8")


def _study(optuna: Any, plan: TuningPlan, log: Path) -> Any:
    storage = optuna.storages.JournalStorage(
        optuna.storages.journal.JournalFileBackend(str(log))
    )  # fmt: skip
    study = optuna.create_study(
        storage=storage,
        study_name="railgrip",
        load_if_exists=True,
        directions=["minimize"] * max(1, len(plan.front)),
    )
    # a resumed search must not draw again what it has drawn
    seed = plan.seed + len(study.trials)
    samplers = optuna.samplers
    study.sampler = (
        samplers.NSGAIISampler(seed=seed) if plan.front else samplers.TPESampler(seed=seed)
    )
    return study


def _finished(optuna: Any, study: Any) -> list[Trial]:
    """Return the trials of earlier sessions; one that was cut off is marked so and left out."""
    states = optuna.trial.TrialState
    found = []
    for one in study.trials:
        if one.state == states.COMPLETE:
            attributes = one.user_attrs
            found.append(
                Trial(dict(one.params), tuple(one.values), attributes["figures"],
                      attributes["keeps_limits"])
            )  # fmt: skip
        elif one.state == states.RUNNING:
            study.tell(one.number, state=states.FAIL)
    return found


def _best(plan: TuningPlan, untuned: Trial, trials: list[Trial]) -> list[Trial]:
    allowed = [one for one in (untuned, *trials) if one.keeps_limits] or [untuned, *trials]
    if not plan.front:
        return [min(allowed, key=lambda one: one.score[0])]

    def beats(one: Trial, other: Trial) -> bool:
        pairs = list(zip(one.score, other.score, strict=True))
        return all(a <= b for a, b in pairs) and any(a < b for a, b in pairs)

    front = [one for one in allowed if not any(beats(other, one) for other in allowed)]
    return sorted(front, key=lambda one: one.score)
