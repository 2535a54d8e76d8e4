"""The study of a trip in autumn: what its stored result says, and two of its trips made again."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from typing import Any

import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/autumn.json").read_text(encoding="utf-8"))
DRIVING = ("conventional_traction", "peak_seeking_traction", "adaptive_traction")


@pytest.fixture(scope="module")
def study() -> Any:
    spec = importlib.util.spec_from_file_location("autumn_study", STUDIES / "autumn.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_traction_control_saves_most_of_the_delay() -> None:
    autumn = STORED["autumn"]
    for name in DRIVING:
        assert autumn[name]["0.5"]["delay"] < 0.35 * autumn["conventional"]["0.5"]["delay"]
        assert (
            autumn[name]["0.5"]["energy_contact"]
            < 0.05 * (autumn["conventional"]["0.5"]["energy_contact"])
        )


def test_without_protection_wheels_lock_and_stops_are_overrun() -> None:
    none = STORED["autumn"]["none"]["0.5"]
    assert none["longest_lock"] > 10.0
    assert max(none["past_stops"]) > 300.0
    for name in (*DRIVING, "adaptive", "conventional", "micro_slip"):
        assert max(STORED["autumn"][name]["0.5"]["past_stops"]) < 0.1 * max(none["past_stops"])


@pytest.mark.parametrize("name", DRIVING[:2])
def test_a_trip_is_made_again(study: Any, name: str) -> None:
    """Within 2 %: slides are chaotic, another processor slides otherwise."""
    again = study.row(name, 0.5, STORED["planned"])
    stored = STORED["autumn"][name]["0.5"]
    assert again["running_time"] == pytest.approx(stored["running_time"], rel=0.02)
    assert again["energy_traction"] == pytest.approx(stored["energy_traction"], rel=0.05)
