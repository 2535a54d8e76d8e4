"""A table against its law: as near as it says, for any load, speed and rail, or a clear word."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.fastsim_1982 import fastsim_1982
from railgrip.contact.polach_2005 import polach_rolling
from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005, RailFriction
from railgrip.contact.rolling_contact import (
    Creepage,
    CreepForce,
    RollingContact,
    rolling_contact,
)
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_rolling
from railgrip.core.errors import RailgripError
from railgrip.laboratory.creep_table import CreepTable
from railgrip.laboratory.laws_over_arrays import rescaled
from railgrip.laboratory.tabulate import tabulate

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)


def difference(table: CreepTable, law: Any, points: int, rail: RailFriction | None = None) -> float:
    """Greatest difference over random loads, rails, speeds and creepages, in shares of μQ."""
    draw = np.random.default_rng(3)
    found = 0.0
    for _ in range(points):
        load = float(draw.uniform(60e3, 140e3))
        own = table.rail
        here = rail or RailFriction(
            float(draw.uniform(0.02, 0.6)), float(draw.uniform(0.3, 1.0)),
            float(draw.uniform(0.0, 0.8)), own.adhesion_reduction, own.slip_reduction,
        )  # fmt: skip
        speed, creepage = float(draw.uniform(1.0, 60.0)), float(10.0 ** draw.uniform(-6, 0))
        force = law(
            rescaled(BASE, load), here, speed, Creepage(creepage, table.lateral, table.spin)
        ).longitudinal
        slip = speed * math.hypot(creepage, table.lateral)
        limit = load * falling_friction(here, slip)
        found = max(found, abs(table.force(load, here, speed, creepage) - force) / limit)
    return found


@pytest.mark.parametrize("rail", [DRY_POLACH_2005, WET_POLACH_2005])
def test_polach_within_a_millionth(rail: RailFriction) -> None:
    table = tabulate("polach_2005", BASE, rail)
    assert table.error < 1e-6
    assert difference(table, polach_rolling, 300) < 1e-6
    assert table.is_one_curve
    assert table.reads_reduction


def test_fastsim_as_it_says() -> None:
    """FASTSIM's cells make its curve a polygon of a sort, which no spline follows wholly."""
    table = tabulate("fastsim_1982", BASE, COULOMB)
    assert 1e-7 < table.error < 2e-5
    assert difference(table, fastsim_1982, 40) < 2.0 * table.error
    assert not table.reads_reduction


@pytest.mark.parametrize("law", [shen_hedrick_elkins_rolling, polach_rolling])
def test_lateral_creepage_for_every_load_and_rail(law: Any) -> None:
    table = tabulate(law, BASE, COULOMB, lateral=0.004)
    assert table.error < 1e-4
    assert difference(table, law, 300) < 2.0 * table.error


def test_spin_for_every_load_and_rail() -> None:
    table = tabulate(shen_hedrick_elkins_rolling, BASE, COULOMB, spin=-0.6)
    assert table.axis.by_friction == 1.0
    assert table.error < 1e-6
    assert difference(table, shen_hedrick_elkins_rolling, 300) < 2.0 * table.error


def test_lateral_creepage_with_spin_says_what_the_load_costs() -> None:
    table = tabulate("shen_hedrick_elkins_1983", BASE, COULOMB, lateral=0.002, spin=0.3)
    assert 1e-3 < table.error < 0.03
    at_reference = table._replace(contact=BASE)
    for friction in (0.05, 0.3):
        rail = COULOMB._replace(static_friction=friction)
        force = shen_hedrick_elkins_rolling(BASE, rail, 20.0, Creepage(0.001, 0.002, 0.3))
        read = at_reference.force(100e3, rail, 20.0, 0.001)
        assert read == pytest.approx(force.longitudinal, abs=1e-4 * friction * 100e3)


def with_local_fall(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Half the patch slips at the speed of the centre, half at a third of it."""
    size = abs(creepage.longitudinal)
    linear = contact.shear_modulus * contact.a * contact.b * contact.c11 * size / contact.load
    force = 0.0
    for share in (1.0, 1.0 / 3.0):
        friction = falling_friction(rail, share * speed * size)
        force += 0.5 * contact.load * friction * linear / (friction + linear)
    return CreepForce(math.copysign(force, creepage.longitudinal), 0.0, 0.0)


def test_a_fall_of_friction_in_each_point() -> None:
    """One curve cannot hold it and says so; an axis of the fall can, for any μ0, B, speed, load."""
    rail = RailFriction(0.3, 0.4, 0.5, 1.0, 1.0)
    assert tabulate(with_local_fall, BASE, rail).error > 0.1
    table = tabulate(with_local_fall, BASE, rail, is_local=True, cells=128, curves=33)
    assert table.error < 3e-3
    fine = tabulate(with_local_fall, BASE, rail, is_local=True, cells=128, curves=65)
    assert fine.error < 0.3 * table.error
    for other in (rail, RailFriction(0.08, 0.4, 0.2, 1.0, 1.0)):
        assert difference(table, with_local_fall, 200, other) < 2.0 * table.error
    with pytest.raises(RailgripError, match=r"another state of the rail: friction_ratio; got 0\.5"):
        table.force(100e3, rail._replace(friction_ratio=0.5), 20.0, 0.01)


def test_a_law_from_python_is_asked_point_by_point_and_tells_how_far_it_is() -> None:
    heard: list[float] = []
    asked = 0

    def slow(
        contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
    ) -> CreepForce:
        nonlocal asked
        asked += 1
        return shen_hedrick_elkins_rolling(contact, rail, speed, creepage)

    table = tabulate(slow, BASE, COULOMB, progress=heard.append)
    assert table.law == "slow"
    assert table.error < 1e-4
    assert asked == len(heard) < 400
    assert heard == sorted(heard)
    assert heard[-1] == 1.0


def test_the_same_bits_whether_compiled_or_not() -> None:
    def plain(*arguments: Any) -> CreepForce:
        return polach_rolling(*arguments)

    compiled = tabulate("polach_2005", BASE, WET_POLACH_2005, cells=32)
    by_point = tabulate(plain, BASE, WET_POLACH_2005, cells=32)
    assert compiled.curves.tobytes() == by_point.curves.tobytes()


def nothing(*arguments: Any) -> CreepForce:
    return CreepForce(math.nan, 0.0, 0.0)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"contact": BASE._replace(load=0.0)}, "the load must be positive and finite; got 0 N"),
        ({"contact": BASE._replace(a=math.nan)}, "the semi-axis along the track must be positive"),
        ({"rail": COULOMB._replace(static_friction=0.0)}, "the friction coefficient must be posit"),
        ({"lateral": math.nan}, "the lateral creepage must be finite"),
        ({"spin": math.inf}, "the spin must be finite"),
        ({"cells": 4}, "cells must be at least 8; got 4"),
        ({"curves": 1}, "curves must be at least 2; got 1"),
        ({"is_local": True}, "the decay of the friction with the slip speed must be positive"),
        ({"law": "fastsim"}, "did you mean 'fastsim_1982'"),
        ({"law": "kalker_linear"}, "the law gives more than friction allows"),
        ({"law": nothing}, "the law gave no finite force; got nan at creepage"),
    ],
)
def test_bad_input(change: dict[str, Any], sentence: str) -> None:
    given: dict[str, Any] = {"law": "freibauer_1983", "contact": BASE, "rail": COULOMB, **change}
    with pytest.raises(RailgripError, match=sentence):
        tabulate(given.pop("law"), given.pop("contact"), given.pop("rail"), **given)


def test_bad_places() -> None:
    table = tabulate("polach_2005", BASE, COULOMB, cells=32)
    with pytest.raises(RailgripError, match="the load must be positive and finite; got 0 N"):
        table.force(0.0, COULOMB, 20.0, 0.01)
    with pytest.raises(RailgripError, match="the speed must be positive and finite; got nan m/s"):
        table.force(1e5, COULOMB, math.nan, 0.01)
    with pytest.raises(RailgripError, match="the longitudinal creepage must be finite; got nan"):
        table.force(1e5, COULOMB, 20.0, math.nan)
    with pytest.raises(RailgripError, match="another state of the rail: adhesion_reduction"):
        table.force(1e5, WET_POLACH_2005, 20.0, 0.01)
