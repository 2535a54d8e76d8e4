"""How runs end: every status that braking can reach, and a batch that goes on past it."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from tests.conftest import Coach

import railgrip as rg
from railgrip.control.contract import DUMP_VALVE, DYNAMIC_SHARE, Command, Measured, Setup
from railgrip.core.status import ENDED_WELL, RunStatus, sentence


def test_stopped(coach: Coach) -> None:
    result = rg.simulate(coach(0.3, speed=10.0))
    assert result.status == RunStatus.STOPPED
    assert result.sentence == "The train came to a stand."
    assert np.isfinite(result["stopping_distance"].values[0])


def test_end_of_track(coach: Coach) -> None:
    result = rg.simulate(coach(0.01, speed=30.0, start=0.0, length=500.0))
    assert result.status == RunStatus.END_OF_TRACK
    assert "try a longer line" in result.sentence
    assert np.isnan(result["stopping_distance"].values[0])
    position = result["train_position"].values[0]
    assert np.nanmax(position) == pytest.approx(500.0, abs=1.0)


def test_time_limit(coach: Coach) -> None:
    result = rg.simulate(coach(0.3, speed=30.0, demand="none", time_limit=2.0))
    assert result.status == RunStatus.TIME_LIMIT
    assert "run.time_limit" in result.sentence
    assert result.data["time"].values[-1] == pytest.approx(2.0, abs=0.021)


def test_diverged(coach: Coach) -> None:
    """A train without mass and without load has no motion: its speed is 0/0."""
    nothing = {"TRAIN_MASS": [0.0], "STATIC_LOAD": [0.0]}
    result = rg.simulate(coach(0.3, speed=10.0), variations=nothing)
    assert result.status == RunStatus.DIVERGED
    assert "run.step" in result.sentence


class Stubborn:
    """Commands what is no command, from its tenth step on."""

    period = 0.01

    def __init__(self, valve: float = 0.0, share: float = 1.0, count: int | None = None) -> None:
        self.valve, self.share, self.count = valve, share, count

    def reset(self, setup: Setup) -> dict[str, Any]:
        return {"n": setup.n_axles, "tick": 0}

    def step(self, state: dict[str, Any], measured: Measured, dt: float) -> Command:
        state["tick"] += 1
        is_bad = state["tick"] >= 10
        n = state["n"] if self.count is None or not is_bad else self.count
        valve, share = (self.valve, self.share) if is_bad else (0.0, 1.0)
        return Command(np.full(n, valve), np.full(n, share), np.zeros(n), 0.0)


BAD = [{"valve": 3.0}, {"valve": float("nan")}, {"valve": 0.5}, {"share": 1.5},
       {"share": -0.1}, {"share": float("nan")}]  # fmt: skip


@pytest.mark.parametrize("bad", BAD, ids=str)
def test_a_command_that_is_none(coach: Coach, bad: dict[str, float]) -> None:
    result = rg.simulate(coach(0.3, speed=10.0), controller=Stubborn(**bad))
    assert result.status == RunStatus.CONTROLLER_FAILED
    assert "railgrip check" in result.sentence
    assert result.data["time"].values[-1] < 0.2


def test_a_controller_that_raises_ends_its_run_and_its_way_is_kept(coach: Coach) -> None:
    result = rg.simulate(coach(0.3, speed=10.0), controller=Stubborn(count=3))
    assert result.status == RunStatus.CONTROLLER_FAILED
    assert re.match(r"wsp.controller: Stubborn.step failed; got .*; try", result.sentence)
    assert 0.05 < result.data["time"].values[-1] < 0.2
    assert np.isfinite(result["train_speed"].values).all()
    assert np.isnan(result["stopping_distance"].values[0])


def stubborn_kernel(
    parameters: Any, axle_setup: Any, state: Any, measured: Any, command: Any, dt: float
) -> None:
    """Fail where the train is fast, so that a batch holds failed and good runs."""
    for axle in range(measured.shape[0]):
        command[axle, DYNAMIC_SHARE] = 1.0
        command[axle, DUMP_VALVE] = 7.0 if measured[axle, 0] > 15.0 else 0.0


class CompiledStubborn(Stubborn):
    kernel = staticmethod(stubborn_kernel)
    parameters = ()

    @staticmethod
    def state_size(n_axles: int) -> int:
        return 0


def test_a_batch_goes_on_past_failed_runs(coach: Coach) -> None:
    """Slow runs stop, those too fast for the controller fail, and each has its own bits."""
    speeds = np.array([10.0, 20.0, 12.0, 14.0, 30.0, 8.0] * 6)
    scenario = coach(0.3, speed=10.0)
    result = rg.simulate(
        scenario, runs=36, variations={"INITIAL_SPEED": speeds}, controller=CompiledStubborn()
    )
    expected = np.where(speeds > 15.0, RunStatus.CONTROLLER_FAILED, RunStatus.STOPPED)
    np.testing.assert_array_equal(result["status"].values, expected)
    alone = rg.simulate(scenario, controller=CompiledStubborn(), traces=False)
    np.testing.assert_array_equal(
        result["stopping_distance"].values[speeds == 10.0], alone["stopping_distance"].values[0]
    )


def test_statuses_of_one_batch_differ(coach: Coach) -> None:
    scenario = coach(0.2, speed=10.0, start=0.0, length=150.0, time_limit=8.0)
    speeds = np.array([5.0, 60.0, 10.0, 14.0, 60.0])
    result = rg.simulate(scenario, runs=5, variations={"INITIAL_SPEED": speeds})
    stopped, ended, late = RunStatus.STOPPED, RunStatus.END_OF_TRACK, RunStatus.TIME_LIMIT
    assert result["status"].values.tolist() == [stopped, ended, stopped, late, ended]


@pytest.mark.parametrize("status", list(RunStatus))
def test_every_status_has_a_sentence(status: RunStatus) -> None:
    assert sentence(status).endswith(".")
    if status not in (RunStatus.RUNNING, *ENDED_WELL):
        assert "try" in sentence(status) or "run 'railgrip check'" in sentence(status)
