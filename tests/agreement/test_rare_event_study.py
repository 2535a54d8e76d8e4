"""The study of coverage: its stored result keeps what is demanded, and a few seeds agree."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/rare_event_coverage.json").read_text(encoding="utf-8"))
CHECK = "16 units, q 1e-3, c 5 %"


MILLION = json.loads((STUDIES / "results/plant_brute_force.json").read_text(encoding="utf-8"))


def script(name: str) -> Any:
    spec = importlib.util.spec_from_file_location(name, STUDIES / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def study() -> Any:
    return script("rare_event_coverage")


def test_stored_intervals_hold() -> None:
    assert STORED["seeds"] == 30
    for row in STORED["cases"].values():
        assert row["coverage"] >= 0.92
        assert row["simultaneous"] >= 28
    assert STORED["cases"][CHECK]["half_width"][9] < 0.002


def test_stored_intervals_hold_in_several_directions() -> None:
    """Where levels are resolved, as often as they say; a distance from the centre is refused."""
    for name, row in STORED["several_directions"].items():
        assert row["coverage"] >= 0.92
        assert row["simultaneous"] >= 28
        if name.startswith("distance"):
            assert min(row["not_resolved"][2:]) >= 0.9
        else:
            assert max(row["not_resolved"]) == 0.0


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


def test_a_million_stops_of_the_plant_agree_down_to_one_in_ten_thousand() -> None:
    """The probability asked lies between those counted at the ends of the interval, ± 3 errors."""
    assert MILLION["runs"] == 1_000_000
    assert [row["level"] for row in MILLION["levels"]] == [0, 1, 2, 3, 4]
    for row in MILLION["levels"]:
        asked = row["probability"] * MILLION["runs"]
        assert row["below_low"] - 3.0 * np.sqrt(row["below_low"]) <= asked
        assert asked <= row["below_high"] + 3.0 * np.sqrt(row["below_high"])


def test_the_first_of_the_million_stops_are_made_again() -> None:
    """Share of 400 stops below the counted levels: within three errors of so few."""
    brute = script("plant_brute_force")
    factors = brute.chunk(*brute.plant_model(2), 0, 400)
    for row in MILLION["levels"][:2]:
        p = row["probability"]
        share = np.mean(factors <= row["k_dry_counted"])
        assert abs(share - p) < 3.0 * np.sqrt(p * (1.0 - p) / 400)


def test_a_few_seeds_agree_in_several_directions(study: Any) -> None:
    name = "least of three, spreads 3, 4, 6 %"
    quick = study.study_several(4, [name])[name]
    assert quick["simultaneous"] == 4
    assert quick["coverage"] >= 0.92
    for level in (1, 5, 9):
        stored = STORED["several_directions"][name]["half_width"][level]
        assert quick["half_width"][level] == pytest.approx(stored, rel=0.25)
