"""The study of starts, made again in two cases, agrees with its stored result and with the docs."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
STORED = json.loads((ROOT / "studies/results/traction_start.json").read_text(encoding="utf-8"))
SPEC = importlib.util.spec_from_file_location("traction_start", ROOT / "studies/traction_start.py")
assert SPEC is not None
assert SPEC.loader is not None
STUDY = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(STUDY)


@pytest.mark.parametrize("case", ["unit, leaves, 5 ‰", "locomotive, leaves, 10 ‰"])
@pytest.mark.parametrize(
    "controller", ["conventional_traction", "peak_seeking_traction", "adaptive_traction"]
)
def test_a_start_agrees_with_the_stored_one(case: str, controller: str) -> None:
    """Within 5 %: thresholds make single runs differ between processors."""
    found, stored = STUDY.row(case, controller, 1), STORED["starts"][case][controller]
    assert found["distance"] == pytest.approx(stored["distance"], rel=0.05)
    assert found["share_after_5_s"] == pytest.approx(stored["share_after_5_s"], abs=0.02)


def test_what_the_documentation_claims() -> None:
    table = STORED["starts"]
    page = (ROOT / "docs/traction.md").read_text(encoding="utf-8")
    assert STUDY.markdown(table) in page
    for case in ("unit, leaves, 5 ‰", "unit, low, 5 ‰", "locomotive, leaves, 10 ‰"):
        assert table[case]["peak_seeking_traction"]["share_after_5_s"] > 0.95
        assert table[case]["peak_seeking_traction"]["reference_error"] < 0.4
    assert table["locomotive, wet, 10 ‰"]["peak_seeking_traction"]["share_after_5_s"] < 0.9
    for case in table:
        better = max(table[case][c]["distance"] for c in ("peak_seeking_traction", "always macro"))
        assert table[case]["adaptive_traction"]["distance"] > 0.94 * better, case
