"""Pressure maps: the scalar forms on a grid, summing up to the load."""

from __future__ import annotations

import math

import pytest

from railgrip.contact.contact_pressure import elliptic_pressure, rectangular_pressure
from railgrip.contact.rectangular_patch import rectangular_patch
from railgrip.core.errors import RailgripError
from railgrip.core.formulas.patch import hertz_1882
from railgrip.laboratory.pressure_map import pressure_map

ELLIPSE = hertz_1882(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
STRIP = rectangular_patch(100e3, 0.46, 0.02, 210e9, 0.28)


def test_each_cell_holds_the_scalar_pressure() -> None:
    ellipse, strip = pressure_map(ELLIPSE, cells=7), pressure_map(STRIP, cells=7)
    for row in range(7):
        for column in range(7):
            x, y = float(ellipse.x[column]), float(ellipse.y[row])
            assert ellipse.pressure[row, column] == pytest.approx(elliptic_pressure(ELLIPSE, x, y))
            x, y = float(strip.x[column]), float(strip.y[row])
            assert strip.pressure[row, column] == pytest.approx(rectangular_pressure(STRIP, x, y))


@pytest.mark.parametrize(("patch", "area"), [
    (ELLIPSE, 4.0 * ELLIPSE.a * ELLIPSE.b),
    (STRIP, 2.0 * STRIP.a * STRIP.width),
])  # fmt: skip
def test_the_sum_is_the_load(patch: object, area: float) -> None:
    found = pressure_map(patch, cells=400)  # type: ignore[arg-type]
    assert found.pressure.mean() * area == pytest.approx(100e3, rel=1e-4)


@pytest.mark.parametrize("cells", [1, 0, -3, 5000])
def test_a_grid_without_sense_gets_a_sentence(cells: int) -> None:
    with pytest.raises(RailgripError, match=rf"number of cells is out of range; got {cells}"):
        pressure_map(ELLIPSE, cells)
