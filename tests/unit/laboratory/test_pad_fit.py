"""Pads that are known come back from stops; what cannot be found is named."""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.laboratory.pad_fit import PadStops, Plan, Shape, compare_laws, identify_pad
from railgrip.laboratory.pad_fit.data import blocks_of
from railgrip.laboratory.pad_fit.laws import Lags, Product
from railgrip.laboratory.pad_fit.shape import Placed
from railgrip.laboratory.pad_fit.synthetic import (
    ORGANIC_POINTS,
    Programme,
    organic,
    product_law,
    synthetic_stops,
)

CLEAN = Programme(stops=40, samples=200, offset=1e-6, noise=1e-6, outliers=0.0)
LEVEL = [(100.0, 1.0)]


def test_clean_stops_give_the_pad_back() -> None:
    """Only the sensors' own noise is left: 0.5 K, 0.2 %, 0.5 %."""
    found = identify_pad(synthetic_stops(organic, CLEAN, seed=1))
    assert found.problems == []
    for name, points in ORGANIC_POINTS.items():
        for k, (x, _) in enumerate(points):
            assert found[f"{name}_point_{k + 1}"].value == pytest.approx(x, rel=0.02)
    assert found["temperature_lag"].value == pytest.approx(2.0, abs=0.1)
    assert found["temperature_factor_2"].value == pytest.approx(0.75, abs=0.004)
    reference = 0.37 * np.interp(25e3, *zip(*ORGANIC_POINTS["clamp_force"], strict=True))
    assert found.reference_friction == pytest.approx(reference, rel=0.003)


def test_jacobian_of_a_product() -> None:
    """Against central differences, at places where no break point lies on a block."""
    blocks = blocks_of(synthetic_stops(organic, Programme(stops=3, samples=60), seed=2), 9)
    law = Product(
        {
            "temperature": Placed(Shape(2), 20.0, 700.0),
            "speed": Placed(Shape(4, "open"), 0.5, 55.0),
            "clamp_force": Placed(Shape(3, at=(8e3, 20e3, 42e3)), 8e3, 42e3),
        },
        Lags((1.0, 0.0, 0.0), ("temperature",)),
    )
    theta = np.array([-1.0, 150.3, 199.7, 0.8, 12.1, 18.2, 1.05, 0.97, 0.9, 0.97, 0.9, 1.7])
    _, columns = law.log_friction(theta, blocks)
    for k in range(len(theta)):
        step = np.zeros(len(theta))
        step[k] = 1e-6 * max(1.0, abs(theta[k]))
        above, _ = law.log_friction(theta + step, blocks)
        below, _ = law.log_friction(theta - step, blocks)
        there = blocks.is_there
        slope = ((above - below) / (2 * step[k]))[there]
        np.testing.assert_allclose(columns[..., k][there], slope, rtol=1e-4, atol=1e-8)


def test_outliers_and_odd_stops_hardly_count() -> None:
    stops = synthetic_stops(organic, CLEAN._replace(noise=0.01, offset=0.01), seed=3)
    rows = np.random.default_rng(1).random(len(stops.time)) < 0.05
    odd = stops.friction.copy()
    odd[rows] *= 1.6
    odd[stops.stop == 7] *= 0.8
    spoiled = identify_pad(stops._replace(friction=odd))
    whole = identify_pad(stops)
    assert spoiled.reference_friction == pytest.approx(whole.reference_friction, rel=0.01)
    assert spoiled.fit.weights.stop[7] < 0.1


def test_force_that_hardly_varies_is_named_and_the_rest_fitted() -> None:
    found = identify_pad(
        synthetic_stops(organic, CLEAN._replace(clamp_force=(24e3, 24.5e3)), seed=4)
    )
    assert "clamp_force" not in found.points
    assert {"temperature", "speed"} == set(found.points)
    assert "varies too little" in str(found.problems[0])
    assert found.problems[0].where == "clamp_force"


def test_influences_that_move_together_are_named() -> None:
    stops = synthetic_stops(organic, CLEAN, seed=5)
    tied = stops._replace(clamp_force=9e3 + 550.0 * stops.speed)
    found = identify_pad(tied)
    assert "clamp_force" not in found.points
    assert any("they move together" in str(one) for one in found.problems)


def test_what_was_not_measured_is_named() -> None:
    stops = synthetic_stops(organic, CLEAN, seed=6)
    found = identify_pad(stops._replace(temperature=np.full(len(stops.time), np.nan)))
    assert "was not measured" in str(found.problems[0])
    assert set(found.points) == {"speed", "clamp_force"}


def test_no_effect_is_no_function() -> None:
    law = product_law(0.35, LEVEL, ORGANIC_POINTS["speed"], LEVEL)
    found = identify_pad(synthetic_stops(law, Programme(stops=60), seed=7))
    assert set(found.points) == {"speed"}
    assert sum("shows no effect" in str(one) for one in found.problems) == 2


def test_three_levels_of_force_become_its_points() -> None:
    stops = synthetic_stops(organic, CLEAN._replace(force_steps=1, stops=42), seed=8)
    level = np.array([10e3, 25e3, 40e3])[stops.stop % 3]
    friction = stops.friction / organic(LEVEL[0][0] * np.ones_like(level), 15.0, stops.clamp_force)
    friction = friction * organic(LEVEL[0][0] * np.ones_like(level), 15.0, level)
    found = identify_pad(stops._replace(clamp_force=level, friction=friction))
    assert [x for x, _ in found.points["clamp_force"]] == pytest.approx([10e3, 25e3, 40e3])
    assert any("takes few values" in str(one) for one in found.problems)


def test_few_stops_give_numbers_without_intervals() -> None:
    found = identify_pad(synthetic_stops(organic, CLEAN._replace(stops=4), seed=9))
    assert np.isnan(found.parameters[0].low)
    assert any("too few" in str(one) for one in found.problems)


def test_one_stop_is_refused() -> None:
    with pytest.raises(RailgripError, match="there are 1 stops"):
        identify_pad(synthetic_stops(organic, CLEAN._replace(stops=1), seed=1))


def test_five_points_are_refused() -> None:
    stops = synthetic_stops(organic, CLEAN._replace(stops=2), seed=1)
    with pytest.raises(RailgripError, match=r"speed\.points: a function has 2 to 4 points; got 5"):
        identify_pad(stops, Plan({"speed": Shape(5)}))


def test_one_at_a_time_agrees_with_all_together() -> None:
    stops = synthetic_stops(organic, CLEAN._replace(stops=150), seed=10)
    plan = Plan(lags=Lags((2.0, 0.0, 0.0)), method="one_at_a_time", nearness=0.3)
    found = identify_pad(stops, plan)
    assert found.reference_friction == pytest.approx(0.37, rel=0.02)
    assert found["temperature_factor_2"].value == pytest.approx(0.75, abs=0.05)
    narrow = identify_pad(stops, Plan(method="one_at_a_time", nearness=1e-4))
    assert narrow.points == {}
    assert len(narrow.problems) == 3


def test_a_law_is_told_apart_by_stops_left_out() -> None:
    scores = compare_laws(identify_pad(synthetic_stops(organic, Programme(stops=60), seed=11)))
    assert [one.name for one in scores if one.is_chosen] == ["III"]
    by_name = {one.name: one for one in scores}
    assert by_name["constant"].error > 2 * by_name["III"].error


def test_blocks_keep_time_and_slope() -> None:
    n = np.arange(100)
    line = PadStops(n * 0, n * 0.1, np.full(100, 0.3), 20.0 + 0.5 * n, 30.0 - 0.2 * n, n + 1e4)
    blocks = blocks_of(line, 10)
    np.testing.assert_allclose(blocks.slopes[:, 0, :].T, np.tile([5.0, -2.0, 10.0], (10, 1)))
    np.testing.assert_allclose(blocks.log_friction, np.log(0.3))
