"""The slope formulas: how they grow, and what they refuse."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.cap_2000 import cap_2000_simple_slope, cap_2000_slope
from railgrip.contact.carter_slope import carter_1926_slope
from railgrip.contact.hertz_factors import hertz_factors, mean_young
from railgrip.contact.kalker_1990 import kalker_coefficients
from railgrip.contact.kalker_slope import kalker_1967_simple_slope, kalker_1967_slope
from railgrip.contact.rectangular_patch import rectangular_patch
from railgrip.contact.surface_stiffness import rectangular_stiffness_slope, stiffness_slope
from railgrip.core.errors import RailgripError
from railgrip.core.formulas.patch import hertz_1882


@given(st.floats(1e3, 2e5), st.floats(0.2, 0.7))
def test_each_grows_with_its_own_power_of_the_load(load: float, radius: float) -> None:
    def growth(slope: Callable[[float], float]) -> float:
        return slope(8.0 * load) / slope(load)

    assert growth(lambda q: cap_2000_slope(q, radius, 0.3)) == pytest.approx(8.0)
    assert growth(lambda q: cap_2000_simple_slope(q, radius)) == pytest.approx(8.0)
    assert growth(lambda q: carter_1926_slope(q, radius)) == pytest.approx(math.sqrt(8.0))
    assert growth(kalker_1967_simple_slope) == pytest.approx(4.0)


@given(st.floats(0.5, 2.0), st.floats(0.25, 0.3))
def test_kalkers_fit_follows_his_table_for_steel(ratio: float, poisson: float) -> None:
    table = 0.5 / (1.0 + poisson) * kalker_coefficients(ratio, 1.0, poisson).c11
    assert kalker_1967_slope(ratio, 1.0, 1.0) / ratio == pytest.approx(table, rel=0.012)


@pytest.mark.parametrize(("head", "excess"), [(0.3, 0.055), (0.5, 0.065), (0.5 / 6.0, 0.169)])
def test_caps_formula_lies_above_what_it_stands_for(head: float, excess: float) -> None:
    patch = hertz_1882(100e3, 0.5, math.inf, head, 210e9, 0.3)
    ratio = cap_2000_slope(100e3, 0.5, head) / stiffness_slope(patch.a, patch.b, 20e12)
    assert ratio == pytest.approx(1.0 + excess, abs=0.005)


def test_the_printed_bracket_of_cap_gives_a_slope_far_too_high_for_a_cone() -> None:
    """(2.12a) prints r1x/r1y, which is 0 for a cone: as a rail head of infinite radius."""
    assert cap_2000_slope(100e3, 0.5, 1e12) == pytest.approx(25_830e3, rel=1e-6)


@given(st.floats(1e3, 2e5), st.floats(0.2, 0.7), st.floats(0.005, 0.05))
def test_carters_formula_is_his_cylinder_of_fixed_width(
    load: float, radius: float, width: float
) -> None:
    a = rectangular_patch(load, radius, width, 210e9, 0.3).a
    of_cylinder = 2.0 * load * radius / a
    assert of_cylinder / carter_1926_slope(load, radius) == pytest.approx(
        1.8442 * math.sqrt(width / 0.02), rel=1e-4
    )


def test_a_rectangle_as_wide_as_the_ellipse_has_4_for_8_thirds() -> None:
    ellipse = stiffness_slope(6e-3, 4e-3, 20e12)
    rectangle = rectangular_stiffness_slope(6e-3, 2.0 * 4e-3, 20e12)
    assert rectangle / ellipse == pytest.approx(4.0 / (8.0 / 3.0))


def test_factors_times_the_cube_root_are_the_semi_axes() -> None:
    factors = hertz_factors(1.0 / 0.5, 1.0 / 0.3)
    root = math.cbrt(3.0 * 100e3 * (1.0 - 0.09) / (210e9 * (1.0 / 0.5 + 1.0 / 0.3)))
    patch = hertz_1882(100e3, 0.5, math.inf, 0.3, 210e9, 0.3)
    assert factors.is_long_along
    assert (factors.long * root, factors.short * root) == pytest.approx((patch.a, patch.b))
    assert math.cos(factors.angle) == pytest.approx(0.25)
    assert not hertz_factors(1.0 / 0.3, 1.0 / 0.5).is_long_along


def test_the_mean_modulus_is_harmonic() -> None:
    assert mean_young(210e9, 210e9) == pytest.approx(210e9)
    assert 2.0 / mean_young(100e9, 300e9) == pytest.approx(1.0 / 100e9 + 1.0 / 300e9)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: cap_2000_slope(0.0, 0.5, 0.3), "load must be positive and finite; got 0 N"),
        (lambda: cap_2000_slope(1e5, 0.5, -0.3), "rail head must be positive"),
        (lambda: cap_2000_simple_slope(1e5, math.inf), "wheel radius must be positive"),
        (lambda: carter_1926_slope(-1e3, 0.5), "load must be positive and finite; got -1000 N"),
        (lambda: kalker_1967_slope(0.0, 1e-3, 2e11), "semi-axis a must be positive"),
        (lambda: kalker_1967_simple_slope(math.nan), "load must be positive"),
        (lambda: mean_young(0.0, 2e11), "Young's modulus must be positive"),
        (lambda: stiffness_slope(1e-3, 1e-3, 0.0), "stiffness must be positive"),
        (lambda: rectangular_stiffness_slope(1e-3, 0.0, 1e13), "width must be positive"),
        (lambda: hertz_factors(2.0, -0.1), "Hertz has no solution; got 2 1/m along, -0.1 1/m"),
        (lambda: hertz_factors(math.nan, 1.0), "Hertz has no solution"),
    ],
)
def test_impossible_input_gets_a_sentence(call: Callable[[], object], sentence: str) -> None:
    with pytest.raises(RailgripError, match=sentence):
        call()
