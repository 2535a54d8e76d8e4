"""Collectors: the example by its path and by its name, and what is said of those that are wrong."""

from importlib.metadata import EntryPoint
from pathlib import Path

import numpy as np
import pytest

from railgrip.campaign.batch import Batches
from railgrip.campaign.campaign_file import campaign_from
from railgrip.core import registry
from railgrip.core.errors import RailgripError

FOLDER = Path(__file__).parents[2] / "docs/examples/collectors"
RUNS = 9
SPEED = {
    "quantity": "run.speed", "name": "speed",
    "distribution": {"kind": "uniform", "low": "55 km/h", "high": "65 km/h"},
}  # fmt: skip


def table(collector: str, folder: Path):
    low = {"rail.condition": "low"}
    asked = {"scenario": "wagon_100", "runs": RUNS, "variable": [SPEED], "set": low}
    return Batches(campaign_from({**asked, "collector": collector}, folder)).table(0, RUNS)


def test_the_example_counts_the_axles_with_a_long_flat() -> None:
    found = table("flats.py:flats", FOLDER)
    assert found["longest_flat"].shape == (RUNS,)
    np.testing.assert_array_equal(found["axles_to_turn"] > 0, found["longest_flat"] > 0.03)
    assert found["longest_flat"].max() > 0


def test_a_package_announces_its_collector(monkeypatch) -> None:
    monkeypatch.syspath_prepend(str(FOLDER))
    group = "railgrip.collectors"
    entry = EntryPoint("own_flats", "flats:flats", group)
    monkeypatch.setattr(registry, "_entries", lambda asked: {"own_flats": entry})
    by_name = registry.resolve(group, "own_flats", "collector")
    assert by_name({"axle_flat_length": np.array([[0.0, 0.04]])})["axles_to_turn"].tolist() == [1]
    with pytest.raises(RailgripError, match="did you mean 'own_flats'"):
        registry.resolve(group, "own_flat", "collector")


@pytest.mark.parametrize(
    ("body", "sentence"),
    [
        ("figures['axle_flat']", "failed with KeyError.*axle_flat_length"),
        ("1 / 0", "failed with ZeroDivisionError"),
        ("[1, 2]", "must return a dictionary of arrays.*list"),
        ("{'flat': figures['axle_flat_length']}", r"one value for each run as 'flat'.*\(9,\)"),
        ("{'flat': [[1], [1, 2]]}", "one value for each run as 'flat'"),
        ("{'flat': ['long'] * 9}", "must return numbers as 'flat'"),
        (
            "{'status': figures['stopping_distance']}",
            "returns 'status', which the campaign has already",
        ),
    ],
)
def test_a_wrong_collector_is_told_so(body, sentence, tmp_path) -> None:
    (tmp_path / "mine.py").write_text(f"def mine(figures):\n    return {body}\n", encoding="utf-8")
    with pytest.raises(RailgripError, match=sentence):
        table("mine.py:mine", tmp_path)
