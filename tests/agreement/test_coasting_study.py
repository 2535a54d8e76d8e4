"""The study of coasting: what its stored result says, and a part of it made again."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from typing import Any

import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/coasting.json").read_text(encoding="utf-8"))["lines"]
BELOW = 5e-4


@pytest.fixture(scope="module")
def study() -> Any:
    spec = importlib.util.spec_from_file_location("coasting_study", STUDIES / "coasting.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def every_run() -> list[dict[str, Any]]:
    found = []
    for trains in STORED.values():
        for row in trains.values():
            found += [*row["untuned"].values()]
            for ways in row["tuned"].values():
                found += ways.values()
    return found


def test_no_rule_beats_the_optimum() -> None:
    runs = every_run()
    assert len(runs) == 2 * 3 * (7 + 4 * 3)
    for run in runs:
        assert run["optimum"] <= run["energy"] * (1.0 + BELOW)


def test_tuned_coasting_makes_most_of_the_saving_that_a_little_time_offers() -> None:
    """At +5 %, the best of the three actions on every line and train."""
    for trains in STORED.values():
        for row in trains.values():
            best = max(one["share"] for one in row["tuned"]["0.05"].values())
            assert 0.55 < best <= 1.0 + BELOW


def test_untuned_runs_are_made_again(study: Any) -> None:
    again = study.untuned("kiss_sbb", "fribourg_bern")
    for name, one in STORED["fribourg_bern"]["kiss_sbb"]["untuned"].items():
        assert again[name]["time"] == pytest.approx(one["time"], rel=1e-6)
        assert again[name]["energy"] == pytest.approx(one["energy"], rel=1e-6)


def test_a_short_search_comes_near_the_stored_one(study: Any) -> None:
    """Ten rounds instead of sixty: within a tenth of the possible saving."""
    again = study.tuned("flirt_tpf", "fribourg_bern", 0.05, 10)["cut"]
    stored = STORED["fribourg_bern"]["flirt_tpf"]["tuned"]["0.05"]["cut"]
    assert again["time"] == pytest.approx(stored["time"], rel=2e-3)
    assert again["share"] == pytest.approx(stored["share"], abs=0.1)
