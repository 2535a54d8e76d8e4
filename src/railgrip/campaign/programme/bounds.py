"""The limits of a profile, read in the units of what they judge, and in words again."""

from __future__ import annotations

from railgrip.campaign.programme.metrics import JudgingMetric, metric
from railgrip.campaign.programme.profile import Profile, Window
from railgrip.campaign.programme.records import Bounds
from railgrip.core.errors import Problem, RailgripError

Key = tuple[str, str, str]
"""Test, ``valid`` or ``limit``, metric."""


def read_bounds(profile: Profile, metrics: dict[str, JudgingMetric]) -> dict[Key, Bounds]:
    """Return every limit and window of a profile in SI.

    Raises
    ------
    RailgripError
        Every limit without unit and every unknown metric at once.
    """
    problems: list[Problem] = []
    found = {}
    for name, test in profile.test.items():
        windows: list[tuple[str, str, Window]] = [
            *(("valid", key, one) for key, one in test.valid.items()),
            *(("limit", key, one) for key, one in test.limit.items()),
        ]
        for kind, key, window in windows:
            where = f"test.{name}.{kind}.{key}"
            try:
                found[name, kind, key] = _bounds_of(metric(metrics, key, where), window, where)
            except RailgripError as error:
                problems += error.problems
        for key in test.report:
            try:
                metric(metrics, key, f"test.{name}.report")
            except RailgripError as error:
                problems += error.problems
    if problems:
        raise RailgripError(problems)
    return found


def _bounds_of(judge: JudgingMetric, window: Window, where: str) -> Bounds:
    ends = [
        None if value is None else judge.read(value, f"{where}.{side}")
        for side, value in (("least", window.least), ("greatest", window.greatest))
    ]
    return Bounds(*ends)


def in_words(judge: JudgingMetric, bounds: Bounds) -> str:
    """Return bounds as ``at least 3 % and at most 8 %``."""
    parts = []
    if bounds.least is not None:
        parts.append(f"at least {judge.unit.show(bounds.least)}")
    if bounds.greatest is not None:
        parts.append(f"at most {judge.unit.show(bounds.greatest)}")
    return " and ".join(parts)
