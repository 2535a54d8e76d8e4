"""What the temperatures of a contact accept as numbers, rows and courses."""

from __future__ import annotations

import math

import pytest

from railgrip.core.errors import RailgripError
from railgrip.laboratory.heat_inputs import course, one_number, rising


def test_what_is_in_range_comes_through() -> None:
    assert one_number("speed", 0, "m/s", least=0.0) == 0.0
    assert one_number("temperature", -40.0, "°C") == -40.0
    assert rising("time", [0, 1, 3]).tolist() == [0.0, 1.0, 3.0]
    assert course("power", [1, 2], 2).tolist() == [1.0, 2.0]


@pytest.mark.parametrize(
    ("value", "says"),
    [
        (0.0, "load: must be positive and finite; got 0 N"),
        (math.inf, "load: must be positive and finite; got inf N"),
        (None, "load: must be positive and finite; got nan N"),
        ([1.0, 2.0], r"load: must be one number; got shape \(2,\)"),
        ("heavy", "the load must be a number .*got 'heavy'"),
    ],
)
def test_one_number_names_what_is_wrong(value: object, says: str) -> None:
    with pytest.raises(RailgripError, match=says):
        one_number("load", value, "N", least=0.0, is_above=True)  # type: ignore[arg-type]


@pytest.mark.parametrize("values", [[0.0], [1.0, 0.0], [0.0, math.nan], [0.0, math.inf], 3.0])
def test_a_row_that_does_not_rise_is_refused(values: object) -> None:
    with pytest.raises(RailgripError, match="time: the time must rise; try: two or more"):
        rising("time", values)  # type: ignore[arg-type]


def test_a_course_has_one_value_for_each_or_one_for_all() -> None:
    with pytest.raises(RailgripError, match="one value for each wheel, or one for all"):
        course("rail_powers", [1.0, 2.0, 3.0], 2, of="wheel")
    with pytest.raises(RailgripError, match="power: must be zero or more, and finite; got -1"):
        course("power", [1.0, -1.0], 2, least=0.0)
