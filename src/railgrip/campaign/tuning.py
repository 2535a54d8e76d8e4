"""Find better parameters of a controller: an optimiser asks, the engine answers.

The search is Optuna's: a tree-structured Parzen estimator for one objective, NSGA-II for a
trade-off front. Every trial is written down before the next begins, so a search that was
interrupted goes on where it stopped.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import railgrip
from railgrip.campaign.tuning_judge import Judge, Trial
from railgrip.campaign.tuning_plan import TuningPlan
from railgrip.core.errors import Problem, RailgripError

LOG = "trials.log"
ASKED = "asked.json"


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
