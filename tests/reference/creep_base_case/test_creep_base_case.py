"""Creep curves against another program's formulas and against the exact theory."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import pytest

from railgrip.contact.freibauer_1983 import freibauer_1983, freibauer_rolling
from railgrip.contact.kalker_1990 import kalker_slope
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.contact.shen_hedrick_elkins_1983 import (
    shen_hedrick_elkins_1983,
    shen_hedrick_elkins_rolling,
)

LOAD = 100e3
RAIL = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
LIMIT = 0.3 * LOAD
LINES = [
    line
    for line in (Path(__file__).parent / "longitudinal.csv").read_text("utf-8").splitlines()
    if not line.startswith("#")
]
POINTS = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(LINES)]
LAWS = {
    "freibauer": (freibauer_1983, 0.052),
    "shen_hedrick_elkins": (shen_hedrick_elkins_1983, 0.022),
}


@pytest.fixture(scope="module")
def slope() -> float:
    return kalker_slope(LOAD, 0.46, math.inf, 0.3, 210e9, 0.28)


@pytest.mark.parametrize("name", LAWS)
def test_the_formula_agrees_with_another_program(name: str, slope: float) -> None:
    law, _ = LAWS[name]
    for point in POINTS:
        force = law(RAIL, LOAD, slope, 0.0, point["creepage"])
        assert force == pytest.approx(point[name], abs=1e-6 * LIMIT, rel=1e-6)


@pytest.mark.parametrize(
    ("name", "law"),
    [("freibauer", freibauer_rolling), ("shen_hedrick_elkins", shen_hedrick_elkins_rolling)],
)
def test_the_same_through_the_contract_of_rolling_contact(name: str, law: Any) -> None:
    contact = rolling_contact(LOAD, 0.46, math.inf, 0.3, 210e9, 0.28)
    for point in POINTS:
        force = law(contact, RAIL, 20.0, Creepage(-point["creepage"], 0.0, 0.0))
        assert force.longitudinal == pytest.approx(-point[name], abs=1e-6 * LIMIT, rel=1e-6)
        assert force.lateral == force.spin_moment == 0.0


@pytest.mark.parametrize("name", LAWS)
def test_the_formula_stays_near_the_exact_theory(name: str, slope: float) -> None:
    law, share = LAWS[name]
    off = [law(RAIL, LOAD, slope, 0.0, point["creepage"]) - point["contact"] for point in POINTS]
    assert max(abs(each) for each in off) < share * LIMIT


@pytest.mark.parametrize(
    ("creepage", "share"), [(1e-3, 0.442801), (2e-3, 0.720644), (3e-3, 0.857352), (5e-3, 0.954022)]
)
def test_the_published_values_of_cap(creepage: float, share: float, slope: float) -> None:
    assert freibauer_1983(RAIL, LOAD, slope, 0.0, creepage) / LIMIT == pytest.approx(
        share, abs=1e-6
    )
    assert polach_2005(RAIL, LOAD, slope, 0.0, creepage) / LIMIT == pytest.approx(share, abs=1e-6)
