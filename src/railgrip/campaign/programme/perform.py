"""Run a programme: repetitions until enough of them are valid, and what each was judged by."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from railgrip.campaign.programme import situation
from railgrip.campaign.programme.bounds import in_words, read_bounds
from railgrip.campaign.programme.measures import Measured
from railgrip.campaign.programme.metrics import all_metrics
from railgrip.campaign.programme.profile import Limit, Profile, ProgrammeTest
from railgrip.campaign.programme.records import Bounds, LimitRecord, RunRecord, TestRecord
from railgrip.campaign.programme.verdict import MISSED, hold, run_margin
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.status import ENDED_WELL, RunStatus, sentence
from railgrip.engine.controllers import find_controller
from railgrip.engine.result import Result
from railgrip.engine.simulate import simulate
from railgrip.report.protocol.curves import curves_of
from railgrip.report.view import View
from railgrip.scenario import Scenario

Progress = Callable[[str, int, int], None]
"""Called with the test's name, valid runs so far, valid runs wanted."""
MOST_AT_ONCE = 10
"""Runs of a test whose full curves are held at once: memory hardly grows with their number."""
ENDED = "ended_well"
"""Metric that every run must keep, whatever the profile says."""


class Programme:
    """A profile, a train and a controller, ready to run.

    Parameters
    ----------
    profile : Profile
        The tests.
    folder : Path
        Where the profile's file names begin.
    train : str
        A shipped train or a file.
    controller : str
        A registered controller or a file.
    threads : int
        Threads that share the runs; no figure depends on it.

    Raises
    ------
    RailgripError
        Every limit without unit, every unknown metric, at once and before the first run.
    """

    def __init__(
        self, profile: Profile, folder: Path, train: Any, controller: str, threads: int = 1
    ) -> None:
        self.profile, self.threads = profile, threads
        self.train, self.controller_name = train, controller
        self.metrics = all_metrics(profile.metric, folder)
        self.base = {"train": train, "wsp": {"controller": controller}}
        first = Scenario.model_validate(self.base)
        by_wire = any(brake.fill == "lag" for brake in first.train.brakes.values())
        if first.train.dump_valve is None and not by_wire:
            raise RailgripError(
                Problem("train", "has no wheel-slide protection to qualify: no dump valves",
                        cure="a train with [dump_valve], e.g. 'emu_four_car'")
            )  # fmt: skip
        self.controller = find_controller(first.wsp, first.run.step)
        self._bounds = read_bounds(profile, self.metrics)

    def perform(
        self, names: tuple[str, ...] = (), progress: Progress | None = None
    ) -> Iterator[TestRecord]:
        """Run the tests one after another; a test that cannot be run says why, the next goes on.

        Parameters
        ----------
        names : tuple of str
            Only these, and what they are compared with.
        progress : callable, optional
            See `Progress`.
        """
        references: dict[str, float] = {}
        for name, test in self.profile.chosen(names).items():
            reference = references.get(test.against, math.nan) if test.against else math.nan
            record = TestRecord(name, test)
            try:
                self._perform(record, reference, progress)
            except RailgripError as error:
                record.problem = "; ".join(str(problem) for problem in error.problems)
            distances = [run.figures["corrected_distance"] for run in record.valid]
            mean = float(np.mean(distances)) if distances else math.nan
            references[name] = mean if math.isfinite(mean) else math.nan
            yield record

    def _perform(self, record: TestRecord, reference: float, progress: Progress | None) -> None:
        name, test, profile = record.name, record.test, self.profile
        wanted = test.repetitions or profile.repetitions
        tries = max(profile.tries, wanted)
        record.scenario = situation.scenario_of(
            profile, name, self.base, situation.seed_of(profile, name, 0)
        )
        lacking = situation.applies(test, record.scenario)
        if lacking:
            record.problem = f"does not apply: the train has no {lacking}".replace("_", " ")
            return
        batch = 0
        while len(record.valid) < wanted and len(record.runs) < tries:
            missing = min(wanted - len(record.valid), tries - len(record.runs), MOST_AT_ONCE)
            self._batch(record, batch, missing, reference)
            batch += 1
            if progress is not None:
                progress(name, len(record.valid), wanted)
        if len(record.valid) < wanted:
            record.problem = self._never_valid(record, wanted)
        record.limits = [
            LimitRecord(self.metrics[key], self._bounds[name, "limit", key], limit,
                        hold(record.figures(key), *self._bounds[name, "limit", key], limit.judged))
            for key, limit in test.limit.items()
        ]  # fmt: skip
        ended = hold(record.figures(ENDED), 1.0, None)
        if ended.verdict == MISSED:  # a train that never stops has no distance to be judged by
            limit = Limit(least=1, source="every run must end as asked")
            record.limits.insert(
                0, LimitRecord(self.metrics[ENDED], Bounds(1.0, None), limit, ended)
            )

    def _batch(self, record: TestRecord, batch: int, runs: int, reference: float) -> None:
        scenario, result = self.batch(record.name, batch, runs)
        for index in range(runs):
            measured = Measured(
                View(result.data, index), scenario, reference, self.profile.cost_per_flat,
                self.profile.flat_from,
            )  # fmt: skip
            record.runs.append(self._record(record, measured, index))

    def batch(self, name: str, batch: int, runs: int) -> tuple[Scenario, Result]:
        """Return the scenario and the result of a batch of repetitions, with curves."""
        seed = situation.seed_of(self.profile, name, batch)
        test = self.profile.test[name]
        scenario = situation.scenario_of(self.profile, name, self.base, seed)
        varied = situation.variations(scenario, self.profile.tolerance, test, runs, self.controller)
        result = simulate(
            scenario, runs=runs, variations=varied, traces=True, threads=self.threads,
            controller=self.controller,
        )  # fmt: skip
        return scenario, result

    def _record(self, record: TestRecord, measured: Measured, index: int) -> RunRecord:
        test, name = record.test, record.name
        wanted = dict.fromkeys(
            [
                *test.valid,
                *test.limit,
                *test.report,
                "corrected_distance",
                "stopping_distance",
                ENDED,
            ]
        )
        figures = {key: self.metrics[key].of(measured) for key in wanted}
        margins = [
            run_margin(figures[key], *self._bounds[name, "limit", key])
            for key, limit in test.limit.items()
            if limit.judged == "each"
        ]
        if not figures[ENDED]:
            margins.append(-1.0)
        status = RunStatus(int(measured.view.number("status")))
        return RunRecord(
            number=len(record.runs) + 1,
            seed=measured.scenario.run.seed,
            index=index,
            status=sentence(status),
            invalid=self._invalid(name, test, figures),
            figures=figures,
            margin=float(np.nanmin(margins)) if not np.isnan(margins).all() else math.nan,
            curves=curves_of(measured.view, ended_well=status in ENDED_WELL),
        )

    def _invalid(self, name: str, test: ProgrammeTest, figures: dict[str, float]) -> str:
        reasons = []
        for key in test.valid:
            bounds = self._bounds[name, "valid", key]
            if not run_margin(figures[key], *bounds) >= 0.0:
                judge = self.metrics[key]
                reasons.append(f"{judge.label}: {judge.unit.show(figures[key])}")
        return "; ".join(reasons)

    def _never_valid(self, record: TestRecord, wanted: int) -> str:
        windows = ", ".join(
            f"{self.metrics[key].label.lower()} {in_words(self.metrics[key], bounds)}"
            for key in record.test.valid
            for bounds in [self._bounds[record.name, "valid", key]]
        )
        reasons = [run.invalid for run in record.runs if run.invalid]
        return (
            f"only {len(record.valid)} of {wanted} runs were valid after {len(record.runs)} tries; "
            f"allowed: {windows}; the last invalid one: {reasons[-1]}; "
            f"try: another rail in test.{record.name}.scenario.rail, or more tries"
        )
