"""What is refused in a scenario's brake control, and with which sentence."""

from __future__ import annotations

from typing import Any

import pytest

import railgrip as rg


@pytest.mark.parametrize(
    ("layer", "says"),
    [
        ({"estimator": {"functions": ["pressure"]}}, "functions"),
        ({"estimator": {"pad": "organik"}}, "did you mean 'organic'"),
        ({"estimator": {"rule": [{"control": {"form": "result", "weight": 0}}]}}, "deviation"),
        ({"estimator": {"rule": [{"model": {"speed": {"least": 1.1, "greatest": 0.9}}}]}}, "least"),
        ({"estimator": {"rule": [{"train_speed": ["50 km/h", "20 km/h"]}]}}, "must rise"),
        ({"estimator": {"rule": [{"control": {"speed": {"weight": 1.5}}}]}}, "weight"),
        ({"pressure_reserve": 0.9}, "pressure_reserve"),
        ({"deceleration": {"delay": "3 s"}, "period": "0.04 s"}, "60 periods"),
        ({"decelleration": {}}, "decelleration"),
        ({"stop_at": "10 km/h"}, "stop_at"),
    ],
)
def test_what_cannot_be_is_refused_with_its_place(layer: dict[str, Any], says: str) -> None:
    with pytest.raises(rg.RailgripError, match=says):
        rg.load("dry_emergency").with_({"brake_control": layer})


@pytest.mark.parametrize(
    ("train", "layer", "says"),
    [
        ("freight_20", {"estimator": {}}, "piecewise or constant pad"),
        ("emu_four_car", {"period": "0.055 s"}, "multiple of the step"),
        ("emu_four_car", {"estimator": {"rule": [
            {"control": {"speed": {"weight": [["20 m/s", 1], ["10 m/s", 0]]}}}]}}, "rise"),
    ],
)  # fmt: skip
def test_what_cannot_run_is_refused_before_it_runs(
    train: str, layer: dict[str, Any], says: str
) -> None:
    scenario = rg.load("dry_emergency").with_({"train": train, "brake_control": layer})
    with pytest.raises(rg.RailgripError, match=says):
        rg.simulate(scenario)
