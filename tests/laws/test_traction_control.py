"""Traction anti-slip on the plant: how much of the adhesion it uses, and what it must not do."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import railgrip as rg
from railgrip.control.contract import Measured
from railgrip.control.contract_signals import bench_setup
from railgrip.control.conventional_traction import ConventionalTraction
from railgrip.control.conventional_wsp import ConventionalWSP
from railgrip.control.peak_seeking_traction import PeakSeekingTraction
from railgrip.core.errors import RailgripError

CONTROLLERS = ("conventional_traction", "peak_seeking_traction")


@pytest.fixture(scope="module")
def study() -> Any:
    path = Path(__file__).parents[2] / "studies/traction_start.py"
    spec = importlib.util.spec_from_file_location("traction_start", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def run(study: Any, case: str, controller: str, **changes: Any) -> rg.Result:
    chosen = study.start(case).with_({"wsp": {"controller": controller}, **changes})
    return rg.simulate(chosen)


@pytest.mark.parametrize("case", ["unit, leaves, 5 ‰", "locomotive, leaves, 10 ‰"])
def test_the_peak_seeker_uses_nine_tenths_of_a_steady_rail(study: Any, case: str) -> None:
    result = run(study, case, "peak_seeking_traction")
    assert study.share_used(result, after=5.0) >= 0.95
    assert study.share_used(result, after=0.0) >= 0.90
    # the locomotive has no wheel without a motor; of the unit the second fastest trailing one tells
    error = (result["reference_speed"] - result["train_speed"]).values[0]
    late = result["time"].values > 5.0
    assert np.abs(error[late]).max() < 0.4


def test_a_target_that_moves_with_the_speed_follows_a_peak_at_a_creepage(study: Any) -> None:
    """Wet, light locomotive: 2 m/s faster each second; the search alone comes late."""
    case, moving = "locomotive, wet, 10 ‰", {"speed_forward": 1.0, "dither": 0.2}
    late = study.share_used(run(study, case, "peak_seeking_traction"), after=5.0)
    wsp = {"controller": "peak_seeking_traction", "parameters": moving}
    ahead = study.share_used(run(study, case, "", wsp=wsp), after=5.0)
    assert late < 0.89
    assert ahead > 0.895


@pytest.mark.parametrize("controller", CONTROLLERS)
@pytest.mark.parametrize("inverter", ["axle", "bogie", "vehicle"])
def test_with_a_common_inverter_the_least_share_counts(
    study: Any, controller: str, inverter: str
) -> None:
    train = study.start("unit, leaves, 5 ‰").train.model_dump(by_alias=True)
    train["traction"]["inverter"] = inverter
    result = run(study, "unit, leaves, 5 ‰", controller, train=train)
    assert study.share_used(result, after=5.0) > 0.88
    force = result["dynamic_force"].values[0]
    if inverter == "bogie":
        # once the effort had to be reduced, both motors of a bogie give the same up to their power
        assert np.allclose(force[0], force[1], rtol=1e-3, atol=200.0)


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_nothing_is_lost_where_the_rail_gives_what_is_asked(study: Any, controller: str) -> None:
    for case in ("unit, wet, 10 ‰", "locomotive, dry, level"):
        with_it = run(study, case, controller)["covered_distance"].values[0]
        without = run(study, case, "none")["covered_distance"].values[0]
        assert with_it == pytest.approx(without, rel=0.005), case


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_energy_closes_under_control(study: Any, controller: str) -> None:
    result = run(study, "unit, leaves, 5 ‰", controller)
    assert abs(float(result["energy_balance"].values[0])) < 1e-6


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_sand_helps_a_start(study: Any, controller: str) -> None:
    """The shipped unit sands from 16 km/h on, in front of an axle that has no motor."""
    begin = {"run.speed": "30 km/h", "run.demand": "none"}
    dry = run(study, "unit, leaves, 5 ‰", controller, **begin)
    shipped = rg.load("start_leaves").train
    sanded = run(study, "unit, leaves, 5 ‰", controller, train=shipped.model_dump(), **begin)
    more = sanded["final_speed"].values[0] - dry["final_speed"].values[0]
    assert more > 0.1


@pytest.mark.parametrize("kind", ["sensor_lost", "sensor_frozen", "sensor_dead"])
@pytest.mark.parametrize("controller", CONTROLLERS)
def test_a_lost_sensor_leaves_the_other_axles_protected(
    study: Any, controller: str, kind: str
) -> None:
    sound = run(study, "unit, leaves, 5 ‰", controller)
    fault = [{"kind": kind, "axle": "C1-V2-B1-A1", "from": "20 s"}]
    result = run(study, "unit, leaves, 5 ‰", controller, fault=fault)
    covered = result["covered_distance"].values[0]
    assert covered == pytest.approx(sound["covered_distance"].values[0], rel=0.1)


@pytest.mark.parametrize("kind", [ConventionalTraction, PeakSeekingTraction])
def test_braking_is_the_ordinary_protection_to_the_bit(kind: Any) -> None:
    stop = rg.load("leaves_160")
    mine = rg.simulate(stop, controller=kind())
    ordinary = rg.simulate(stop, controller=ConventionalWSP())
    assert np.array_equal(mine["wheel_speed"].values, ordinary["wheel_speed"].values)


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_no_signal_drives_a_command_out_of_its_range(controller: str) -> None:
    """Random speeds with NaN, infinite and negative ones among them, demands of every size."""
    kind: Any = {"conventional_traction": ConventionalTraction}.get(controller, PeakSeekingTraction)
    random = np.random.default_rng(3)
    one = kind()
    state = one.reset(bench_setup(4, 0.01))
    for _ in range(400):
        speed = random.normal(10.0, 10.0, 4)
        speed[random.integers(4)] = random.choice([np.nan, np.inf, -5.0, 0.0, 1e6, 10.0])
        measured = Measured(speed, np.zeros(4), random.normal(0.0, 1e4, 4), 0.0, 0.0, 1.0)
        command = one.step(state, measured, 0.01)
        share = command.dynamic_share
        assert ((share >= 0.0) & (share <= 1.0)).all()
        assert 0.0 <= command.reference_speed < 300.0


@pytest.mark.parametrize(
    ("kind", "name", "value"),
    [
        (ConventionalTraction, "spin_lower", 0.2),
        (ConventionalTraction, "cut_time", 0.0),
        (PeakSeekingTraction, "dither", 1.0),
        (PeakSeekingTraction, "speed_noise", 0.0),
    ],
)
def test_what_no_vehicle_can_mean_is_refused(kind: Any, name: str, value: float) -> None:
    wrong = kind().parameters._replace(**{name: value})
    with pytest.raises(RailgripError, match=name):
        kind(wrong)
