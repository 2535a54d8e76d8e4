"""Verdicts against published tables and limits of their own."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.campaign.programme.verdict import hold, mean_interval, share_at_least


@pytest.mark.parametrize(
    ("runs", "share"),
    [(59, 0.95), (299, 0.99), (22, 0.873), (10, 0.741)],
)
def test_the_share_of_kept_runs_is_wilks(runs: int, share: float) -> None:
    """All of n runs kept: the share s with s^n = 0.05 (Wilks 1941; 59 runs for 95/95)."""
    assert share_at_least(runs, runs) == pytest.approx(share, abs=6e-4)
    assert share_at_least(runs, runs) ** runs == pytest.approx(0.05, rel=1e-6)


def test_one_failure_in_ninety_three_is_95_95() -> None:
    """The next row of Wilks's table: 93 runs of which one may fail."""
    assert share_at_least(92, 93) == pytest.approx(0.95, abs=1e-3)


def test_the_interval_of_a_mean_is_students() -> None:
    """Student's own data (1908, sleep gained by ten patients): mean 1.58, 95 % 0.70 to 2.46."""
    gained = np.array([1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4])
    assert mean_interval(gained) == pytest.approx((0.700, 2.460), abs=2e-3)


def test_a_figure_that_no_run_has_is_not_applicable() -> None:
    held = hold(np.array([math.nan, math.nan]), None, 1.0)
    assert held.verdict == "not applicable"
    assert held.worst == -1


def test_what_never_happens_is_missed() -> None:
    held = hold(np.array([8.0, math.inf]), None, 10.0)
    assert held.verdict == "missed"
    assert held.worst == 1


def test_a_mean_may_be_kept_where_one_run_is_not() -> None:
    values = np.array([0.1, 0.2, 0.5])
    assert hold(values, None, 0.4, "mean").verdict == "kept"
    assert hold(values, None, 0.4, "each").verdict == "missed"


@given(
    values=st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=20),
    limit=st.floats(0.1, 1e3),
    judged=st.sampled_from(["each", "mean"]),
)
def test_the_margin_says_what_the_verdict_says(
    values: list[float], limit: float, judged: str
) -> None:
    held = hold(np.array(values), None, limit, judged)
    assert (held.verdict == "kept") == (held.margin >= 0.0)
    assert held.value == pytest.approx(limit * (1.0 - held.margin), abs=1e-9 * limit + 1e-9)


@given(kept=st.integers(0, 50), more=st.integers(0, 50))
def test_more_kept_runs_are_surer(kept: int, more: int) -> None:
    of = kept + more
    if of:
        assert share_at_least(kept, of) <= kept / of
        assert share_at_least(kept, of) <= share_at_least(kept + 1, of + 1)
