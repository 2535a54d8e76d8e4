"""The study of slip strategies, made again on a few fields, agrees with its stored result."""

from __future__ import annotations

import importlib.util
import json
import math
from pathlib import Path
from typing import Any

import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/adaptive_slip.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def study() -> Any:
    spec = importlib.util.spec_from_file_location("adaptive_slip", STUDIES / "adaptive_slip.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_quick_study_agrees(study: Any) -> None:
    """Each mean of 16 fields lies within four standard errors of the mean of 200.

    Sixteen means are compared, so one of them would pass four errors once in a thousand times; on
    the processor that made the stored result the fields are the same and nothing is left to chance.
    """
    strategies = ["macro", "micro", "50/50 alternating", "adaptive"]
    quick = study.study((160,), study.QUICK_FIELDS, strategies, (True,))
    for rail, speeds in quick["as shipped"].items():
        for strategy, found in speeds["160"].items():
            stored = STORED["distance"]["as shipped"][rail]["160"][strategy]
            error = stored["spread"] / math.sqrt(study.QUICK_FIELDS)
            assert abs(found["mean"] - stored["mean"]) < 4 * error, (rail, strategy)


def test_stored_bounds_and_page_belong_to_the_stored_means(study: Any) -> None:
    assert study.judged(STORED["distance"]) == STORED["missed"]
    page = (STUDIES / "results/adaptive_slip.md").read_text(encoding="utf-8")
    assert study.markdown(STORED["distance"]) == page


def test_what_the_documentation_claims(study: Any) -> None:
    """Seeds of tuning and judging differ, and every bound is met."""
    assert STORED["seed"] == study.SEED
    assert STORED["seed"] not in STORED["tuning_seeds"]
    assert STORED["fields"] == 200
    assert STORED["missed"] == []
