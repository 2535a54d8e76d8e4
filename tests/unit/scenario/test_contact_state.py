"""Load, speed, creepages and friction from words; pairs with changed numbers."""

from __future__ import annotations

import pytest

from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005
from railgrip.core.errors import RailgripError
from railgrip.scenario.changed_pair import changed_pair
from railgrip.scenario.contact_pair import contact_pair
from railgrip.scenario.contact_state import constant_friction_rail, contact_state, rail_friction


@pytest.mark.parametrize("word", ["0.5 1/m", "0.5/m", "0.5 rad/m", "0.5 m^-1", "0.0005 1/mm", 0.5])
def test_spin_is_read_in_any_spelling(word: object) -> None:
    assert contact_state({"spin": word}).spin == pytest.approx(0.5)


def test_words_become_si() -> None:
    state = contact_state(
        {"load": "100 kN", "speed": "72 km/h", "longitudinal": "-0.2 %", "lateral": "1 ‰"}
    )
    assert (state.load, state.speed) == (100e3, 20.0)
    assert (state.longitudinal, state.lateral) == (-0.002, 0.001)


def test_everything_that_is_wrong_is_told_at_once() -> None:
    with pytest.raises(RailgripError) as caught:
        contact_state({"load": 0.0, "speed": "0 km/h", "spin": float("nan"), "slip": 1.0})
    assert [problem.where for problem in caught.value.problems] == ["load", "speed", "spin", "slip"]


def test_friction_of_a_condition_is_what_the_first_wheel_finds() -> None:
    assert rail_friction("dry") == DRY_POLACH_2005
    assert rail_friction("wet") == WET_POLACH_2005
    with pytest.raises(RailgripError, match="did you mean 'leaves'"):
        rail_friction("leavs")


def test_constant_friction() -> None:
    assert constant_friction_rail("30 %") == (0.3, 1.0, 0.0, 1.0, 1.0)
    for wrong in (-0.1, float("nan"), "much"):
        with pytest.raises(RailgripError, match="static_friction"):
            constant_friction_rail(wrong)


def test_a_pair_changes_by_key() -> None:
    base = contact_pair("s1002_new")
    other = changed_pair(base, {"wheel.s1002_position": "8 mm", "young": "200 GPa"})
    assert (other.wheel.s1002_position, other.young) == (0.008, 200e9)
    assert other.rail == base.rail
    assert "changed" in other.title
    flat = changed_pair(base, {"wheel.s1002_position": None, "wheel.transverse_radius": 1.0})
    assert flat.wheel.transverse_radius == 1.0
    with pytest.raises(RailgripError, match="excludes"):
        changed_pair(base, {"wheel.transverse_radius": 1.0})
