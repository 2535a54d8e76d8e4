"""With any single fault on a driven axle the train still starts, and no other axle runs away."""

from __future__ import annotations

import itertools
from functools import cache
from typing import Any

import numpy as np
import pytest
from tests.laws.test_faults_of_every_controller import FAULTS, LOST

import railgrip as rg

CONTROLLERS = ("conventional_traction", "peak_seeking_traction", "adaptive_traction")
TRAINS = {"emu_four_car": 10.0 / 3.6, "locomotive_bobo": 0.0}
"""Train → speed at the start: on leaves the unit has covered little after 8 s from a stand."""
AXLE = 1
LEAST = {"axle locked": 0.3, "half too fast": 0.7}
"""Least distance over that of the sound train: one of four motors is lost at most, a seized axle
brakes besides, and one that seems to spin costs its inverter's effort."""
SHARE = 0.85
MORE_SPIN = {("locomotive_bobo", "half too fast"): 6.0}
"""How much faster the others may spin, m/s: without wheels that roll freely a sensor that reads
half too much spoils the reference speed by as much."""
KNOWN = (LOST | {"frozen", "axle locked"}) - {"noise of 0.3 m/s"}
"""Faults that the run must tell."""


def scenario(train: str, controller: str, fault: list[dict[str, Any]]) -> rg.Scenario:
    return rg.load("start_leaves").with_(
        {
            "train": train,
            "line.use": {"length": 15e3},
            "run": {
                "speed": TRAINS[train], "demand": "none", "drive": 1.0, "duration": 25.0,
            },
            "wsp": {"controller": controller},
            "fault": fault,
        }
    )  # fmt: skip


@cache
def sound(train: str, controller: str) -> rg.Result:
    return rg.simulate(scenario(train, controller, []))


def spin_of_others(result: rg.Result) -> float:
    motors = np.array([place.axle.motor for place in result.scenario.train.axles()])
    motors[AXLE] = False
    return float((result["wheel_speed"] - result["train_speed"]).values[0][motors].max())


@pytest.mark.parametrize(
    ("train", "controller"),
    [
        *itertools.product(TRAINS, CONTROLLERS),
        # they have no reference speed where all axles are motored
        ("emu_four_car", "temperature_controlled"),
        ("emu_four_car", "temperature_adaptive"),
    ],
)
def test_one_fault_on_a_driven_axle(train: str, controller: str) -> None:
    healthy = sound(train, controller)
    label = str(healthy["axle"].values[AXLE])
    others = np.arange(healthy.data.sizes["axle"]) != AXLE
    for name, fault in FAULTS.items():
        if name.startswith("valve"):
            continue
        faults = [{"axle": label, "from": "8 s", **fault}]
        run = rg.simulate(scenario(train, controller, faults))
        assert run.status.name == "COMPLETED", name
        covered = [float(one["covered_distance"].values[0]) for one in (run, healthy)]
        assert covered[0] > LEAST.get(name, SHARE) * covered[1], (name, covered)
        more = spin_of_others(run) - spin_of_others(healthy)
        assert more < MORE_SPIN.get((train, name), 1.5), (name, more)
        alarm = run["wsp_alarm"].values[0]
        assert not (alarm[others] == 1.0).any(), name
        if name in KNOWN:
            assert (alarm[AXLE] == 1.0).any(), name
        if name in LOST:
            # nobody sees it spin: it follows its neighbour with some caution
            own = (run["wheel_speed"] - run["train_speed"]).values[0][AXLE]
            assert own[run["time"].values > 15.0].max() < 3.0, name
        assert label in run.data.attrs["faults"]


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_without_any_speed_no_motor_pulls(controller: str) -> None:
    faults = [{"axle": "all", "kind": "sensor_lost", "from": "8 s"}]
    run = rg.simulate(scenario("locomotive_bobo", controller, faults))
    late = run["time"].values > 8.6
    assert np.abs(run["dynamic_force"].values[0][:, late]).max() < 1.0
    assert (run["wsp_alarm"].values[0].max(axis=1) == 1.0).all()
