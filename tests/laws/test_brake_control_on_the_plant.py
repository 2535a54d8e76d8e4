"""Brake control on the plant: forces as asked for, the same bits in every company, WSP beneath."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import railgrip as rg
from railgrip.engine.simulate import nominal_numbers


def stop(layer: dict[str, Any] | None, name: str = "dry_emergency", **more: Any) -> rg.Scenario:
    scenario = rg.load(name)
    train = scenario.train.model_dump(by_alias=True)
    train["dynamic_brake"] = None
    return scenario.with_({"train": train, "brake_control": layer, **more})


def test_the_estimate_is_the_pads_friction_where_the_sensor_has_no_lag() -> None:
    """Pad law and estimate are the same law of the same inputs but for hysteresis and filling."""
    layer = {"pressure_reserve": 1.3, "estimator": {"sensor_lag": 0}, "period": "0.01 s"}
    data = rg.simulate(stop(layer), variations={"START_TEMPERATURE": [150.0]}).data
    late = (data.time.values > 4.0) & (data.train_speed.values[0] > 3.0)
    pads = data["pad_friction"].values[0][:, late]
    estimate = data["estimated_friction"].values[0][:, late]
    assert np.abs(estimate / pads - 1.0).max() < 0.004


def test_the_heat_model_follows_the_disc() -> None:
    """From a believed start, with the pads as known: 300 K of heating to 2 %."""
    layer = {"pressure_reserve": 1.3, "estimator": {"temperature": "model"}}
    with_model = rg.simulate(stop(layer)).data
    layer = {"pressure_reserve": 1.3, "estimator": {"sensor_lag": 0}}
    with_truth = rg.simulate(stop(layer)).data
    one = float(with_model["stopping_distance"].values[0])
    other = float(with_truth["stopping_distance"].values[0])
    assert one == pytest.approx(other, rel=0.004)


@pytest.mark.parametrize("level", ["emergency", 0.6])
def test_estimate_and_controller_bring_hot_discs_to_the_asked_deceleration(level: Any) -> None:
    """Mean of asked and measured deceleration between 60 and 20 m of the way, to 1 %."""
    layer = {"pressure_reserve": 1.3, "estimator": {}, "deceleration": {}}
    scenario = stop(layer, **{"run.demand": level})
    data = rg.simulate(scenario, variations={"START_TEMPERATURE": [180.0]}).data
    numbers = nominal_numbers(scenario)
    mass = numbers["TRAIN_MASS"] + numbers["ROTATING_MASS"].sum()
    speed = data["train_speed"].values[0]
    asked = (1.0 if level == "emergency" else level) * numbers["FULL_FORCE"].sum()
    asked = asked + numbers["RESISTANCE_CONSTANT"]
    asked = asked + speed * (numbers["RESISTANCE_LINEAR"] + speed * numbers["RESISTANCE_QUADRATIC"])
    window = (data.time.values > 6.0) & (speed > 3.0)
    expected = (asked / mass)[window].mean()
    assert -data["acceleration"].values[0][window].mean() == pytest.approx(expected, rel=0.01)


def test_weight_nothing_is_no_estimator_to_the_bit() -> None:
    none = rg.simulate(stop({"deceleration": {}})).data
    nothing = {"deceleration": {}, "estimator": {"rule": [{"control": {"weight": 0}}]}}
    zero = rg.simulate(stop(nothing)).data
    assert np.array_equal(none["train_speed"].values, zero["train_speed"].values)


def test_alone_in_a_batch_and_on_two_threads_the_bits_are_the_same() -> None:
    scenario = stop(
        {"estimator": {"temperature": "model"}, "deceleration": {}}, "leaves_160"
    ).with_({"run.speed": "60 km/h"})
    temperatures = np.linspace(20.0, 250.0, 21)
    many = (
        rg.simulate(scenario, runs=21, threads=2, variations={"START_TEMPERATURE": temperatures})
        .data["stopping_distance"]
        .values
    )
    for i in (0, 7, 20):
        alone = rg.simulate(
            scenario, traces=False, variations={"START_TEMPERATURE": temperatures[i : i + 1]}
        )
        assert float(alone.data["stopping_distance"].values[0]) == many[i]


def test_the_slide_protection_keeps_its_priority() -> None:
    """On leaves nothing is won or lost: the mean of 16 stops differs by less than 2 %.

    The standard error of the difference is 0.5 %; wheels do not lock, and the controller lets go.
    """
    starts = {"INITIAL_SPEED": 160 / 3.6 + np.linspace(0.0, 0.05, 16)}
    without = rg.simulate(stop(None, "leaves_160"), runs=16, variations=starts).data
    layer = {"pressure_reserve": 1.3, "estimator": {}, "deceleration": {}}
    data = rg.simulate(stop(layer, "leaves_160"), runs=16, variations=starts).data
    assert float(data["axle_longest_fast_lock"].max()) < 0.4
    expected = float(without["stopping_distance"].mean())
    assert float(data["stopping_distance"].mean()) == pytest.approx(expected, rel=0.02)
    assert float(data["correction_effort"].mean()) < 0.01


def test_energy_is_kept_with_brake_control() -> None:
    layer = {"pressure_reserve": 1.3, "estimator": {}, "deceleration": {}}
    variations = {"PAD_FACTOR": [0.9], "START_TEMPERATURE": [200.0]}
    balance = rg.simulate(stop(layer), variations=variations).data["energy_balance"].values[0]
    assert abs(balance) < 1e-9


def test_it_stops_where_it_is_told() -> None:
    """Estimate and controller together, pads 8 % weaker or stronger: to 0.3 m."""
    layer = {
        "pressure_reserve": 1.3, "estimator": {}, "deceleration": {}, "stop_at": "1000 m",
    }  # fmt: skip
    scenario = stop(layer, **{"run.speed": "80 km/h", "run.demand": 0.8})
    variations = {"START_POSITION": [680.0] * 4, "PAD_FACTOR": [0.92, 0.97, 1.03, 1.08]}
    data = rg.simulate(scenario, runs=4, variations=variations).data
    places = 680.0 + data["stopping_distance"].values
    assert np.abs(places - 1000.0).max() < 0.3
    assert places.std() < 0.1


def test_without_brake_control_nothing_of_it_is_told() -> None:
    data = rg.simulate(stop(None)).data
    assert "correction_effort" not in data
    assert "estimated_friction" not in data
