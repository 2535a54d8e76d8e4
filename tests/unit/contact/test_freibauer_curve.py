"""Freibauer's curve in Čáp's terms: the plant's form, its derivative, its tangent."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.freibauer_1983 import freibauer_1983
from railgrip.contact.freibauer_curve import (
    elliptic_stress_growth,
    freibauer_adhesion,
    freibauer_slope,
    rectangular_stress_growth,
)
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.surface_stiffness import rectangular_stiffness_slope, stiffness_slope
from railgrip.core.errors import RailgripError

FRICTION = st.floats(0.01, 0.8)
GROWTH = st.floats(1.0, 1e3)
CREEPAGE = st.floats(-0.5, 0.5)


@given(FRICTION, st.floats(1e4, 2e5), st.floats(1e-6, 0.5))
def test_both_patches_give_the_curve_of_the_plant(
    friction: float, load: float, creepage: float
) -> None:
    rail = RailFriction(friction, 1.0, 0.0, 1.0, 1.0)
    for growth, slope in (
        (elliptic_stress_growth(load, 7e-3, 5e-3, 2e13), stiffness_slope(7e-3, 5e-3, 2e13)),
        (
            rectangular_stress_growth(load, 5e-3, 0.02, 2e13),
            rectangular_stiffness_slope(5e-3, 0.02, 2e13),
        ),
    ):
        plant = freibauer_1983(rail, load, slope, 0.0, creepage) / load
        assert freibauer_adhesion(friction, growth, creepage) == pytest.approx(plant, rel=1e-12)
        assert load * freibauer_slope(friction, growth, 0.0) == pytest.approx(slope, rel=1e-12)


@given(FRICTION, GROWTH, CREEPAGE)
def test_the_slope_is_the_derivative(friction: float, growth: float, creepage: float) -> None:
    step = 1e-5 * friction / growth
    rise = freibauer_adhesion(friction, growth, creepage + step)
    rise -= freibauer_adhesion(friction, growth, creepage - step)
    scale = freibauer_slope(friction, growth, 0.0)
    slope = freibauer_slope(friction, growth, creepage)
    assert slope == pytest.approx(rise / (2.0 * step), abs=1e-5 * scale)
    assert slope == freibauer_slope(friction, growth, -creepage)


@given(FRICTION, GROWTH, CREEPAGE)
def test_odd_bounded_and_passive(friction: float, growth: float, creepage: float) -> None:
    adhesion = freibauer_adhesion(friction, growth, creepage)
    assert adhesion == -freibauer_adhesion(friction, growth, -creepage)
    assert abs(adhesion) <= friction * (1.0 + 1e-14)
    assert adhesion * creepage >= 0.0


@given(FRICTION, FRICTION, GROWTH)
def test_the_initial_slope_does_not_depend_on_friction(
    one: float, other: float, growth: float
) -> None:
    assert freibauer_slope(one, growth, 0.0) == freibauer_slope(other, growth, 0.0)


def test_the_tangent_reaches_friction_at_a_quarter_of_pi() -> None:
    friction, growth = 0.3, 120.0
    creepage = 0.25 * math.pi * friction / growth
    assert freibauer_slope(friction, growth, 0.0) * creepage == pytest.approx(friction)


def test_without_friction_nothing_is_transmitted() -> None:
    assert freibauer_adhesion(0.0, 120.0, 0.01) == 0.0


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: elliptic_stress_growth(0.0, 1e-3, 1e-3, 1e13), "load must be positive"),
        (lambda: elliptic_stress_growth(1e5, 1e-3, -1e-3, 1e13), "semi-axis b"),
        (lambda: rectangular_stress_growth(1e5, 1e-3, 0.0, 1e13), "width must be positive"),
        (lambda: rectangular_stress_growth(1e5, 1e-3, 0.01, math.nan), "stiffness"),
    ],
)
def test_impossible_contacts_get_a_sentence(call: Callable[[], float], sentence: str) -> None:
    with pytest.raises(RailgripError, match=sentence):
        call()
