"""FASTSIM against two other programs, the table, and the formula that it tends to."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable
from pathlib import Path

import pytest

from railgrip.compiler import compiled
from railgrip.contact.fastsim_1982 import fastsim_1982, fastsim_elliptic_1982
from railgrip.contact.fastsim_grid import fastsim_on_grid, flexibilities
from railgrip.contact.freibauer_1983 import freibauer_1983
from railgrip.contact.modified_fastsim_2013 import SlopeReduction, modified_fastsim
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, rolling_contact

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
RAIL = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
LIMIT = 30e3
LINES = [
    line
    for line in (Path(__file__).parent / "longitudinal.csv").read_text("utf-8").splitlines()
    if not line.startswith("#")
]
POINTS = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(LINES)]
TABLE = {5e-4: 0.2223, 1e-3: 0.4077, 2e-3: 0.6822, 3e-3: 0.8521, 4e-3: 0.9450, 5e-3: 0.9864}
CAP = {1e-3: 0.442801, 2e-3: 0.720644, 3e-3: 0.857352, 5e-3: 0.954022}
_on_grid = compiled(fastsim_on_grid)


def share(creepage: float, cells: int, is_elliptic: bool) -> float:
    """Longitudinal force over μQ."""
    along = Creepage(creepage, 0.0, 0.0)
    force = _on_grid(BASE, LIMIT, flexibilities(BASE), along, cells, is_elliptic)
    return float(force[0]) / LIMIT


@pytest.mark.parametrize(("creepage", "published"), TABLE.items())
@pytest.mark.parametrize("cells", [50, 400])
def test_the_table_with_a_parabolic_bound(creepage: float, published: float, cells: int) -> None:
    assert share(creepage, cells, False) == pytest.approx(published, abs=5e-4)


def test_an_independent_program_with_a_parabolic_bound() -> None:
    for point in POINTS:
        ours = share(point["creepage"], 400, False) * LIMIT
        assert ours == pytest.approx(point["own_parabolic"], abs=2e-5 * LIMIT)


@pytest.mark.parametrize(
    ("column", "law"),
    [("contact_parabolic", fastsim_1982), ("contact_elliptic", fastsim_elliptic_1982)],
)
def test_fastsim_as_contact_has_it(column: str, law: Callable[..., CreepForce]) -> None:
    for point in POINTS:
        force = law(BASE, RAIL, 20.0, Creepage(point["creepage"], 0.0, 0.0))
        assert force.longitudinal == pytest.approx(point[column], abs=0.008 * LIMIT)


@pytest.mark.parametrize(("creepage", "published"), CAP.items())
def test_an_elliptic_bound_tends_to_caps_formula(creepage: float, published: float) -> None:
    assert share(creepage, 400, True) == pytest.approx(published, abs=3e-6)
    assert freibauer_1983(
        RAIL, BASE.load, BASE.shear_modulus * BASE.a * BASE.b * BASE.c11, 0.0, creepage
    ) / LIMIT == pytest.approx(published, abs=1e-6)


@pytest.mark.parametrize("is_elliptic", [False, True])
@pytest.mark.parametrize(
    "creepage", [(2e-3, 1e-3, 0.3), (3e-3, -3e-3, 0.5), (0.0, 0.0, 2.0), (1e-4, -3e-3, 0.6)]
)
def test_fifty_cells_are_near_the_limit(
    creepage: tuple[float, float, float], is_elliptic: bool
) -> None:
    """Spin and creepages together: the forces of 50 and of 100 cells beside those of 400."""
    forces = [
        _on_grid(BASE, LIMIT, flexibilities(BASE), Creepage(*creepage), cells, is_elliptic)
        for cells in (50, 100, 400)
    ]
    coarse, finer = (
        math.hypot(force[0] - forces[2][0], force[1] - forces[2][1]) / LIMIT for force in forces[:2]
    )
    assert coarse < 3e-4
    assert finer < 1e-4


def test_modified_fastsim_without_reduction_is_fastsim() -> None:
    creepage, none = Creepage(3e-3, -1e-3, 0.5), SlopeReduction(1.0, 1.0, 0.64)
    modified = modified_fastsim(BASE, RAIL, 20.0, creepage, none)
    assert modified == pytest.approx(fastsim_1982(BASE, RAIL, 20.0, creepage), rel=1e-12)
