"""Faults do to the plant what they say, to the axle they name and to no other."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import railgrip as rg

AXLE = 4
LABEL = "C1-V2-B1-A1"
STOP: dict[str, Any] = {
    "title": "fault",
    "train": "emu_four_car",
    "line": {"use": "level", "start": 1000.0},
    "rail": {"condition": "low"},
    "run": {"speed": "100 km/h", "demand": "emergency", "trace": 0.01},
    "wsp": {"controller": "conventional"},
}
FROM = 300
"""Row of the traces, one every 10 ms, at which the faults begin."""


def stopped(kind: str = "", controller: Any = None, **more: Any) -> dict[str, np.ndarray]:
    fault = [{"axle": LABEL, "kind": kind, "from": "3 s", **more}] if kind else []
    result = rg.simulate(rg.load({**STOP, "fault": fault}), controller=controller)
    assert result.status.name == "STOPPED"
    assert abs(float(result["energy_balance"].values[0])) < 1e-6
    return {str(name): result[name].values[0] for name in result.data}


@pytest.fixture(scope="module")
def sound() -> dict[str, np.ndarray]:
    return stopped()


class Blind:
    """A controller that opens every valve and looks at nothing: the plant alone shows."""

    period = 0.01

    def reset(self, setup: Any) -> int:
        return int(setup.n_axles)

    def step(self, state: int, measured: Any, dt: float) -> Any:
        from railgrip.control.contract import Command

        return Command(np.zeros(state), np.ones(state), np.zeros(state), 0.0)


@pytest.mark.parametrize(
    "kind", ["sensor_lost", "sensor_dead", "sensor_frozen", "valve_vents", "valve_holds"]
)
def test_before_it_begins_a_fault_changes_no_bit(sound: dict[str, np.ndarray], kind: str) -> None:
    broken = stopped(kind)
    for name in ("train_speed", "wheel_speed", "measured_speed", "brake_cylinder_pressure"):
        assert np.array_equal(broken[name][..., :FROM], sound[name][..., :FROM]), name


def measured(kind: str, **more: Any) -> tuple[np.ndarray, np.ndarray]:
    """What the controller is told of the axle, and what it would be told without the fault."""
    broken, whole = stopped(kind, Blind(), **more), stopped(controller=Blind())
    end = min(broken["train_speed"].size, whole["train_speed"].size)
    others = np.arange(16) != AXLE
    assert np.array_equal(
        broken["measured_speed"][others, :end], whole["measured_speed"][others, :end]
    )
    after = slice(FROM + 10, end)
    return broken["measured_speed"][AXLE, after], whole["measured_speed"][AXLE, after]


def test_a_lost_sensor_gives_no_number_and_a_dead_one_zero() -> None:
    assert np.isnan(measured("sensor_lost")[0]).all()
    assert (measured("sensor_dead")[0] == 0.0).all()


def test_a_frozen_sensor_stays_where_it_was() -> None:
    told, true = measured("sensor_frozen")
    assert len(set(told.tolist())) == 1
    assert told[0] > true[-1] + 5.0


def test_a_scaled_sensor_reads_its_share_too_much() -> None:
    told, true = measured("sensor_scaled", factor=1.05)
    assert told == pytest.approx(1.05 * true)


def test_the_noise_has_the_spread_that_was_asked_for() -> None:
    told, true = measured("sensor_noisy", noise="0.3 m/s")
    fast = true > 3.0
    error = (told - true)[fast]
    # standard error of a standard deviation: σ/√(2n)
    assert error.std() == pytest.approx(0.3, abs=4 * 0.3 / np.sqrt(2 * error.size))
    assert error.mean() == pytest.approx(0.0, abs=4 * 0.3 / np.sqrt(error.size))


@pytest.mark.parametrize(("kind", "state"), [("valve_vents", 2.0), ("valve_holds", 1.0)])
def test_a_stuck_valve_stands_where_it_is_stuck(kind: str, state: float) -> None:
    broken = stopped(kind)
    assert (broken["dump_valve"][AXLE, FROM + 2 :] == state).all()
    pressure = broken["brake_cylinder_pressure"][AXLE]
    if kind == "valve_vents":
        assert pressure[-1] < 1e3
    else:
        assert np.ptp(pressure[FROM + 2 :]) == 0.0


def test_a_valve_stuck_open_locks_its_axle_and_no_other(sound: dict[str, np.ndarray]) -> None:
    broken = stopped("valve_fills")
    others = np.arange(16) != AXLE
    assert broken["axle_longest_lock"][AXLE] > 10.0
    assert broken["axle_longest_fast_lock"][others].max() <= 0.4
    assert broken["alarm"][AXLE].max() == 1.0


@pytest.mark.parametrize("kind", ["sensor_frozen", "sensor_dead", "sensor_lost"])
def test_a_sensor_that_fails_costs_the_train_little_and_the_other_axles_nothing(
    sound: dict[str, np.ndarray], kind: str
) -> None:
    """One axle of sixteen is left without protection: a few per cent of the distance."""
    broken = stopped(kind)
    others = np.arange(16) != AXLE
    assert broken["stopping_distance"] == pytest.approx(sound["stopping_distance"], rel=0.08)
    assert broken["axle_longest_fast_lock"][others].max() <= 0.4


def test_a_late_valve_vents_later() -> None:
    late, sound = stopped("valve_delayed", delay="100 ms"), stopped()

    def first_vent(run: dict[str, np.ndarray]) -> int:
        return int(np.flatnonzero(run["dump_valve"][AXLE, FROM:] == 2.0)[0])

    assert late["axle_greatest_slip"][AXLE] > sound["axle_greatest_slip"][AXLE]
    assert first_vent(late) >= first_vent(sound)


def test_an_axle_that_seizes_stands_soon_and_on_every_rail_the_energy_closes() -> None:
    for rail in ("dry", "water_detergent", "leaves"):
        scenario = rg.load({**STOP, "rail": {"condition": rail}})
        fault = [{"axle": LABEL, "kind": "axle_locked", "from": "3 s"}]
        result = rg.simulate(scenario.with_({"fault": fault}))
        wheel = result["wheel_speed"].values[0][AXLE]
        assert wheel[FROM + 100] == 0.0, rail
        assert abs(float(result["energy_balance"].values[0])) < 1e-6, rail


def test_a_fault_may_heal_and_may_strike_all_axles() -> None:
    fault = [{"axle": "all", "kind": "sensor_dead", "from": "3 s", "to": "4 s"}]
    result = rg.simulate(rg.load({**STOP, "fault": fault}), controller=Blind())
    told = result["measured_speed"].values[0]
    assert (told[:, FROM + 10 : FROM + 90] == 0.0).all()
    assert (told[:, FROM + 110 : FROM + 200] > 0.0).any()


def test_what_does_not_fit_is_refused_all_at_once() -> None:
    fault = [
        {"axle": "C1-V9-B1-A1", "kind": "sensor_lost"},
        {"axle": "all", "kind": "sensor_noisy"},
        {"axle": "all", "kind": "sensor_dead", "noise": 1.0},
        {"axle": "all", "kind": "sensor_dead", "from": 3.0, "to": 2.0},
        {"axle": "all", "kind": "sensor_dad"},
    ]
    with pytest.raises(rg.RailgripError) as caught:
        rg.load({**STOP, "fault": fault[1:]})
    text = str(caught.value)
    assert "fault[0].noise: is needed for kind 'sensor_noisy'" in text
    assert "fault[1].noise: does not belong to kind 'sensor_dead'" in text
    assert "fault[2].to: must be later than from" in text
    assert "did you mean 'sensor_dead'?" in text
    with pytest.raises(rg.RailgripError, match=r"fault\[0\]\.axle: axle 'C1-V9-B1-A1' unknown"):
        rg.load({**STOP, "fault": fault[:1]})
    with pytest.raises(rg.RailgripError, match="the train has no dump valves"):
        rg.load({**STOP, "train": "wagon_block", "fault": [{"axle": "all", "kind": "valve_vents"}]})
