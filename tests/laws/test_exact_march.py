"""Rolling on from rest: towards the steady state, within friction, and in parts as in one."""

from __future__ import annotations

import math

import numpy as np
import pytest

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.laboratory.exact import solve_exact
from railgrip.laboratory.exact_march import march_exact

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
FALLING = RailFriction(0.5, 0.4, 0.8, 1.0, 1.0)
GRID = (14, 14)


@pytest.mark.parametrize("rail", [COULOMB, FALLING])
@pytest.mark.parametrize(
    "creepage", [Creepage(4e-3, 0, 0), Creepage(2e-3, -2e-3, 0.3), Creepage(0, 0, 1.0)]
)
def test_it_ends_in_the_steady_state(rail: RailFriction, creepage: Creepage) -> None:
    steady = solve_exact(BASE, rail, 20.0, creepage, grid=GRID)
    march = march_exact(BASE, rail, 20.0, [creepage] * 70, grid=GRID)
    assert march.is_converged.all()
    assert list(march.last.force[:2]) == pytest.approx(list(steady.force[:2]), abs=10.0)
    stay = march_exact(BASE, rail, 20.0, [creepage] * 2, grid=GRID, start=steady)
    assert list(stay.last.force) == pytest.approx(list(steady.force), rel=1e-4, abs=1.0)


@pytest.mark.parametrize(("creepage", "lead"), [(1e-6, 0.21), (1e-3, 0.16)])
def test_the_relaxation_law_leads(creepage: float, lead: float) -> None:
    march = march_exact(BASE, COULOMB, 20.0, [Creepage(creepage, 0, 0)] * 60, grid=(44, 44))
    steady = solve_exact(BASE, COULOMB, 20.0, Creepage(creepage, 0, 0), grid=(44, 44))
    force = np.array([each.longitudinal for each in march.forces]) / steady.force.longitudinal
    law = 1.0 - np.exp(-march.distance / (8.0 * BASE.a / (3.0 * math.pi)))
    assert np.all(np.diff(force) > 0.0)
    assert (law - force).max() == pytest.approx(lead, abs=0.015)
    assert force[-1] > 0.9


def test_never_beyond_friction_while_creepage_changes() -> None:
    creepages = [Creepage(6e-3 * math.sin(0.4 * step), 3e-3, 0.5) for step in range(40)]
    march = march_exact(BASE, COULOMB, 20.0, creepages, grid=GRID)
    assert march.is_converged.all()
    for force in march.forces:
        assert math.hypot(force.longitudinal, force.lateral) <= 30e3 * (1 + 1e-6)


def test_in_parts_as_in_one() -> None:
    creepages = [Creepage(1e-3 * step, 0.0, 0.1) for step in range(10)]
    whole = march_exact(BASE, FALLING, 20.0, creepages, grid=GRID)
    first = march_exact(BASE, FALLING, 20.0, creepages[:4], grid=GRID)
    second = march_exact(BASE, FALLING, 20.0, creepages[4:], grid=GRID, start=first.last)
    assert list(second.last.force) == pytest.approx(list(whole.last.force), rel=1e-6)
    assert second.distance[-1] + first.distance[-1] == pytest.approx(whole.distance[-1])
