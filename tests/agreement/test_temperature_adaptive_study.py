"""The study of temperature control under the supervisor, reduced, agrees with its stored result."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PATH = ROOT / "studies/temperature_adaptive.py"
STORED = json.loads((ROOT / "studies/results/temperature_adaptive.json").read_text("utf-8"))
SPEC = importlib.util.spec_from_file_location("temperature_adaptive", PATH)
assert SPEC is not None
assert SPEC.loader is not None
STUDY = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(STUDY)
FIELDS = 8


@pytest.mark.parametrize("name", ["continuous, leaves", "valves, leaves"])
def test_a_few_fields_agree_with_the_stored_ones(name: str) -> None:
    """Within three standard errors of the mean of so few fields."""
    kind, condition = name.split(", ")
    found = STUDY.row(kind, condition, "temperature_adaptive", FIELDS)["distance"]
    stored = STORED["stops"][name]["temperature_adaptive"]
    interval = 3.0 * stored["distance_spread"] / FIELDS**0.5
    assert found == pytest.approx(stored["distance"], abs=interval)


def test_what_the_documentation_claims() -> None:
    page = (ROOT / "docs/temperature.md").read_text(encoding="utf-8")
    table = STORED["stops"]
    assert STUDY.markdown(table, STORED["fields"]) in page
    for name, rows in table.items():
        alone, combined = rows["temperature_controlled"], rows["temperature_adaptive"]
        if name.endswith("leaves"):
            assert combined["distance"] < 1.004 * rows["micro_slip"]["distance"]
            assert 0.83 < combined["distance"] / alone["distance"] < 0.89
            assert 0.28 < combined["slid_energy"] / alone["slid_energy"] < 0.311
        else:
            assert 1.0 < combined["distance"] / alone["distance"] < 1.011
            assert combined["rise"] < 1.01 * alone["rise"]
