"""The study of locked wheels, made again in part, agrees: no wheel stands while the train runs."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from typing import Any

import pytest

import railgrip as rg

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/locked_wheels.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def study() -> Any:
    spec = importlib.util.spec_from_file_location("locked_wheels", STUDIES / "locked_wheels.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_with_slow_valves_no_wheel_locks(study: Any) -> None:
    """Distances within 2 %: another processor rounds otherwise, and the closed loop is chaotic."""
    for controller in study.CONTROLLERS:
        for rail in ("0.02", "0.05", "steps 0.03-0.15"):
            found = study.cell(rail, 100, "slow", controller, 1)
            assert found["lock"] <= study.LOCK_LIMIT, (controller, rail)
            stored = STORED["cells"][controller]["slow"][rail]["100"]["distance"]
            assert found["distance"] == pytest.approx(stored, rel=0.02), (controller, rail)


def test_without_protection_wheels_do_lock(study: Any) -> None:
    """The measure sees what it is to see: 0.05 asks for protection of brakes sized for 0.13."""
    bare = study.stop(study.rails()["0.05"], 100, "nominal", "conventional")
    result = rg.simulate(bare.with_({"wsp": {"controller": "none", "parameters": {}}}))
    assert float(result["axle_longest_fast_lock"].max()) > 10.0


def test_stored_sentences_and_page_belong_to_the_stored_cells(study: Any) -> None:
    assert study.judged(STORED["cells"]) == STORED["locked"] == []
    assert set(STORED["cells"]) == set(study.CONTROLLERS)
    page = (STUDIES / "results/locked_wheels.md").read_text(encoding="utf-8")
    assert study.markdown(STORED["cells"]) == page
