"""Braked weight: what it refuses, and that its two scales are told apart."""

from __future__ import annotations

import pytest

from railgrip.core.errors import RailgripError
from railgrip.train.braked_weight import SINGLE_VEHICLES, TRAINS, braked_weight_percentage


@pytest.mark.parametrize("single_vehicle", [False, True])
def test_a_shorter_stop_is_more_braked_weight(single_vehicle: bool) -> None:
    for kmh in SINGLE_VEHICLES if single_vehicle else TRAINS:
        found = [
            braked_weight_percentage(s, kmh / 3.6, single_vehicle=single_vehicle)
            for s in (1500.0, 900.0, 400.0)
        ]
        assert found == sorted(found)


def test_the_scales_differ() -> None:
    train = braked_weight_percentage(600.0, 120 / 3.6)
    alone = braked_weight_percentage(600.0, 120 / 3.6, single_vehicle=True)
    assert train - alone == pytest.approx(141.1 - 120.4, abs=0.1)


def test_a_speed_between_the_scales_is_refused() -> None:
    with pytest.raises(RailgripError, match="no braked weight scale; got 90 km/h; allowed: 100"):
        braked_weight_percentage(600.0, 25.0)
    with pytest.raises(RailgripError, match="got 200 km/h"):
        braked_weight_percentage(1400.0, 200 / 3.6, single_vehicle=True)


@pytest.mark.parametrize("distance", [0.0, -1.0, float("nan")])
def test_a_distance_that_is_none_is_refused(distance: float) -> None:
    with pytest.raises(RailgripError, match="stopping_distance: must be positive"):
        braked_weight_percentage(distance, 100 / 3.6)
