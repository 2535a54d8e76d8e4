"""Coasting in journeys: the driving law against the class, the exact run, and the optimum."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from railgrip.campaign.optimum.timetable import optimum
from railgrip.control.coasting.coasting_law import AnnouncedTarget, CoastingLaw, CoastingState
from railgrip.control.etcs.steps import Steps
from railgrip.core.errors import RailgripError
from railgrip.engine.journey.coasting import (
    coasting_curve,
    coasting_demand,
    coasting_of,
    indicators,
)
from railgrip.engine.journey.drive import drive
from railgrip.engine.journey.forces import HOLD
from railgrip.engine.journey.legs import Leg
from railgrip.laboratory.coasting_run import Driver
from railgrip.laboratory.point_train import PointTrain
from railgrip.scenario.journey import Journey

TRAIN = {
    "mass": "200 t",
    "rotating": 0.06,
    "max_speed": "120 km/h",
    "effort": {"force": "150 kN", "power": "2.5 MW"},
    "resistance": {"constant": 2.5e3, "linear": 30.0, "quadratic": 6.0},
    "max_acceleration": 0.7,
    "max_deceleration": 0.7,
    "efficiency": {"traction": 1.0, "regeneration": 0.0},
}
POINT = PointTrain(200e3, 0.06, 150e3, 2.5e6, (2.5e3, 30.0, 6.0), 0.7)
LINE = {
    "length": 10e3,
    "speed_limit": [
        {"at": 0, "value": "120 km/h"},
        {"at": 5000, "value": "60 km/h"},
        {"at": 7000, "value": "110 km/h"},
    ],
    "gradient": [{"at": 0, "value": 0.0}, {"at": 2000, "value": 0.004}],
}
LIMITS = Steps((0.0, 5000.0, 7000.0), (120 / 3.6, 60 / 3.6, 110 / 3.6))
GRADIENT = Steps((0.0, 2000.0), (0.0, 0.004))

WAYS: dict[str, dict[str, Any]] = {
    "cut": {"coasting_deceleration": 0.15, "hysteresis": 3.0},
    "straight": {"shape": "straight", "distance_gain": 0.01, "speed_gain": 1.1, "hysteresis": 2.0},
    "reduced": {"coasting_deceleration": 0.15, "action": "reduced", "reduced_share": 0.05},
    "light braking": {
        "coasting_deceleration": 0.2, "action": "light braking", "light_deceleration": 0.05},
    "station rule": {"coasting_deceleration": 0.12, "station_distance": 900.0},
    "hold": {"coasting_deceleration": 0.12, "station_distance": 900.0, "at_station": "hold"},
    "raised": {
        "coasting_deceleration": 0.1, "flat_braking": 1.0, "knee_speed": 15.0, "lift": 0.2},
    "switched off": {"by_control": False},
}  # fmt: skip


def journey(**coasting: Any) -> Journey:
    return Journey(train=TRAIN, line=LINE, coasting=coasting)


@pytest.mark.parametrize("way", WAYS)
def test_the_fast_journey_is_the_exact_run(way: str) -> None:
    """Every change of the acting indicator within 0.1 m, time and energy within 1e-5."""
    own = journey(**WAYS[way])
    assert own.coasting is not None
    run = drive(own, coasting_of(own))
    switched = own.coasting.is_switched_on
    law = CoastingLaw(own.coasting.parameters(0.7))
    exact = Driver(POINT, law, LIMITS, 10e3, gradient=GRADIENT, with_coasting=switched).run()
    assert run.running_time == pytest.approx(exact.changes[-1].time, rel=1e-5)
    assert run.energy["traction"] == pytest.approx(exact.energy, rel=1e-5)
    assert run.switchings == exact.switchings

    def acting(log: Any) -> list[float]:
        found, before = [], False
        for one in log:
            if one.is_acting != before:
                found.append(one.position)
                before = one.is_acting
        return found

    assert acting(indicators(run)) == pytest.approx(acting(exact.changes), abs=0.1)
    assert bool(acting(indicators(run))) == switched


speeds = st.floats(0.0, 45.0)


@settings(max_examples=150)
@given(
    st.sampled_from(sorted(WAYS)), st.floats(0.0, 9999.0), speeds, st.booleans(), st.booleans(),
    st.lists(st.tuples(st.floats(1.0, 9998.0), st.floats(0.0, 30.0)), max_size=3),
)  # fmt: skip
def test_the_kernel_says_what_the_class_says(
    way: str, position: float, speed: float, acts: bool, slow: bool, lower: list[Any]
) -> None:
    own = journey(**WAYS[way])
    assert own.coasting is not None
    targets = (*sorted(lower), (10e3, 0.0))
    parameters, state = coasting_of(own).setup(Leg(0.0, 10e3, targets, 0.7))
    state[:] = acts, slow
    demand = np.zeros(4)
    coasting_demand(position, speed, parameters, state, demand)
    law = CoastingLaw(own.coasting.parameters(0.7))
    law.state = CoastingState(acts, slow)
    announced = [AnnouncedTarget(at, v, at == 10e3) for at, v in targets]
    told = law.step(position, speed, announced, by_control=own.coasting.by_control)
    share = HOLD if told.holds_speed and not told.is_acting else told.traction
    share = 0.0 if told.must_brake else share
    assert demand.tolist() == [share, told.brake, law.state.is_acting, law.state.is_slow]


@pytest.mark.parametrize("line", ["st_gallen_wil", "fribourg_bern"])
@pytest.mark.parametrize("action", ["cut", "reduced", "light braking"])
def test_no_rule_beats_the_optimum_of_its_time(line: str, action: str) -> None:
    """Within the 0.05 % that the optimum's grid is worth."""
    own = Journey(train="flirt_tpf", line=line, coasting={"action": action, "reduced_share": 0.1})
    run = drive(own, coasting_of(own))
    best = optimum(own, run.running_time).energy
    assert best <= run.energy["pantograph"] * (1.0 + 5e-4)


def test_coasting_takes_longer_and_less() -> None:
    own = Journey(train="flirt_tpf", line="fribourg_bern", coasting={})
    fast, slow = drive(own), drive(own, coasting_of(own))
    assert slow.running_time > fast.running_time
    assert slow.energy["pantograph"] < 0.9 * fast.energy["pantograph"]
    assert slow.energy["friction"] + slow.energy["motor_brake"] < (
        fast.energy["friction"] + fast.energy["motor_brake"]
    )
    at, braking, coasting = coasting_curve(own)
    assert np.all(coasting <= braking)
    assert at[0] == 0.0


def test_results_do_not_depend_on_the_step() -> None:
    for way in ("cut", "light braking", "hold"):
        runs = [
            drive(one, coasting_of(one))
            for step in (1.0, 0.2)
            for one in [journey(**WAYS[way]).model_copy(update={"step": step})]
        ]
        assert runs[0].running_time == pytest.approx(runs[1].running_time, rel=2e-6)


@pytest.mark.parametrize(
    ("coasting", "sentence"),
    [
        (None, "coasting: is missing"),
        ({"coasting_deceleration": 0.9}, "coasting.coasting_deceleration: must be above 0 and bel"),
        ({"least_speed": 0.0, "action": "light braking"}, "a greater coasting.least_speed"),
    ],
)
def test_what_cannot_be_driven_is_said(coasting: Any, sentence: str) -> None:
    own = Journey(train=TRAIN, line=LINE, coasting=coasting)
    with pytest.raises(RailgripError, match=sentence):
        drive(own, coasting_of(own))
