"""Numbers that differ from run to run: by name, by axle, checked, and with their effect."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.conftest import Coach

import railgrip as rg
from railgrip.core.errors import RailgripError


def test_a_train_number(coach: Coach) -> None:
    speeds = np.array([10.0, 20.0, 5.0, 15.0])
    result = rg.simulate(coach(0.3), runs=4, variations={"INITIAL_SPEED": speeds})
    np.testing.assert_array_equal(result["initial_speed"].values, speeds)
    order = np.argsort(result["stopping_distance"].values)
    np.testing.assert_array_equal(order, np.argsort(speeds))


def test_a_number_of_one_axle_and_of_all(coach: Coach) -> None:
    """Half the force per pressure on one axle of four is an eighth less brake; on all, half."""
    scenario = coach(0.5, speed=20.0)
    full = 0.0324 * 5.0 * 2.0
    changes: dict[Any, Any] = {("CLAMP_PER_PRESSURE", 2): [full, full / 2]}
    one = rg.simulate(scenario, runs=2, variations=changes)["energy_brake"].values
    assert one[1] == pytest.approx(one[0], rel=0.01)
    stops = rg.simulate(scenario, runs=2, variations=changes)["mean_deceleration"].values
    assert stops[1] / stops[0] == pytest.approx(7 / 8, rel=0.01)
    changes = {"CLAMP_PER_PRESSURE": [full, full / 2]}
    stops = rg.simulate(scenario, runs=2, variations=changes)["mean_deceleration"].values
    assert stops[1] / stops[0] == pytest.approx(0.5, rel=0.05)


def test_the_value_of_the_scenario_changes_nothing(coach: Coach) -> None:
    scenario = coach(0.3, speed=20.0)
    plain = rg.simulate(scenario, traces=False)
    same = rg.simulate(scenario, traces=False, variations={"INITIAL_SPEED": [20.0]})
    for name in plain.data:
        assert plain[name].values.tobytes() == same[name].values.tobytes(), name


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (
            {"INITIAL_SPED": [1.0]},
            "quantity 'INITIAL_SPED' unknown; .*did you mean 'INITIAL_SPEED'",
        ),
        ({("STATIC_LOAD_", 1): [1.0]}, "did you mean 'STATIC_LOAD'"),
        ({"INITIAL_SPEED": [1.0, 2.0]}, "one finite number for each run; got shape"),
        ({"INITIAL_SPEED": 1.0}, "one finite number for each run"),
        ({"INITIAL_SPEED": [float("nan")]}, "one finite number for each run"),
        ({("STATIC_LOAD", 4): [1e5]}, "axle"),
        ({("STATIC_LOAD", -1): [1e5]}, "axle"),
        ({("INITIAL_SPEED", 2): [1.0]}, "axle|train"),
    ],
    ids=str,
)
def test_what_is_refused(coach: Coach, changes: dict[Any, Any], sentence: str) -> None:
    """One sentence each; an axle that the train has not must not write into another's numbers."""
    with pytest.raises(RailgripError, match=sentence):
        rg.simulate(coach(0.3, speed=5.0), variations=changes)


@pytest.mark.parametrize("numbers", [{"runs": 0}, {"threads": 0}, {"runs": -3}])
def test_counts_are_positive(coach: Coach, numbers: dict[str, int]) -> None:
    with pytest.raises(RailgripError, match="runs and threads must be at least 1"):
        rg.simulate(coach(0.3, speed=5.0), **numbers)


def test_progress_counts_all_runs(coach: Coach) -> None:
    for threads in (1, 2):
        seen: list[int] = []
        rg.simulate(coach(0.3, speed=5.0), runs=40, threads=threads, progress=seen.append)
        assert sum(seen) == 40
