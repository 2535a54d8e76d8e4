"""The study of reference speeds, made again on constant rail, agrees with its stored result."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from typing import Any

import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/reference_speed.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def study() -> Any:
    spec = importlib.util.spec_from_file_location("reference_speed", STUDIES / "reference_speed.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_constant_rail_again(study: Any) -> None:
    """Distances within 2 %, errors within 0.5 m/s: the closed loop is chaotic."""
    found = study.study((100,), 1, ("0.03",), ("present", "ground"))
    for band, rails in found.items():
        for rule, cell in rails["0.03"]["100"].items():
            stored = STORED["cells"][band]["0.03"]["100"][rule]
            assert cell["distance"] == pytest.approx(stored["distance"], rel=0.02)
            assert cell["below"] == pytest.approx(stored["below"], abs=0.5)
            assert cell["lock"] <= 0.4


def test_stored_summary_and_page_belong_to_the_stored_cells(study: Any) -> None:
    assert study.summary(STORED["cells"]) == STORED["summary"]
    page = (STUDIES / "results/reference_speed.md").read_text(encoding="utf-8")
    assert study.markdown(STORED["cells"]) == page


def test_what_the_documentation_claims() -> None:
    """The plain rule locks wheels, the shipped one does not, a known ground speed is best known."""
    found = STORED["summary"]
    for band in ("macro", "micro"):
        assert found[f"{band}, greatest"]["lock"] > 10.0
        assert found[f"{band}, present"]["lock"] <= 0.4
        assert found[f"{band}, ground"]["rms"] < found[f"{band}, present"]["rms"]
