"""The stored table of the test programme still holds, in a reduced run."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from studies import test_programme as study

STORED = json.loads((study.RESULTS / "test_programme.json").read_text(encoding="utf-8"))
STUDY = Path("studies/test_programme.py")


@pytest.mark.parametrize("controller", ["conventional", "adaptive"])
def test_a_reduced_run_lies_in_the_stored_interval(controller: str) -> None:
    """K_wet of three runs within three times the stored interval of ten, verdicts the same."""
    found = study.examine(controller, 3, ("W3",))
    stored = STORED["controllers"][controller]
    middle, low, high = stored["k_wet"]["W3"]
    assert found["k_wet"]["W3"][0] == pytest.approx(middle, abs=1.5 * (high - low) + 0.005)
    for key, limit in found["limits"].items():
        assert limit["verdict"] == stored["limits"][key]["verdict"]


def test_the_page_is_made_from_the_stored_table() -> None:
    page = (study.RESULTS / "test_programme.md").read_text(encoding="utf-8")
    assert page == study.page(STORED)
