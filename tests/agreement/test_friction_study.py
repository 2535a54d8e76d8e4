"""The study of friction estimation, made again on few stops, agrees with its stored result."""

from __future__ import annotations

import importlib.util
import json
import math
import sys
from pathlib import Path
from typing import Any

import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/friction_estimation.json").read_text(encoding="utf-8"))
PLACES = json.loads((STUDIES / "results/precise_stopping.json").read_text(encoding="utf-8"))


def module(name: str) -> Any:
    spec = importlib.util.spec_from_file_location(name, STUDIES / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    found = importlib.util.module_from_spec(spec)
    sys.modules[name] = found
    spec.loader.exec_module(found)
    return found


@pytest.fixture(scope="module")
def study() -> Any:
    return module("friction_estimation")


@pytest.fixture(scope="module")
def stopping(study: Any) -> Any:
    return module("precise_stopping")


def test_the_quick_study_agrees(study: Any) -> None:
    """Standard deviation and mean of 96 of the 2000 stops, within four standard errors."""
    n = study.QUICK_STOPS
    quick = study.study(n, full=False)
    for case, way in [("as drawn", way) for way in study.WAYS] + [("learned", "both")]:
        found = quick[case]["emergency"]["160"]["1.3"][way]
        stored = STORED["cells"][case]["emergency"]["160"]["1.3"][way]
        error = stored["distance"] / math.sqrt(n)
        assert abs(found["mean"] - stored["mean"]) < 4 * error, (case, way)
        # a standard deviation of n normal stops has the relative error 1/sqrt(2 n)
        assert abs(found["distance"] / stored["distance"] - 1) < 4 / math.sqrt(2 * n), (case, way)


def test_the_quick_stops_agree(stopping: Any) -> None:
    n = stopping.QUICK_STOPS
    for way in ("constant", "both"):
        found = stopping.stops_of(way, n)["spread"]
        assert abs(found / PLACES["error"][way]["spread"] - 1) < 4 / math.sqrt(2 * n), way


def test_stored_pages_belong_to_the_stored_numbers(study: Any, stopping: Any) -> None:
    assert study.judged(STORED["cells"]) == STORED["missed"]
    page = (STUDIES / "results/friction_estimation.md").read_text(encoding="utf-8")
    assert study.markdown(STORED["cells"]) == page
    page = (STUDIES / "results/precise_stopping.md").read_text(encoding="utf-8")
    assert stopping.markdown(PLACES["error"]) == page


def test_what_the_documentation_claims(study: Any) -> None:
    """Every bound is met; 2000 stops, 500 of stopping at a place."""
    assert STORED["missed"] == []
    assert STORED["stops"] == study.STOPS == 2000
    assert PLACES["stops"] == 500
