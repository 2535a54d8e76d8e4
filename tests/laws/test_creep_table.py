"""What a table of a creep law must obey, as the law itself does."""

from __future__ import annotations

import math
from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.core import registry
from railgrip.laboratory.creep_table import CreepTable
from railgrip.laboratory.tabulate import tabulate

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
NAMES = ("fastsim_1982", "fastsim_elliptic_1982", "modified_fastsim_2013", "polach_2005")
every_table = pytest.mark.parametrize(
    ("name", "lateral"), [(name, lateral) for name in NAMES for lateral in (0.0, 0.003)]
)

RAILS = st.builds(
    RailFriction,
    st.floats(0.0, 0.8), st.floats(0.2, 1.0), st.floats(0.0, 1.0), st.just(1.0), st.just(1.0),
)  # fmt: skip
LOADS, SPEEDS = st.floats(1e3, 2e5), st.floats(0.01, 80.0)
CREEPAGES = st.just(0.0) | st.floats(-7.0, 0.0).map(lambda power: 10.0**power)


@cache
def table_of(name: str, lateral: float) -> CreepTable:
    return tabulate(name, BASE, COULOMB, lateral=lateral)


@every_table
@given(load=LOADS, rail=RAILS, speed=SPEEDS, creepage=CREEPAGES)
def test_odd_bounded_and_passive(
    name: str, lateral: float, load: float, rail: RailFriction, speed: float, creepage: float
) -> None:
    table = table_of(name, lateral)
    force = table.force(load, rail, speed, creepage)
    assert table.force(load, rail, speed, -creepage) == -force
    limit = load * falling_friction(rail, speed * math.hypot(creepage, lateral))
    assert 0.0 <= force <= limit * (1.0 + 1e-12)


@every_table
@given(load=LOADS, rail=RAILS, speed=SPEEDS, creepage=CREEPAGES)
def test_continuous(
    name: str, lateral: float, load: float, rail: RailFriction, speed: float, creepage: float
) -> None:
    """A step of a millionth of μQ by linear theory moves the force by no more than a few."""
    table = table_of(name, lateral)
    limit = load * falling_friction(rail, speed * math.hypot(creepage, lateral))
    step = 1e-6 * limit / table.slope(load)
    falls = rail.friction_decay * speed * step * load * rail.static_friction
    before = table.force(load, rail, speed, creepage)
    after = table.force(load, rail, speed, creepage + step)
    assert abs(after - before) <= 3e-6 * limit + 2.0 * falls + 1e-12 * load


@every_table
def test_the_slope_at_zero_is_the_laws(name: str, lateral: float) -> None:
    law = registry.resolve("railgrip.rolling_laws", name)
    table = table_of(name, lateral)
    for friction in (0.05, 0.4):
        rail = COULOMB._replace(static_friction=friction)
        little = 1e-6 * friction * BASE.load / table.slope(BASE.load)
        force = law(BASE, rail, 20.0, Creepage(little, lateral, 0.0)).longitudinal
        assert table.force(BASE.load, rail, 20.0, little) == pytest.approx(force, rel=1e-3)


@every_table
@given(rail=RAILS, creepage=CREEPAGES)
def test_slope_and_force_of_a_steady_wheel(
    name: str, lateral: float, rail: RailFriction, creepage: float
) -> None:
    """Without friction there is no force, and at no creepage either."""
    table = table_of(name, lateral)
    none = rail._replace(static_friction=0.0)
    assert table.force(1e5, none, 20.0, creepage) == 0.0
    assert table.force(1e5, rail, 20.0, 0.0) == 0.0
