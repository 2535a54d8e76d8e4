"""The spline under a creep table: exact where it must be, smooth, and deaf to bad places."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from railgrip.laboratory.creep_spline import (
    cell_of,
    chord_by_table,
    places_between,
    sample_places,
    spline_coefficients,
    spline_value,
)


def value(coefficients: np.ndarray, u: float) -> float:
    cells = len(coefficients) - 2
    cell = int(cell_of(u * cells, float(cells)))
    return spline_value(*coefficients[cell : cell + 3].tolist(), u * cells - cell)


def spline_of(curve: Callable[[np.ndarray], np.ndarray], cells: int) -> np.ndarray:
    return spline_coefficients(curve(sample_places(cells)))


def test_a_parabola_is_met_exactly() -> None:
    def curve(u: np.ndarray) -> np.ndarray:
        return 2.0 - 3.0 * u + 0.7 * u * u

    found = spline_of(curve, 8)
    for u in np.linspace(0.0, 1.0, 41):
        assert value(found, float(u)) == pytest.approx(curve(u), abs=1e-14)


def test_halving_the_cells_divides_the_error_by_eight() -> None:
    places = places_between(16)
    errors = []
    for cells in (16, 32, 64):
        found = spline_of(np.exp, cells)
        places = places_between(cells)
        errors.append(max(abs(value(found, u) - math.exp(u)) for u in places.tolist()))
    assert errors[0] / errors[1] == pytest.approx(8.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(8.0, rel=0.1)


def test_value_and_slope_are_continuous_at_the_knots() -> None:
    cells = 16
    draw = np.random.default_rng(1)
    found = spline_coefficients(draw.uniform(0.0, 1.0, cells + 2))
    for knot in range(1, cells):
        before, after = found[knot - 1 : knot + 2], found[knot : knot + 3]
        assert spline_value(*before, 1.0) == pytest.approx(spline_value(*after, 0.0), abs=1e-14)
        # the derivatives there are differences of coefficients
        step = 1e-6
        left = (spline_value(*before, 1.0) - spline_value(*before, 1.0 - step)) / step
        right = (spline_value(*after, step) - spline_value(*after, 0.0)) / step
        assert left == pytest.approx(right, abs=1e-4)


def test_no_place_leads_out_of_the_table() -> None:
    table = spline_coefficients(np.ones(10))
    for limit, slope, creepage in (
        (0.0, 1e7, 0.1), (1e5, 1e7, 0.0), (0.0, 0.0, 0.0), (1e5, 1e7, 1e300), (1e300, 1e7, 1e-9),
    ):  # fmt: skip
        chord = chord_by_table(table, limit, slope, creepage)
        assert math.isfinite(chord)
        assert 0.0 <= chord <= slope
    for bad in (math.nan, math.inf, -math.inf):
        assert 0 <= int(cell_of(bad, 8.0)) < 8
    assert math.isnan(chord_by_table(table, math.nan, 1e7, 0.1))
