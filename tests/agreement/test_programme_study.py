"""The stored table of the test programme still holds, in a reduced run."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from typing import Any

import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/test_programme.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def study() -> Any:
    spec = importlib.util.spec_from_file_location("programme_study", STUDIES / "programme.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("controller", ["conventional", "adaptive"])
def test_a_reduced_run_lies_in_the_stored_interval(controller: str, study: Any) -> None:
    """K_wet of three runs within three times the stored interval of ten, verdicts the same."""
    found = study.examine(controller, 3, ("W3",))
    stored = STORED["controllers"][controller]
    middle, low, high = stored["k_wet"]["W3"]
    assert found["k_wet"]["W3"][0] == pytest.approx(middle, abs=1.5 * (high - low) + 0.005)
    for key, limit in found["limits"].items():
        assert limit["verdict"] == stored["limits"][key]["verdict"]


def test_the_page_is_made_from_the_stored_table(study: Any) -> None:
    page = (study.RESULTS / "test_programme.md").read_text(encoding="utf-8")
    assert page == study.page(STORED)
