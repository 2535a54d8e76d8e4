"""The strip on a worn rail: its load, its limit, its refusals."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.contact_pressure import elliptic_pressure, rectangular_pressure
from railgrip.contact.rectangular_patch import rectangular_patch
from railgrip.core.errors import RailgripError
from railgrip.core.formulas.patch import hertz_1882


@given(st.floats(1e3, 2e5), st.floats(0.1, 1.0), st.floats(0.005, 0.1))
def test_the_load_is_the_integral_of_the_pressure(load: float, radius: float, width: float) -> None:
    patch = rectangular_patch(load, radius, width, 210e9, 0.28)
    assert patch.greatest_pressure * 0.5 * math.pi * patch.a * width == pytest.approx(load)


def test_a_very_long_ellipse_tends_to_it() -> None:
    """Its middle carries, per width, the load of a strip of the same half-length."""
    ellipse = hertz_1882(100e3, 0.46, -1.0, 1.0 - 1e-6, 210e9, 0.28)
    assert ellipse.b > 50.0 * ellipse.a
    load = 0.5 * math.pi * ellipse.greatest_pressure * ellipse.a * 0.01
    strip = rectangular_patch(load, 0.46, 0.01, 210e9, 0.28)
    assert strip.a == pytest.approx(ellipse.a, rel=1e-3)
    assert strip.greatest_pressure == pytest.approx(ellipse.greatest_pressure, rel=1e-3)


@given(st.floats(-1.5, 1.5), st.floats(-1.5, 1.5))
def test_pressure_is_even_and_vanishes_outside(x: float, y: float) -> None:
    strip = rectangular_patch(100e3, 0.46, 0.02, 210e9, 0.28)
    ellipse = hertz_1882(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    here = rectangular_pressure(strip, x * strip.a, 0.5 * y * strip.width)
    there = elliptic_pressure(ellipse, x * ellipse.a, y * ellipse.b)
    assert here == rectangular_pressure(strip, -x * strip.a, -0.5 * y * strip.width)
    assert there == elliptic_pressure(ellipse, -x * ellipse.a, -y * ellipse.b)
    if max(abs(x), abs(y)) > 1.0 + 1e-12:
        assert here == there == 0.0
    assert 0.0 <= here <= strip.greatest_pressure
    assert 0.0 <= there <= ellipse.greatest_pressure


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((-1e3, 0.46, 0.02, 210e9, 0.28), "the load must be positive and finite; got -1000 N"),
        ((1e5, 0.0, 0.02, 210e9, 0.28), "wheel radius"),
        ((1e5, 0.46, math.inf, 210e9, 0.28), "width of the contact"),
        ((1e5, 0.46, 0.02, math.nan, 0.28), "Young's modulus"),
        ((1e5, 0.46, 0.02, 210e9, 0.6), "Poisson's ratio out of range; got 0.6"),
    ],
)
def test_impossible_strips_get_a_sentence(
    arguments: tuple[float, float, float, float, float], sentence: str
) -> None:
    with pytest.raises(RailgripError, match=sentence):
        rectangular_patch(*arguments)
