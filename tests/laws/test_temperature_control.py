"""Temperature control on the plant: starts, faults, no locks, and the same bits in both forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import railgrip as rg
from railgrip.campaign.controller_check import PlainForm
from railgrip.control.temperature_controlled import TemperatureControlled

LABEL, AXLE = "C1-V2-B1-A1", 4
TRAINS = ("emu_four_car_emb", "emu_four_car")


def stop(train: str, **changes: Any) -> rg.Scenario:
    table = {
        "title": "stop",
        "train": train,
        "line": {"use": "level", "start": 1000.0},
        "rail": {"condition": "low"},
        "run": {"speed": "100 km/h", "demand": "emergency", "time_limit": "900 s"},
        "wsp": {"controller": "temperature_controlled"},
    }
    return rg.load(table).with_(changes)


def start(condition: str, controller: str) -> rg.Result:
    run = {"speed": 0.0, "demand": "none", "drive": 1.0, "duration": "40 s"}
    changes = {"run": run, "rail.condition": condition, "wsp": {"controller": controller}}
    return rg.simulate(stop("emu_four_car").with_(changes))


def distance(result: rg.Result) -> float:
    return float(result["covered_distance"].values[0])


@pytest.mark.parametrize("train", TRAINS)
def test_both_forms_give_the_same_bits(train: str) -> None:
    short = stop(train, **{"run.speed": "40 km/h", "rail.condition": "leaves"})
    compiled = rg.simulate(short)
    plain = rg.simulate(short, controller=PlainForm(TemperatureControlled()))
    for name in compiled.data:
        assert np.array_equal(compiled[name].values, plain[name].values, equal_nan=True), name


def test_a_start_spins_within_the_limit_and_goes_further_than_without() -> None:
    """On leaves friction falls with the spin, so holding it back is worth twice the distance."""
    held, free = start("leaves", "temperature_controlled"), start("leaves", "none")
    assert np.nanmax(held["flash_temperature"].values) < 200.0
    assert np.nanmax(free["flash_temperature"].values) > 1000.0
    assert held["axle_greatest_spin"].values.max() < 0.35
    assert distance(held) > 2.0 * distance(free)
    # the wheels without a motor show the speed
    error = held["reference_speed"].values[0] - held["train_speed"].values[0]
    assert np.abs(error).max() < 0.2


def test_a_start_on_good_rail_is_not_held_back() -> None:
    held, free = start("dry", "temperature_controlled"), start("dry", "none")
    assert distance(held) > 0.99 * distance(free)


@pytest.mark.parametrize("train", TRAINS)
@pytest.mark.parametrize("speed", ["60 km/h", "160 km/h"])
def test_no_wheel_locks(train: str, speed: str) -> None:
    """Constant and falling friction with at least 0.02 left, steps of it, and random rail."""
    slow = stop(train, **{"run.speed": speed})
    rails = [_rail(0.02, 1.0), _rail(0.05, 1.0), _rail(0.05, 0.4)]
    cases = [slow.with_({"rail": {"condition": rail}}) for rail in rails]
    steps = [
        {"from": f"{300 * i} m", "to": f"{300 * (i + 1)} m", "condition": rails[i % 3]}
        for i in range(4, 40)
    ]
    cases.append(slow.with_({"rail.patch": steps}))
    for case in cases:
        result = rg.simulate(case, traces=False)
        assert result.status.name == "STOPPED"
        assert result["axle_longest_fast_lock"].values.max() <= 0.4
    field = {"mean": 0.06, "spread": 0.03, "correlation_length": "50 m"}
    batch = rg.simulate(slow.with_({"rail.random": field}), runs=16, traces=False)
    assert batch["axle_longest_fast_lock"].values.max() <= 0.4


def _rail(adhesion: float, ratio: float) -> dict[str, Any]:
    state = {"static_friction": adhesion, "friction_ratio": ratio, "friction_decay": 0.2}
    return {"contaminated": state, "clean": state, "cleaning": 0.0}


FAULTS: dict[str, dict[str, Any]] = {
    "sensor_lost": {}, "sensor_dead": {}, "sensor_frozen": {}, "sensor_noisy": {"noise": "0.3 m/s"},
    "sensor_scaled": {"factor": 0.97}, "valve_fills": {}, "valve_holds": {}, "valve_vents": {},
    "valve_delayed": {"delay": "100 ms"}, "axle_locked": {},
}  # fmt: skip


@pytest.mark.parametrize("train", TRAINS)
@pytest.mark.parametrize("kind", list(FAULTS))
def test_a_fault_of_one_axle_leaves_the_others_protected(train: str, kind: str) -> None:
    fault = [{"axle": LABEL, "kind": kind, "from": "3 s", **FAULTS[kind]}]
    broken, sound = (rg.simulate(stop(train, fault=f), traces=False) for f in (fault, []))
    assert broken.status.name == "STOPPED"
    assert abs(float(broken["energy_balance"].values[0])) < 1e-6
    others = np.arange(16) != AXLE
    assert broken["axle_longest_fast_lock"].values[0, others].max() <= 0.4
    longer = broken["stopping_distance"].values[0] / sound["stopping_distance"].values[0]
    assert float(longer) < 1.1
