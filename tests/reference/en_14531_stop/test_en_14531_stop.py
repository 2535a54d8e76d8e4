"""The plant stops the standard's train where the standard's method does."""

from __future__ import annotations

from typing import Any

import pytest
from tests.conftest import Shipped

import railgrip as rg

STEPPED = 496.1


def distance(result: rg.Result) -> float:
    return float(result["stopping_distance"].values[0])


def test_the_example_as_shipped(shipped: Shipped) -> None:
    """Within 0.5 % of 496.1 m (EN 14531-1, stepped in time with linear ramps)."""
    assert distance(shipped("en14531_100")) == pytest.approx(STEPPED, rel=5e-3)


def without_springs(brake: Any) -> dict[str, Any]:
    """The same full force from a cylinder without springs: then force rises as pressure does."""
    full = brake.greatest_clamp_force
    bare = brake.cylinder_pressure * brake.cylinder_area * brake.rigging_ratio
    return {
        "cylinder_spring": 0.0,
        "rigging_spring": 0.0,
        "cylinder_efficiency": full / (bare * brake.rigging_efficiency),
    }


def test_linear_force_ramps() -> None:
    """Within 0.03 %: the printed digit, and the micro-slip that the method does not know."""
    scenario = rg.load("en14531_100")
    brakes = {name: without_springs(brake) for name, brake in scenario.train.brakes.items()}
    result = rg.simulate(scenario.with_(train={"brakes": brakes}))
    assert distance(result) == pytest.approx(STEPPED, rel=3e-4)
