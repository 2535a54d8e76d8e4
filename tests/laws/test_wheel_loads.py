"""Wheel loads: together the weight at every moment, heavier in front while braking."""

from __future__ import annotations

import numpy as np
import pytest
from tests.conftest import Shipped

from railgrip import data
from railgrip.core.constants import GRAVITY


@pytest.mark.parametrize("name", data.names("scenarios"))
def test_they_sum_to_the_weight(shipped: Shipped, name: str) -> None:
    """At every moment, to 1e-9."""
    result = shipped(name)
    loads = result["wheel_load"].values[0].sum(axis=0)
    loads = loads[np.isfinite(loads)]
    np.testing.assert_allclose(loads, result.scenario.mass * GRAVITY, rtol=1e-9)


@pytest.mark.parametrize("name", ["dry_emergency", "coach_120", "freight_stop"])
def test_front_axles_gain_in_braking(shipped: Shipped, name: str) -> None:
    """In each bogie the first axle gains; over a vehicle's bogies the first bogie gains."""
    result = shipped(name)
    static = result["wheel_load"].values[0][:, 0]
    moment = int(np.nanargmin(result["acceleration"].values[0]))
    gain = result["wheel_load"].values[0][:, moment] - static
    axles = result.scenario.train.axles()
    of_bogie: dict[tuple[int, int], list[float]] = {}
    for place, more in zip(axles, gain, strict=True):
        of_bogie.setdefault((place.vehicle, place.bogie), []).append(float(more))
    for first, second in of_bogie.values():
        assert first > second
    for vehicle in range(len(result.scenario.train.vehicle)):
        front, rear = sum(of_bogie[vehicle, 0]), sum(of_bogie[vehicle, 1])
        assert front > 0.0 > rear
        assert front + rear == pytest.approx(0.0, abs=1e-3)


def test_the_gain_is_moment_over_wheelbase(shipped: Shipped) -> None:
    """Body m h a over the pivot distance, and each bogie's push over its wheelbase, to 1e-3.

    coach_120 at its steady deceleration; both masses' heights from its data. Tolerance: the load
    lags behind the deceleration by 0.15 s.
    """
    result = shipped("coach_120")
    vehicle = result.scenario.train.vehicle[0]
    bogie = vehicle.bogie[0]
    speed = result["train_speed"].values[0]
    moment = int(np.nanargmin(np.abs(speed - 20.0)))
    deceleration = -float(result["acceleration"].values[0][moment])
    body = result.scenario.mass - 2 * bogie.mass
    on_pivot = body * (vehicle.body_height - bogie.traction_height) / vehicle.pivot_distance
    push = (0.5 * body * bogie.traction_height + bogie.mass * bogie.height) / bogie.wheelbase
    expected = np.array([0.5 * on_pivot + push, 0.5 * on_pivot - push])
    expected = np.concatenate([expected, -expected[::-1]]) * deceleration
    loads = result["wheel_load"].values[0]
    np.testing.assert_allclose(loads[:, moment] - loads[:, 0], expected, rtol=2e-3)


def test_within_a_bogie_the_unloaded_axle_slides_first(shipped: Shipped) -> None:
    """On uniform leaves the second axle of each bogie passes 5 % slip before the first."""
    result = shipped("coach_leaves")
    sliding = result["creepage"].values[0] < -0.05
    first = [int(np.argmax(axle)) for axle in sliding]
    assert sliding.any(axis=1).all()
    assert first[1] < first[0]
    assert first[3] < first[2]
