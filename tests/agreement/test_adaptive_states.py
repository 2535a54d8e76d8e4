"""The adaptive protection in the plant: its way through figure 2, the same bits in both forms."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from tests.agreement.test_plain_and_compiled import OnlyPlain, assert_same

import railgrip as rg
from railgrip.control.adaptive_parameters import AdaptiveParameters
from railgrip.control.adaptive_states import TRANSITIONS
from railgrip.control.adaptive_wsp import AdaptiveWSP
from railgrip.control.contract import MACRO, MICRO, MIDDLE
from railgrip.control.fixed_ranges import MacroSlip, MixedSlip
from railgrip.core.status import RunStatus

WAYS = {(way.before, way.after) for way in TRANSITIONS}
IN_MACRO = [301, 302, 303]
DECIDES = [304, 305, 306]
TEST = [308, 309, 310]
FAILS = [311, 312, 313, 314]
SOURCE = {
    "rule": 0.0, "lead_axles": 0.0, "start": MACRO, "mean_time": 1.5, "decide_distance": 5.0,
    "test_distance": 5.0,
}  # fmt: skip


def stop(rail: dict[str, Any], **parameters: float) -> rg.Result:
    scenario = rg.load("leaves_160").with_({"rail": rail, "run.speed": "140 km/h"})
    result = rg.simulate(scenario, controller=AdaptiveWSP(AdaptiveParameters(**parameters)))
    assert result.status == RunStatus.STOPPED
    return result


def way(result: rg.Result) -> list[int]:
    """Return the states in their order, summing up (304, 305) until it is enough told once."""
    numbers = result["wsp_state"].values[0].astype(int)
    numbers = numbers[numbers > 0]
    changes = [int(numbers[0]), *(int(b) for a, b in pairwise(numbers) if b != a)]
    assert all(step in WAYS for step in pairwise(map(float, changes)))
    told = "-".join(map(str, changes)).replace("304-305-", "S").replace("SS", "S")
    while "SS" in told:
        told = told.replace("SS", "S")
    return [int(number) for number in told.replace("S", "304-305-").split("-")]


@pytest.mark.parametrize("parameters", [{}, SOURCE], ids=["lookout", "forces"])
def test_rail_that_recovers(parameters: dict[str, float]) -> None:
    """Sliding cleans: the system stays in macro-slip, decision after decision."""
    result = stop({"condition": "water_detergent"}, **parameters)
    numbers = way(result)
    assert numbers[:9] == [*IN_MACRO, *DECIDES, *IN_MACRO]
    assert set(numbers) == {*IN_MACRO, *DECIDES}
    begun = np.argmax(result["wsp_state"].values[0] == 306)
    assert (result["slip_range"].values[0][:, begun + 5 :] == MACRO).all()
    waited = MACRO if parameters else MIDDLE
    assert (result["slip_range"].values[0][2:, 5:begun] == waited).all()


@pytest.mark.parametrize("parameters", [{}, SOURCE], ids=["lookout", "forces"])
def test_rail_that_does_not(parameters: dict[str, float]) -> None:
    """Sliding does not help: to micro-slip, and the test there fails."""
    result = stop({"condition": "leaves"}, **parameters)
    numbers = way(result)
    begin = numbers.index(307)
    assert numbers[begin - 3 : begin] == DECIDES
    assert numbers[begin : begin + 8] == [307, *TEST, *FAILS]
    if not parameters:  # the lookout fails in every test; the forces let an axle pass now and then
        assert 301 not in numbers[begin:]
        assert 312 not in {b for a, b in pairwise(numbers) if a == 310}
        assert result["slip_range"].values[0][:, -1].tolist() == [MACRO] * 2 + [MICRO] * 14


def test_rail_that_changes_under_way() -> None:
    """Leaves, then detergent, then leaves: to micro, back to macro, to micro again."""
    patch = {"from": "500 m", "to": "700 m", "condition": "water_detergent"}
    result = stop({"condition": "leaves", "patch": [patch]})
    numbers = way(result)
    there = numbers.index(307)
    back = numbers.index(301, there)
    again = numbers.index(307, back)
    assert numbers[back - 6 : back] == [*TEST, 312, 313, 314]
    assert numbers[back : back + 3] == IN_MACRO
    assert numbers[again - 3 : again + 1] == [*DECIDES, 307]


@pytest.mark.parametrize("parameters", [{}, SOURCE, {**SOURCE, "decide": 1.0, "is_symmetric": 1.0}])
def test_plain_and_compiled(parameters: dict[str, float]) -> None:
    described = rg.load("coach_leaves").with_({"run.speed": "80 km/h"})
    controller = AdaptiveWSP(AdaptiveParameters(**parameters))
    compiled = rg.simulate(described, controller=controller)
    assert compiled["axle_valve_cycles"].values.sum() > 0
    assert compiled["wsp_state"].values.max() >= 307
    assert_same(rg.simulate(described, controller=OnlyPlain(controller)), compiled)


def test_mixed_slip_plain_and_compiled() -> None:
    described = rg.load("coach_leaves").with_({"run.speed": "60 km/h"})
    compiled = rg.simulate(described, controller=MixedSlip())
    assert_same(rg.simulate(described, controller=OnlyPlain(MixedSlip())), compiled)


def test_macro_slip_is_the_conventional_protection_to_the_bit() -> None:
    described = rg.load("detergent_160").with_({"run.speed": "80 km/h"})
    ours = rg.simulate(described, controller=MacroSlip())
    theirs = rg.simulate(described)
    for name in theirs.data:
        if name != "slip_range":
            assert np.array_equal(ours[name].values, theirs[name].values, equal_nan=True), name


def test_by_name_and_with_parameters_of_a_scenario() -> None:
    described = rg.load("coach_leaves").with_(
        {"wsp": {"controller": "adaptive", "parameters": {"rule": 0, "lead_axles": 0, "start": 2}}}
    )
    assert (rg.simulate(described)["wsp_state"].values >= 301).any()
    with pytest.raises(rg.RailgripError, match=r"decide_distanse.*decide_distance"):
        rg.simulate(described.with_({"wsp.parameters": {"decide_distanse": 3.0}}))
