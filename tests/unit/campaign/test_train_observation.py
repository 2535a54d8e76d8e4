"""A train's own measurements against the plant's truth."""

from __future__ import annotations

import numpy as np
import pytest

import railgrip as rg
from railgrip.campaign.train_measurements import Measurements, measurements_of
from railgrip.campaign.train_observation import observe
from railgrip.core.errors import RailgripError

FACTORS = np.array([1.08, 0.94, 1.03, 0.90])


def stopped(name: str, changes: dict | None = None) -> tuple[rg.Scenario, rg.Result]:
    """Return a stop of the four-car train whose vehicles' pads differ."""
    scenario = rg.load(name).with_({"run.trace": 0.02, **(changes or {})})
    axles = scenario.train.axles()
    pads = {("PAD_FACTOR", i): [FACTORS[axle.vehicle]] for i, axle in enumerate(axles)}
    return scenario, rg.simulate(scenario, variations=pads, traces=True)


def true_friction(result: rg.Result) -> np.ndarray:
    """Return the mean friction of each vehicle's pads, weighted by clamp force."""
    data = result.data.isel(run=0)
    vehicle = np.array([axle.vehicle for axle in result.scenario.train.axles()])
    friction = np.nan_to_num(data["pad_friction"].values)
    clamp = np.nan_to_num(data["clamp_force"].values)
    return np.array(
        [(friction * clamp)[vehicle == v].sum() / max(clamp[vehicle == v].sum(), 1.0)
         for v in range(4)]
    )  # fmt: skip


@pytest.mark.parametrize("name", ["dry_emergency", "detergent_160", "leaves_160"])
def test_one_stop_tells_the_train_s_friction_within_what_it_says(name: str) -> None:
    """Mean of the train within 3 %, each vehicle within 2.5 of its standard deviations."""
    scenario, result = stopped(name)
    found = observe(scenario, measurements_of(result))
    true = true_friction(result)
    assert found.common == pytest.approx(true.mean(), rel=0.03)
    assert (np.abs(found.friction - true) < 2.5 * found.friction_error).all()


def test_vehicles_cut_out_in_turn_are_told_apart() -> None:
    """Four stops, one vehicle released in each: within 5 %, as friction drifts by 6 % in a stop."""
    stops, result, scenario = [], None, rg.load("dry_emergency")
    for vehicle in range(4):
        axles = [axle.label for axle in scenario.train.axles() if axle.vehicle == vehicle]
        faults = [{"axle": label, "kind": "valve_vents"} for label in axles]
        _, result = stopped("dry_emergency", {"fault": faults, "train.dynamic_brake": None})
        stops.append(measurements_of(result))
    _, all_brake = stopped("dry_emergency", {"train.dynamic_brake": None})
    scenario = all_brake.scenario
    alone = observe(scenario, measurements_of(all_brake))
    found = observe(scenario, *stops)
    true = true_friction(all_brake)
    assert found.friction == pytest.approx(true, rel=0.05)
    assert (found.friction_error < 0.7 * alone.friction_error).all()
    assert (np.argsort(found.friction) == np.argsort(true)).all()


def test_the_adhesion_of_sliding_axles_is_seen() -> None:
    """Root mean square error 0.015 of the load, half a window late; the law is f8."""
    scenario, result = stopped("leaves_160")
    found = observe(scenario, measurements_of(result))
    used = result.data["adhesion_used"].values[0][:, : found.adhesion.shape[1]]
    late = 4
    error = (found.adhesion[:, late:] - used[:, :-late])[found.is_sliding[:, late:]]
    assert np.sqrt(np.nanmean(error**2)) < 0.015
    assert abs(np.nanmean(error)) < 0.005


def test_an_even_brake_is_solved_exactly() -> None:
    """By hand: μ = (M D + Σ m_r D − R)/X, one pressure everywhere, wheels that roll."""
    scenario = rg.load("dry_emergency").with_({"train.dynamic_brake": None})
    from railgrip.engine.simulate import nominal_numbers

    numbers = nominal_numbers(scenario)
    time = np.arange(0.0, 20.0, 0.02)
    speed = 40.0 - 1.0 * time
    ones = np.ones((16, 1))
    pressure = ones * np.full_like(time, 2.5e5)
    measured = Measurements(
        time, ones * speed, pressure, 0.0 * pressure, speed, np.full_like(time, 1.0)
    )
    clamp = numbers["CLAMP_PER_PRESSURE"] * 2.5e5 + numbers["CLAMP_OFFSET"]
    lever = float((numbers["TREAD_PER_CLAMP"] * clamp).sum())
    resistance = (
        numbers["RESISTANCE_CONSTANT"] + numbers["RESISTANCE_LINEAR"] * speed
        + numbers["RESISTANCE_QUADRATIC"] * speed**2
    ).mean()  # fmt: skip
    by_hand = (numbers["TRAIN_MASS"] + numbers["ROTATING_MASS"].sum() - resistance) / lever
    assert observe(scenario, measured).common == pytest.approx(by_hand, rel=2e-3)


def test_what_cannot_be_used_is_refused() -> None:
    scenario, result = stopped("dry_emergency")
    good = measurements_of(result)
    with pytest.raises(RailgripError, match="evenly spaced"):
        observe(scenario, good._replace(time=good.time**1.1))
    with pytest.raises(RailgripError, match="has 3 axles"):
        observe(scenario, good._replace(wheel_speed=good.wheel_speed[:3]))
    still = good._replace(brake_cylinder_pressure=0.0 * good.brake_cylinder_pressure)
    with pytest.raises(RailgripError, match="never works"):
        observe(scenario, still)
