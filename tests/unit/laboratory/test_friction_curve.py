"""Friction laws over arrays, and what they refuse."""

from __future__ import annotations

import math
from typing import Any

import pytest

from railgrip.contact.linear_friction import LinearFriction, linear_friction
from railgrip.contact.thermal_friction import (
    CONTACT_EXAMPLE_OVER_400,
    ThermalFriction,
    thermal_friction,
)
from railgrip.contact.three_regime_friction import ThreeRegimeFriction, three_regime_friction
from railgrip.core.errors import RailgripError
from railgrip.laboratory.friction_curve import friction_curve

LINE = LinearFriction(0.3, 0.1, 2.0)


def test_one_temperature_for_many_slip_speeds_and_the_other_way_round() -> None:
    assert friction_curve(linear_friction, LINE, [0.0, 1.0]).tolist() == [0.3, 0.2]
    hot = friction_curve(thermal_friction, CONTACT_EXAMPLE_OVER_400, 1.0, [0.0, 400.0])
    assert hot == pytest.approx([0.33, 0.14])


def test_infinity_means_never() -> None:
    never = ThreeRegimeFriction(0.3, 0.1, math.inf, 0.1, math.inf)
    assert friction_curve(three_regime_friction, never, [0.0, 50.0]) == pytest.approx([0.3, 0.3])


@pytest.mark.parametrize(
    ("parameters", "speed", "warmth", "words"),
    [
        (LINE, [], 20.0, "slip_speed: must have at least one point"),
        (LINE, [-1.0], 20.0, "slip_speed: must not be negative; got -1 m/s"),
        (LINE, [math.nan], 20.0, "slip_speed: point 1 is not a finite number"),
        (LINE, [1.0, 2.0], [1.0, 2.0, 3.0], "temperature: must have one point"),
        (LINE, [1.0], [math.inf], "temperature: point 1"),
        (LINE._replace(kinetic_friction=-0.1), [1.0], 20.0, "kinetic_friction: must be a number"),
        (LINE._replace(floor_speed=math.nan), [1.0], 20.0, "floor_speed: must be a number"),
    ],
)
def test_bad_input_gets_a_sentence(
    parameters: LinearFriction, speed: Any, warmth: Any, words: str
) -> None:
    with pytest.raises(RailgripError, match=words):
        friction_curve(linear_friction, parameters, speed, warmth)


def test_friction_that_would_turn_negative_is_refused() -> None:
    wrong = ThermalFriction(0.1, -0.2, 0.0, 100.0)
    with pytest.raises(RailgripError, match=r"no friction coefficient; got -0\.1 at 1 m/s and"):
        friction_curve(thermal_friction, wrong, [1.0], [100.0])
