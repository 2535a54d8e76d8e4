"""The study of identification, made again on a few trials, agrees with its stored result."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from typing import Any

import pytest

STUDIES = Path(__file__).parents[2] / "studies"
STORED = json.loads((STUDIES / "results/identification.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def study() -> Any:
    spec = importlib.util.spec_from_file_location("identification", STUDIES / "identification.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_trials_made_again_agree(study: Any) -> None:
    """Errors of three trials lie within five of the stored spreads."""
    for number in range(3):
        for name, (_, _, error) in study.trial(study.SEED + number).items():
            stored = STORED["coverage"][name]
            assert abs(error - stored["mean_error"]) < 5.0 * stored["spread"], (number, name)


def test_page_and_judgement_belong_to_the_stored_result(study: Any) -> None:
    assert study.judged(STORED["coverage"]) == STORED["judged"]
    page = (STUDIES / "results/identification.md").read_text(encoding="utf-8")
    assert study.markdown(STORED) == page


def test_what_the_documentation_claims(study: Any) -> None:
    assert STORED["seed"] == study.SEED
    assert STORED["trials"] == 200
    assert STORED["judged"]["mean"] >= study.LEAST_MEAN
    for maker, counts in STORED["told_apart"].items():
        assert counts.get(maker, 0) >= 0.75 * STORED["model_trials"], maker
