"""The study of temperature control, made again on a few fields, agrees with its stored result."""

from __future__ import annotations

import importlib.util
import json
import math
from pathlib import Path
from typing import Any

import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/temperature_control.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def study() -> Any:
    path = STUDIES / "temperature_control.py"
    spec = importlib.util.spec_from_file_location("temperature_control", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_on_uniform_rail_the_limit_is_used_and_not_passed(study: Any) -> None:
    """Continuous: the greatest rise to within 2 %. Valves pass it by about a tenth."""
    for name, row in study.uniform().items():
        if name.startswith("continuous"):
            assert 0.98 <= row["greatest"] <= 1.0, name
            assert row["mean"] > 0.94, name
        else:
            assert row["greatest"] < 1.12, name
        assert row["distance"] == pytest.approx(STORED["uniform"][name]["distance"], rel=0.01)


def test_after_a_step_of_adhesion_it_is_back_under_the_limit(study: Any) -> None:
    found = study.step_of_adhesion()
    assert found["continuous"]["longest"] <= 0.3
    # threefold friction at the same slip is threefold heat: no controller prevents it
    assert 2.5 < found["continuous"]["greatest"] < 3.0
    assert found["valves"]["median"] <= 0.3


def test_an_emergency_uses_more_and_stops_shorter(study: Any) -> None:
    found = study.emergency_step()
    service, emergency = found["service"], found["emergency"]
    assert emergency["greatest_rise"] > 1.5 * service["greatest_rise"]
    assert emergency["slid_energy"] > service["slid_energy"]
    assert emergency["distance"] < service["distance"]


def test_the_linear_law_heats_by_the_root_of_the_speed(study: Any) -> None:
    """Within 5 %: at slips of a few per cent the wheel is a little slower than the train."""
    for speed, row in study.two_laws().items():
        assert row["ratio"] == pytest.approx(math.sqrt(float(speed) / 20.0), rel=0.05)


def test_the_quick_comparison_agrees(study: Any) -> None:
    """Each mean of 25 fields lies within four standard errors of the mean of 200."""
    points = {"continuous": STORED["random"]["continuous"]["set_point"]}
    quick = study.comparison(study.QUICK_FIELDS, points, ("continuous",))["continuous"]
    for condition, rows in quick.items():
        for name, found in rows.items():
            stored = STORED["comparison"]["continuous"][condition][name]
            error = stored["distance_spread"] / math.sqrt(study.QUICK_FIELDS)
            assert abs(found["distance"] - stored["distance"]) < 4 * error, (condition, name)


def test_what_the_documentation_claims(study: Any) -> None:
    assert STORED["fields"] == 200
    assert STORED["seed"] != STORED["tuning_seed"]
    for name, row in STORED["random"].items():
        assert row["fields_over"] == 0, name
    page = (STUDIES / "results/temperature_control.md").read_text(encoding="utf-8")
    assert study.markdown(STORED) == page
    for kind in study.TRAINS:
        rails = STORED["comparison"][kind]
        hot = rails["water_detergent"]["temperature, set point 0.95"]
        wide = rails["water_detergent"]["conventional 8-16 %"]
        assert hot["greatest_rise"] < 0.6 * wide["greatest_rise"]
        assert hot["distance"] < 1.01 * wide["distance"]
        longest = max(row["distance"] for row in rails["leaves"].values())
        assert rails["leaves"]["temperature, set point 0.95"]["distance"] == longest
