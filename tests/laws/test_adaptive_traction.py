"""Macro- and micro-slip while driving: the way through figure 2, and what each choice is worth."""

from __future__ import annotations

import importlib.util
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from tests.agreement.test_adaptive_states import way
from tests.agreement.test_plain_and_compiled import OnlyPlain, assert_same

import railgrip as rg
from railgrip.control.adaptive_traction import AdaptiveTraction
from railgrip.control.contract import MACRO, MICRO
from railgrip.control.conventional_wsp import ConventionalWSP
from railgrip.control.peak_seeking_traction import PeakSeekingTraction
from railgrip.core.errors import RailgripError

IN_MACRO = [301, 302, 303]
DECIDES = [304, 305, 306]
TEST = [307, 308, 309, 310]
FAILS = [311, 312, 313, 314]
ALWAYS_MACRO = {"start": 2.0, "decide_distance": 1e9}
ALWAYS_MICRO = {"start": 1.0, "test_pause": 1e9}
UNIT_AXLES = [0, 1, 14, 15]


PATH = Path(__file__).parents[2] / "studies/traction_start.py"
SPEC = importlib.util.spec_from_file_location("traction_start", PATH)
assert SPEC is not None
assert SPEC.loader is not None
STUDY = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(STUDY)
LEAVES, OIL = "unit, leaves, 5 ‰", "locomotive, oil, level"
CHANGING = {"patch": [{"from": "505 m", "to": "2 km", "condition": "leaves"}]}


@cache
def start(case: str, is_changing: bool = False, **given: float) -> rg.Result:
    scenario = STUDY.start(case)
    if is_changing:
        scenario = scenario.with_({"rail": {"condition": "oil", **CHANGING}})
    parameters = AdaptiveTraction().parameters._replace(**given)
    return rg.simulate(scenario, controller=AdaptiveTraction(parameters))


def covered(result: rg.Result) -> float:
    return float(result["covered_distance"].values[0])


def test_rail_that_sliding_does_not_clean() -> None:
    """Leaves: macro-slip falls short of the force at breakaway, and the test axle fails."""
    result = start(LEAVES)
    numbers = way(result)
    assert numbers[:14] == [*IN_MACRO, *DECIDES, *TEST, *FAILS]
    assert 301 not in numbers[1:]
    assert result["slip_range"].values[0][UNIT_AXLES, -1].tolist().count(MICRO) >= 3
    assert covered(start(LEAVES, **ALWAYS_MACRO)) < 0.75 * covered(result)
    assert covered(result) > 0.94 * covered(start(LEAVES, **ALWAYS_MICRO))


def test_rail_that_sliding_cleans() -> None:
    """Oil: the mean force passes that at breakaway, decision after decision."""
    result = start(OIL)
    numbers = way(result)
    assert numbers[:12] == [*IN_MACRO, *DECIDES, *IN_MACRO, *DECIDES]
    assert covered(start(OIL, **ALWAYS_MICRO)) < 0.95 * covered(result)
    assert covered(result) > 0.97 * covered(start(OIL, **ALWAYS_MACRO))


def test_rail_that_changes_under_way() -> None:
    """Oil where the train stands, leaves before it: macro first, then micro."""
    result = start(OIL, is_changing=True)
    numbers = way(result)
    there = numbers.index(307)
    assert numbers[:7] == [*IN_MACRO, *DECIDES, 301]
    assert numbers[there - 3 : there + 4] == [*DECIDES, *TEST]
    place = result["train_position"].values[0][np.argmax(result["wsp_state"].values[0] == 307)]
    assert 505.0 < place < 530.0


def test_in_micro_slip_it_is_the_peak_seeker_to_the_bit() -> None:
    ours = start(LEAVES, **ALWAYS_MICRO)
    theirs = rg.simulate(ours.scenario, controller=PeakSeekingTraction())
    assert np.array_equal(ours["wheel_speed"].values, theirs["wheel_speed"].values)


def test_in_macro_slip_wheels_spin_as_fast_as_asked() -> None:
    result = start(LEAVES, macro_slip_floor=1.5, **ALWAYS_MACRO)
    spin = (result["wheel_speed"] - result["train_speed"]).values[0][UNIT_AXLES]
    late = result["time"].values > 20.0
    slip = np.maximum(1.5, 0.2 * result["train_speed"].values[0][late])
    assert np.abs(spin[:, late] / slip - 1.0).max() < 0.1


def test_braking_is_the_ordinary_protection_to_the_bit() -> None:
    stop = rg.load("coach_leaves").with_({"run.speed": "80 km/h"})
    mine = rg.simulate(stop, controller=AdaptiveTraction())
    ordinary = rg.simulate(stop, controller=ConventionalWSP())
    assert np.array_equal(mine["wheel_speed"].values, ordinary["wheel_speed"].values)


def test_plain_and_compiled() -> None:
    scenario = rg.load("start_leaves").with_({"run.duration": "25 s"})
    compiled = rg.simulate(scenario, controller=AdaptiveTraction())
    assert compiled["wsp_state"].values.max() >= 307
    assert (compiled["slip_range"].values == MACRO).any()
    assert_same(rg.simulate(scenario, controller=OnlyPlain(AdaptiveTraction())), compiled)


def test_energy_closes() -> None:
    assert abs(float(start(LEAVES)["energy_balance"].values[0])) < 1e-6


@pytest.mark.parametrize(("name", "value"), [("start", 1.5), ("macro_slip", 0.0), ("rule", 7.0)])
def test_what_no_train_can_mean_is_refused(name: str, value: float) -> None:
    with pytest.raises(RailgripError, match=name):
        AdaptiveTraction(AdaptiveTraction().parameters._replace(**{name: value}))
