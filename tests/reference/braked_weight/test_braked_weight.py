"""Braked weights: the formula, and the shipped coach and wagon against their data."""

from __future__ import annotations

import pytest
from tests.conftest import Shipped

import railgrip as rg
from railgrip.train.braked_weight import braked_weight_percentage


@pytest.mark.parametrize(("distance", "percentage"), [(480.0, 100.0), (700.0, 65.0)])
def test_single_vehicles(distance: float, percentage: float) -> None:
    """WAG TSI, table C.3, within 0.6 points."""
    found = braked_weight_percentage(distance, 100 / 3.6, single_vehicle=True)
    assert found == pytest.approx(percentage, abs=0.6)


@pytest.mark.parametrize(
    ("kmh", "distance", "percentage"),
    [(100, 562.9, 100.0), (120, 821.1, 100.0), (160, 1092.2, 150.2), (200, 1359.3, 200.0)],
)
def test_trains(kmh: int, distance: float, percentage: float) -> None:
    """Distances of s = C/(λ + D) worked out by hand, within 0.1 points."""
    assert braked_weight_percentage(distance, kmh / 3.6) == pytest.approx(percentage, abs=0.1)


@pytest.mark.parametrize(("scenario", "kmh"), [("coach_120", 120), ("wagon_100", 100)])
def test_the_simulated_stop(shipped: Shipped, scenario: str, kmh: int) -> None:
    """Within 3 % of the vehicle's data: single vehicle, dry, level (UIC 544-1)."""
    result = shipped(scenario)
    described = result.scenario
    assert described.run.speed == pytest.approx(kmh / 3.6)
    distance = float(result["stopping_distance"].values[0])
    share = braked_weight_percentage(distance, kmh / 3.6, single_vehicle=True) / 100
    assert share * described.mass == pytest.approx(described.train.braked_weight, rel=0.03)


def test_the_track_brake_adds_braked_weight(shipped: Shipped) -> None:
    """The coach with magnets, R + Mg: data 85 t against 63 t; at least 20 t more, within 15 %."""
    with_magnets = rg.simulate(rg.load("coach_120").with_(train="coach_disc_mg"))
    distance = float(with_magnets["stopping_distance"].values[0])
    share = braked_weight_percentage(distance, 120 / 3.6, single_vehicle=True) / 100
    described = with_magnets.scenario
    assert share * described.mass == pytest.approx(described.train.braked_weight, rel=0.15)
