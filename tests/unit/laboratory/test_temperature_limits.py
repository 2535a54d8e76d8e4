"""Limits of the steel: which are passed, and that they are anybody's to set."""

from __future__ import annotations

import math

import pytest

from railgrip.core.errors import RailgripError
from railgrip.laboratory.temperature_limits import STEEL_LIMITS, TemperatureLimit, passed_limits


def test_the_lowest_comes_first_with_its_excess() -> None:
    passed = passed_limits(900.0)
    assert [one.limit.name for one in passed] == [one.name for one in STEEL_LIMITS]
    assert [one.excess for one in passed] == [400.0, 177.0, 50.0]
    assert str(passed[1]).startswith("eutectoid A1 (723 °C) passed by 177 K: austenite")


def test_below_all_nothing_is_said_and_every_limit_has_a_source() -> None:
    assert passed_limits(100.0) == []
    assert all(limit.source for limit in STEEL_LIMITS)


def test_own_limits_replace_them() -> None:
    own = [TemperatureLimit("mine", 300.0, "paint burns", "own test")]
    assert [one.limit.name for one in passed_limits(350.0, own)] == ["mine"]


@pytest.mark.parametrize("temperature", [math.nan])
def test_no_number_is_refused(temperature: float) -> None:
    with pytest.raises(RailgripError, match="the temperature is not a number"):
        passed_limits(temperature)
    with pytest.raises(RailgripError, match="limit 'odd': the limit is not a number"):
        passed_limits(20.0, [TemperatureLimit("odd", math.nan, "", "")])
