"""Surfaces from a locked wheel to a fast one: continuous, and a word for what does not fit."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002
from railgrip.laboratory.contact_temperature import FAST, flux_rises, surface_temperatures
from railgrip.laboratory.moving_source import peclet
from railgrip.laboratory.sliding_contact import SlidingContact

A, B = 5.88e-3, 10.54e-3
PLACES = np.linspace(-2.5, 4.0, 53) * A


def sliding(wheel: float, friction: float = 0.3, bulk: float = 20.0) -> SlidingContact:
    return SlidingContact(100e3, A, B, friction, wheel, 30.0, bulk, 20.0)


def speed_of(rate: float) -> float:
    return rate / peclet(STEEL_ERTZ_2002, A, 1.0)


@pytest.mark.parametrize("rate", [1e-6, 0.3, 1.0, 10.0])
def test_a_little_faster_is_a_little_different(rate: float) -> None:
    """From rest on, flash and unequal bulk together: no step at any slow speed."""
    slow = surface_temperatures(sliding(speed_of(rate), bulk=150.0), PLACES)
    slower = surface_temperatures(sliding(speed_of(0.999 * rate), bulk=150.0), PLACES)
    assert slow.wheel == pytest.approx(slower.wheel, rel=2e-3)
    assert slow.rail == pytest.approx(slower.rail, rel=2e-3)


def test_a_wheel_that_locks_is_the_limit_of_a_slow_one() -> None:
    locked = surface_temperatures(sliding(0.0, bulk=150.0), PLACES)
    slow = surface_temperatures(sliding(speed_of(1e-6), bulk=150.0), PLACES)
    assert slow.wheel == pytest.approx(locked.wheel, rel=1e-4)
    assert slow.rail == pytest.approx(locked.rail, rel=1e-4)


def test_the_change_to_strips_is_a_step_as_small_as_stated() -> None:
    below, above = (sliding(speed_of(FAST * part)) for part in (1 - 1e-9, 1 + 1e-9))
    for beside, step in ((0.0, 0.008), (np.linspace(-0.99, 0.99, 23)[:, None] * B, 0.03)):
        exact, strips = (surface_temperatures(each, PLACES, beside) for each in (below, above))
        assert np.abs(exact.wheel - strips.wheel).max() < step * (strips.wheel.max() - 20.0)
    hot, cold = (
        surface_temperatures(sliding(speed_of(FAST * part), 0.0, 150.0), PLACES).wheel
        for part in (1 - 1e-9, 1 + 1e-9)
    )
    assert np.abs(hot - cold).max() < 0.01 * 130.0


def test_a_locked_wheel_is_warm_around_the_patch_and_symmetric() -> None:
    found = surface_temperatures(sliding(0.0), np.array([-2.0, -0.5, 0.5, 2.0]) * A).wheel
    assert found[::-1] == pytest.approx(found, rel=1e-6)
    assert found.min() > 20.0


def test_unlike_steels_meet_nearer_to_the_one_that_takes_more() -> None:
    """A rail of four times the conductivity has twice the β: two thirds of the mean."""
    good = STEEL_ERTZ_2002._replace(conductivity=200.0)
    contact = SlidingContact(100e3, A, B, 0.0, 30.0, 30.0, 150.0, 0.0, rail=good)
    assert contact.touch_temperature() == pytest.approx(50.0, rel=2e-3)


@pytest.mark.parametrize(
    ("places", "says"),
    [
        (([0.0, math.nan],), "the places behind must be finite; got nan m"),
        (([0.0], ["left"]), "the places beside must be a number"),
        (([0.0, 1.0], [0.0, 1.0, 2.0]), "the arrays do not fit together"),
    ],
)
def test_places_that_are_none_get_a_sentence(places: tuple[Any, ...], says: str) -> None:
    with pytest.raises(RailgripError, match=says):
        surface_temperatures(sliding(29.0), *places)


def test_strips_are_refused_for_a_slow_wheel_with_what_to_take_instead() -> None:
    with pytest.raises(RailgripError, match=r"wheel_speed: the surface of the wheel is too slow"):
        flux_rises(sliding(0.1), [0.0, 1e-3], [1e8, 1e8])
    slow_train = SlidingContact(100e3, A, B, 0.3, 30.0, 0.1)
    with pytest.raises(RailgripError, match=r"train_speed: .* rail is too slow.*surface_temper"):
        flux_rises(slow_train, [0.0, 1e-3], [1e8, 1e8])
