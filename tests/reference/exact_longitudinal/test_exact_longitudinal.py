"""The exact solver against CONTACT on equal grids, extrapolated, and its order."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np
import pytest

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.laboratory.exact import refine_exact, solve_exact

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
RAIL = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
LIMIT = 30e3
LINES = [
    line
    for line in (Path(__file__).parent / "contact.csv").read_text("utf-8").splitlines()
    if not line.startswith("#")
]
POINTS = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(LINES)]


def along(creepage: float, cells: int) -> float:
    solution = solve_exact(BASE, RAIL, 20.0, Creepage(creepage, 0.0, 0.0), grid=(cells, cells))
    assert solution.is_converged
    return solution.force.longitudinal


@pytest.mark.parametrize("cells", [48, 96])
def test_the_same_force_on_the_same_cells(cells: int) -> None:
    for point in POINTS:
        assert along(point["creepage"], cells) == pytest.approx(point[f"grid_{cells}"], rel=1e-6)


def test_extrapolated_force() -> None:
    for point in POINTS:
        force, _ = refine_exact(BASE, RAIL, 20.0, Creepage(point["creepage"], 0.0, 0.0))
        assert force.longitudinal == pytest.approx(point["extrapolated"], abs=0.003 * LIMIT)


@pytest.mark.parametrize("creepage", [5e-4, 2e-3])
def test_the_error_falls_with_the_size_of_the_cells(creepage: float) -> None:
    cells = np.arange(12, 132, 8)
    force = np.array([along(creepage, int(count) + 4) for count in cells])
    rough = cells < 80
    _, true = np.polyfit(1.0 / cells[4:], force[4:], 1)
    off = np.abs(force[rough] / true - 1.0)
    order, _ = np.polyfit(np.log(1.0 / cells[rough]), np.log(off), 1)
    assert order > 0.95
