"""What a programme keeps: of each run, of each limit, of each test."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from railgrip.campaign.programme.metrics import JudgingMetric
from railgrip.campaign.programme.profile import Limit, ProgrammeTest
from railgrip.campaign.programme.verdict import Held
from railgrip.report.protocol.curves import Curves
from railgrip.scenario import Scenario


class Bounds(NamedTuple):
    """Least and greatest in SI, None where there is none."""

    least: float | None
    greatest: float | None


@dataclass(frozen=True)
class RunRecord:
    """One run: where it can be found again, what it gave.

    Attributes
    ----------
    number : int
        From 1, in the order of the tries.
    seed, index : int
        Of the batch in which it ran, and its place in it: these make it again, bit for bit.
    status : str
        How it ended, in words.
    invalid : str
        Why it does not count; empty for a valid run.
    figures : dict of float
        Metric → figure, SI.
    margin : float
        The least margin to any limit that every run must keep; NaN where there is none.
    curves : Curves
        Thinned, for the protocol.
    """

    number: int
    seed: int
    index: int
    status: str
    invalid: str
    figures: dict[str, float]
    margin: float
    curves: Curves


@dataclass(frozen=True)
class LimitRecord:
    """One limit with its verdict."""

    metric: JudgingMetric
    bounds: Bounds
    limit: Limit
    held: Held


@dataclass
class TestRecord:
    """What became of a test."""

    name: str
    test: ProgrammeTest
    scenario: Scenario | None = None
    runs: list[RunRecord] = field(default_factory=list)
    limits: list[LimitRecord] = field(default_factory=list)
    problem: str = ""

    __test__ = False  # pytest must not take it for one of its own

    @property
    def valid(self) -> list[RunRecord]:
        """The runs that count."""
        return [run for run in self.runs if not run.invalid]

    def figures(self, name: str) -> np.ndarray[Any, Any]:
        """Return a metric's figures of the valid runs, SI."""
        return np.array([run.figures[name] for run in self.valid])
