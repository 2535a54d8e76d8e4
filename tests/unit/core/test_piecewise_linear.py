"""Curves of straight lines against an interpolation from numpy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.core.errors import RailgripError
from railgrip.core.formulas.piecewise_linear import hinges_from_points, piecewise_linear

POINTS = st.lists(
    st.tuples(st.integers(-100, 100), st.integers(-50, 50)),
    min_size=1,
    max_size=4,
    unique_by=lambda point: point[0],
).map(sorted)


@given(POINTS, st.floats(-200.0, 200.0))
def test_the_curve_is_the_interpolation(points: list[tuple[int, int]], x: float) -> None:
    xs, values = zip(*points, strict=True)
    found = piecewise_linear(hinges_from_points(points), x)
    assert found == pytest.approx(float(np.interp(x, xs, values)), abs=1e-10)


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        ([], "one to four points; got 0"),
        ([(float(k), 1.0) for k in range(5)], "one to four points; got 5"),
        ([(1.0, 0.0), (1.0, 2.0)], "x must rise"),
        ([(2.0, 0.0), (1.0, 2.0)], "x must rise"),
        ([(0.0, math.nan)], "finite"),
        ([(math.inf, 1.0)], "finite"),
    ],
)
def test_a_bad_curve_gets_a_sentence(points: list[tuple[float, float]], sentence: str) -> None:
    with pytest.raises(RailgripError, match=sentence):
        hinges_from_points(points)
