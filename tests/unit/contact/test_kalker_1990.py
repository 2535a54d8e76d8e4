"""Kalker's coefficients: continuity, symmetry, refusals."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.kalker_1990 import kalker_coefficients, kalker_slope
from railgrip.core.errors import RailgripError

POISSON = st.floats(0.0, 0.5)


@given(st.floats(0.11, 9.0), POISSON)
def test_no_jump_within_the_table(ratio: float, poisson: float) -> None:
    here = kalker_coefficients(ratio, 1.0, poisson)
    there = kalker_coefficients(ratio * (1.0 + 1e-9), 1.0, poisson)
    assert here == pytest.approx(there, rel=1e-8)


@given(POISSON)
def test_no_jump_at_the_circle(poisson: float) -> None:
    short = kalker_coefficients(1.0 - 1e-12, 1.0, poisson)
    long = kalker_coefficients(1.0 + 1e-12, 1.0, poisson)
    assert short == pytest.approx(long, rel=1e-9)


@given(POISSON)
def test_the_asymptotes_take_over_within_their_error(poisson: float) -> None:
    """The steps at g = 0.1 that the docstring owns up to."""
    for table, outside, steps in (
        ((0.1, 1.0), (0.1 - 1e-12, 1.0), (0.018, 0.025, 0.063, 0.055)),
        ((1.0, 0.1), (1.0, 0.1 - 1e-12), (0.044, 0.031, 0.010, 0.067)),
    ):
        last, first = kalker_coefficients(*table, poisson), kalker_coefficients(*outside, poisson)
        for within, beyond, step in zip(last, first, steps, strict=True):
            assert beyond == pytest.approx(within, rel=step)


def test_the_asymptotes_without_poisson_effect_are_those_of_a_strip() -> None:
    """C11 = C22 = π²/4 for a/b → 0: a strip in plane strain, both directions alike."""
    found = kalker_coefficients(1e-6, 1.0, 0.0)
    assert found.c11 == found.c22 == pytest.approx(math.pi**2 / 4.0)


@given(st.floats(0.01, 100.0), POISSON, st.floats(1e-4, 1e2))
def test_only_the_shape_of_the_ellipse_counts(ratio: float, poisson: float, size: float) -> None:
    small = kalker_coefficients(ratio, 1.0, poisson)
    assert kalker_coefficients(size * ratio, size, poisson) == pytest.approx(small, rel=1e-9)


def test_without_poisson_effect_both_directions_are_alike() -> None:
    found = kalker_coefficients(1.3, 1.0, 0.0)
    assert found.c11 == found.c22


def test_the_slope_grows_with_the_load_to_the_two_thirds() -> None:
    slopes = [kalker_slope(load, 0.46, math.inf, 0.3, 210e9, 0.28) for load in (1e5, 8e5)]
    assert slopes[1] == pytest.approx(4.0 * slopes[0], rel=1e-9)


@pytest.mark.parametrize(
    ("a", "b", "poisson", "sentence"),
    [
        (0.0, 1.0, 0.28, "semi-axes"),
        (1.0, math.inf, 0.28, "semi-axes"),
        (math.nan, 1.0, 0.28, "semi-axes"),
        (1.0, 1.0, 0.51, "Poisson's ratio"),
    ],
)
def test_impossible_patches_get_a_sentence(
    a: float, b: float, poisson: float, sentence: str
) -> None:
    with pytest.raises(RailgripError, match=sentence):
        kalker_coefficients(a, b, poisson)
