"""Normals and the field that they make, number by number."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.track.random_field import (
    lognormal_factor,
    next_field_value,
    philox_4x32,
    standard_normal,
)

WORD = st.integers(0, 2**32 - 1)


@given(counter=st.tuples(WORD, WORD, WORD, WORD), key=st.tuples(WORD, WORD))
def test_words_fit_into_32_bits(counter: tuple[int, int, int, int], key: tuple[int, int]) -> None:
    assert all(0 <= word < 2**32 for word in philox_4x32(*counter, *key))


def test_normals_are_normal() -> None:
    """Moments of 20 000 numbers and the count beyond 3: within four standard errors."""
    n = 20_000
    found = np.array([standard_normal(cell, 3, 1, 12345) for cell in range(n)])
    assert abs(found.mean()) < 4 / n**0.5
    assert found.var() == pytest.approx(1.0, abs=4 * (2 / n) ** 0.5)
    assert abs((found**3).mean()) < 4 * (15 / n) ** 0.5
    assert (found**4).mean() == pytest.approx(3.0, abs=4 * (96 / n) ** 0.5)
    beyond = n * math.erfc(3 / 2**0.5)
    assert (np.abs(found) > 3).sum() == pytest.approx(beyond, abs=4 * beyond**0.5)
    assert abs(np.corrcoef(found[1:], found[:-1])[0, 1]) < 4 / n**0.5


@pytest.mark.parametrize("place", ["cell", "run", "stream", "seed"])
def test_each_word_of_the_name_counts(place: str) -> None:
    name = {"cell": 7, "run": 2, "stream": 1, "seed": 2**40 + 3}
    changed = {**name, place: name[place] + 1}
    assert standard_normal(**name) != standard_normal(**changed)


def test_seeds_beyond_32_bits_differ() -> None:
    assert standard_normal(1, 0, 0, 5) != standard_normal(1, 0, 0, 5 + 2**32)


@given(previous=st.floats(-5, 5), normal=st.floats(-5, 5), correlation=st.floats(0, 1))
def test_the_field_keeps_unit_variance(previous: float, normal: float, correlation: float) -> None:
    """The coefficients' squares sum to one; nothing correlated: the fresh number alone."""
    own = next_field_value(1.0, correlation, 0.0)
    fresh = next_field_value(0.0, correlation, 1.0)
    assert own**2 + fresh**2 == pytest.approx(1.0, abs=1e-12)
    assert next_field_value(previous, 0.0, normal) == normal
    assert next_field_value(previous, 1.0, normal) == previous


@pytest.mark.parametrize("spread", [0.0, 0.1, 0.3, 1.0])
def test_the_factor_has_mean_one_and_the_spread_asked_for(spread: float) -> None:
    """By Gauss–Hermite quadrature over the normal field, to 1e-6."""
    nodes, weights = np.polynomial.hermite_e.hermegauss(80)
    weights = weights / weights.sum()
    factors = np.array([lognormal_factor(node, spread) for node in nodes])
    mean = float((weights * factors).sum())
    assert mean == pytest.approx(1.0, abs=1e-6)
    deviation = float((weights * (factors - mean) ** 2).sum()) ** 0.5
    assert deviation == pytest.approx(spread, abs=1e-6)
