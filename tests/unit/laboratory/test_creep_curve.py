"""The four forms of a creep curve, its peak, branches and slope, and what it refuses."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import DRY_POLACH_2005, RailFriction
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_1983
from railgrip.core.errors import RailgripError
from railgrip.laboratory.creep_curve import CreepCurve, creep_curve
from railgrip.laboratory.curve_of_law import curve_of_plant_law

SLOPE = 14.523733e6
WHERE = [0.0, 0.01, 0.02, 0.05]
FORCE = [0.0, 10e3, 12e3, 9e3]


@given(speed=st.floats(0.1, 100.0), load=st.floats(1e3, 2e5))
def test_all_four_forms_are_one_curve(speed: float, load: float) -> None:
    first = creep_curve(speed=speed, load=load, creepage=WHERE, force=FORCE)
    for where in ({"creepage": first.creepage}, {"slip_speed": first.slip_speed}):
        for much in ({"force": first.force}, {"adhesion": first.adhesion}):
            again = creep_curve(speed=speed, load=load, **where, **much)
            assert again.creepage == pytest.approx(first.creepage, rel=1e-14)
            assert again.force == pytest.approx(first.force, rel=1e-14)
    assert first.slip_speed == pytest.approx(speed * np.array(WHERE))
    assert first.adhesion == pytest.approx(np.array(FORCE) / load)


def test_the_peak_lies_between_the_points() -> None:
    curve = creep_curve(
        speed=10.0, load=50e3, creepage=[0.0, 0.01, 0.03, 0.04],
        force=lambda s: 12e3 - 4e7 * (s - 0.018) ** 2,
    )  # fmt: skip
    assert curve.peak.creepage == pytest.approx(0.018)
    assert curve.peak.slip_speed == pytest.approx(0.18)
    assert curve.peak.force == pytest.approx(12e3)
    assert curve.peak.adhesion == pytest.approx(0.24)
    assert not curve.peak.is_at_the_end


def test_the_peak_of_polach_is_found_whatever_the_grid() -> None:
    fine, coarse = (
        curve_of_plant_law(
            polach_2005, DRY_POLACH_2005, load=100e3, slope=SLOPE, speed=20.0,
            creepage=np.geomspace(1e-5, 1.0, count),
        ).peak
        for count in (5001, 101)
    )  # fmt: skip
    assert coarse.force == pytest.approx(fine.force, rel=1e-4)
    assert coarse.creepage == pytest.approx(fine.creepage, rel=0.02)


def test_a_curve_that_only_rises_has_its_peak_at_the_end() -> None:
    curve = creep_curve(speed=10.0, load=50e3, creepage=[0.0, 0.1], force=[0.0, 1.0])
    assert curve.peak.is_at_the_end
    assert curve.ineffective_branch.force.tolist() == [1.0]


def test_the_branches_share_the_greatest_point() -> None:
    curve = creep_curve(speed=10.0, load=50e3, creepage=WHERE, force=FORCE)
    assert curve.effective_branch.force.tolist() == [0.0, 10e3, 12e3]
    assert curve.ineffective_branch.force.tolist() == [12e3, 9e3]


def test_the_creepage_of_an_adhesion() -> None:
    curve = creep_curve(speed=10.0, load=50e3, creepage=WHERE, force=FORCE)
    assert curve.creepage_at(0.1) == pytest.approx(0.005)
    assert curve.creepage_at(0.0) == 0.0
    assert np.isnan(curve.creepage_at(0.25))


@pytest.mark.parametrize("law", [polach_2005, shen_hedrick_elkins_1983])
def test_the_initial_slope_is_that_of_the_law(law: Any) -> None:
    rail = RailFriction(0.3, 0.4, 0.6, 1.0, 1.0)
    curve = curve_of_plant_law(law, rail, load=100e3, slope=SLOPE, speed=20.0)
    assert curve.initial_slope == pytest.approx(SLOPE, rel=1e-5)


def test_the_friction_of_the_rail_given_as_a_law_gives_the_same_curve() -> None:
    from railgrip.contact.exponential_friction import exponential_friction

    case: dict[str, float] = {"load": 100e3, "slope": SLOPE, "speed": 20.0}
    own = curve_of_plant_law(polach_2005, DRY_POLACH_2005, **case)
    given_as_law = curve_of_plant_law(
        polach_2005, DRY_POLACH_2005, **case,
        friction=lambda w: exponential_friction(DRY_POLACH_2005, w, 20.0),
    )  # fmt: skip
    assert given_as_law.force == pytest.approx(own.force, rel=1e-13)


def test_the_columns_come_back_from_the_file(tmp_path: Path) -> None:
    curve = creep_curve(speed=10.0, load=50e3, creepage=WHERE, force=FORCE)
    text = curve.to_csv(tmp_path / "curve.csv").read_text("utf-8").splitlines()
    assert text[0] == "slip_speed_m_s,creepage,force_N,adhesion"
    table = np.array([[float(cell) for cell in line.split(",")] for line in text[1:]])
    columns = [curve.slip_speed, curve.creepage, curve.force, curve.adhesion]
    assert table == pytest.approx(np.column_stack(columns), rel=1e-8)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"speed": 0.0}, "speed: must be positive and finite; got 0.0 m/s"),
        ({"speed": float("nan")}, "speed: must be positive and finite; got nan m/s"),
        ({"load": -1.0}, "load: must be positive"),
        ({"creepage": []}, "creepage: must have at least one point"),
        ({"creepage": [0.1, 0.1, 0.2, 0.3]}, "creepage: must rise"),
        ({"creepage": [-0.1, 0.1, 0.2, 0.3]}, "creepage: must rise"),
        ({"creepage": [0.0, float("nan"), 0.2, 0.3]}, "creepage: point 2 is not a finite number"),
        ({"creepage": [[0.0, 0.1]]}, "creepage: must be one row"),
        ({"creepage": ["much"]}, "creepage: must be a row of numbers"),
        ({"creepage": [0.0, 0.1]}, "force: must have as many points as the creepage; got 4 and 2"),
        ({"slip_speed": WHERE}, "give creepage or slip_speed, not both"),
        ({"adhesion": FORCE}, "give either force or adhesion"),
        ({"force": None}, "give either force or adhesion"),
        ({"force": lambda s: float("nan")}, "force: point 1 is not a finite number"),
    ],
)
def test_bad_input_gets_a_sentence(change: dict[str, Any], words: str) -> None:
    case = {"speed": 10.0, "load": 50e3, "creepage": WHERE, "force": FORCE}
    with pytest.raises(RailgripError, match=words):
        creep_curve(**{**case, **change})


def test_one_point_has_no_slope() -> None:
    curve = CreepCurve(10.0, 50e3, np.array([0.0, 0.1]), np.array([0.0, 1.0]))
    with pytest.raises(RailgripError, match="needs two points"):
        _ = curve.initial_slope
