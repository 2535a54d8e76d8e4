"""The study of coverage: its stored result keeps what is demanded, and a few seeds agree."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from typing import Any

import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/rare_event_coverage.json").read_text(encoding="utf-8"))
CHECK = "16 units, q 1e-3, c 5 %"


@pytest.fixture(scope="module")
def study() -> Any:
    place = STUDIES / "rare_event_coverage.py"
    spec = importlib.util.spec_from_file_location("rare_event_coverage", place)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_stored_intervals_hold() -> None:
    assert STORED["seeds"] == 30
    for row in STORED["cases"].values():
        assert row["coverage"] >= 0.92
        assert row["simultaneous"] >= 28
    assert STORED["cases"][CHECK]["half_width"][9] < 0.002


def test_brute_force_agrees_down_to_a_millionth() -> None:
    for one in STORED["brute_force"]:
        assert (
            abs(one["brute"] - one["probability"]) < 3.5 * one["error"] + 0.03 * one["probability"]
        )
    assert STORED["brute_force"][-1]["level"] == 6


def test_a_few_seeds_agree(study: Any) -> None:
    """Half widths within a quarter of the stored mean; all simultaneous intervals hold."""
    quick = study.study(4, {CHECK: study.CASES[CHECK]})[CHECK]
    stored = STORED["cases"][CHECK]
    assert quick["simultaneous"] == 4
    assert quick["coverage"] >= 0.92
    for level in (1, 3, 5, 7, 9):
        assert quick["half_width"][level] == pytest.approx(stored["half_width"][level], rel=0.25)
