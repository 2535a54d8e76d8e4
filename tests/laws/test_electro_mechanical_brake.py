"""An electro-mechanical brake: an exact first-order lag, a share that it follows, nothing else."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.conftest import Coach

import railgrip as rg
from railgrip.control.contract import FILL, HOLD, VENT, Command

LAG = 0.08
EMB: dict[str, Any] = {"fill": "lag", "lag": LAG, "dead_time": 0.0}


class Permits:
    """Permits each axle a share and says a word to its valve, both by the time."""

    period = 0.01

    def __init__(self, share: Any = lambda time: 1.0, valve: Any = lambda time: FILL) -> None:
        self.share, self.valve = share, valve

    def reset(self, setup: Any) -> dict[str, Any]:
        self.told = setup
        return {"n": setup.n_axles, "time": 0.0}

    def step(self, state: dict[str, Any], measured: Any, dt: float) -> Command:
        one = np.ones(state["n"])
        time = state["time"]
        state["time"] += dt
        share = self.share(time) * one
        return Command(self.valve(time) * one, one, 0.0 * one, 0.0, friction_share=share)


def stop(coach: Coach, controller: Any, **changes: Any) -> rg.Result:
    scenario = coach(0.3, brake={**EMB, **changes}, trace=0.01)
    return rg.simulate(scenario, controller=controller)


def test_the_step_response_is_the_exponential(coach: Coach) -> None:
    result = stop(coach, Permits())
    clamp, time = result["clamp_force"].values[0, 0], result["time"].values
    expected = clamp[200] * (1.0 - np.exp(-time[1:200] / LAG))
    assert clamp[1:200] == pytest.approx(expected, rel=1e-9)


def test_the_clamp_follows_the_permitted_share(coach: Coach) -> None:
    result = stop(coach, Permits(share=lambda time: 0.25 if time > 1.995 else 1.0))
    clamp, time = result["clamp_force"].values[0, 0], result["time"].values
    after = (time > 2.005) & (time < 4.0)
    expected = clamp[200] * (0.25 + 0.75 * np.exp(-(time[after] - 2.0) / LAG))
    assert clamp[after] == pytest.approx(expected, rel=1e-6)


def test_energy_closes_and_no_air_is_used(coach: Coach) -> None:
    result = stop(coach, Permits(share=lambda time: 0.5 + 0.5 * np.sin(3.0 * time) ** 2))
    assert result.status.name == "STOPPED"
    assert abs(float(result["energy_balance"].values[0])) < 1e-12
    assert float(result["air_used"].values[0]) == 0.0


def test_it_obeys_the_words_of_a_dump_valve(coach: Coach) -> None:
    """So the ordinary protection works on it: HOLD keeps the clamp, VENT opens it."""
    words = Permits(valve=lambda time: FILL if time < 1.0 else HOLD if time < 2.0 else VENT)
    result = stop(coach, words, lag=0.5)
    clamp, time = result["clamp_force"].values[0, 0], result["time"].values
    held = (time > 1.2) & (time < 1.9)
    assert np.ptp(clamp[held]) == 0.0
    opened = (time > 2.2) & (time < 4.0)
    assert (np.diff(clamp[opened]) < 0.0).all()


def test_a_controller_is_told_of_masses_and_forces(coach: Coach) -> None:
    controller = Permits()
    result = stop(coach, controller)
    axles = controller.told.axles
    assert axles.continuous.all()
    assert controller.told.braked.all()
    assert axles.rotating_mass.tolist() == [800.0] * 4
    assert controller.told.axle_load == pytest.approx(result["wheel_load"].values[0, :, 0])
    pressure = result["brake_cylinder_pressure"].values[0, 0, 200]
    range_ = axles.full_pressure[0] - axles.first_pressure[0]
    share = (pressure - axles.first_pressure[0]) / range_
    force = result["brake_force"].values[0, 0, 200]
    assert share * axles.full_force[0] == pytest.approx(force, rel=1e-3)


@pytest.mark.parametrize("fill", ["linear", "orifice"])
def test_other_brakes_do_not_know_the_share(coach: Coach, fill: str) -> None:
    """Bit for bit."""
    scenario = coach(0.3, brake={"fill": fill})
    one = rg.simulate(scenario, controller=Permits())
    other = rg.simulate(scenario, controller=Permits(share=lambda time: 0.3))
    for name in one.data:
        assert np.array_equal(one[name].values, other[name].values, equal_nan=True), name


@pytest.mark.parametrize("share", [-0.1, 1.1, np.nan])
def test_a_share_that_is_none_ends_the_run(coach: Coach, share: float) -> None:
    result = rg.simulate(coach(0.3, brake=EMB), controller=Permits(share=lambda time: share))
    assert result.status.name == "CONTROLLER_FAILED"


def test_the_shipped_train_stops_as_its_pneumatic_sister() -> None:
    """A few per cent sooner: it builds up faster."""
    pneumatic = rg.simulate(rg.load("dry_emergency"))
    emb = rg.simulate(pneumatic.scenario.with_({"train": "emu_four_car_emb"}))
    ratio = float(emb["stopping_distance"].values[0] / pneumatic["stopping_distance"].values[0])
    assert 0.9 < ratio < 1.0
