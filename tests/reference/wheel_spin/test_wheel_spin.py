"""A wheel whose brake is released finds back to rolling as fast as the linear theory says."""

from __future__ import annotations

import numpy as np
import pytest

import railgrip as rg
from railgrip.core.constants import GRAVITY

INERTIA = 1000.0
RADIUS = 0.46
SPEED = 100.0
SLOPE = 29.05e6
WET = 0.2
DECAY = INERTIA * SPEED / (RADIUS**2 * SLOPE * WET)
WHEEL_LOAD = 100e3


def scenario() -> rg.Scenario:
    """Four axles of 200 kN, braked by 500 N each for 0.2 s."""
    axle = {"count": 2, "rotating_mass": INERTIA / RADIUS**2, "wheel_radius": RADIUS, "brake": "b"}
    bogie = {"count": 2, "wheelbase": 2.5, "mass": 6e3, "axle": [axle]}
    tare = 4 * 2 * WHEEL_LOAD / GRAVITY
    brake = {
        "kind": "block", "cylinder_pressure": 1e5, "cylinder_area": 0.005, "rigging_ratio": 1.0,
        "pad": {"law": "constant", "friction": 1.0}, "fill": "linear", "dead_time": 0.0,
        "fill_time": 0.01, "release_time": 0.01,
    }  # fmt: skip
    vehicle = {"length": 26.0, "tare": tare, "pivot_distance": 19.0, "bogie": [bogie]}
    return rg.Scenario(
        train={"brakes": {"b": brake}, "vehicle": [vehicle], "sensor": {"delay": 0.0}},
        rail={"condition": "wet"},
        run={
            "speed": SPEED,
            "demand": [{"at": 0.0, "level": 1.0}, {"at": 0.2, "level": 0.0}],
            "time_limit": 0.7,
            "step": 1e-3,
            "trace": 1e-3,
        },
        wsp={"controller": "none"},
    )


def test_decay_time() -> None:
    """81.36 ms within 0.2 %."""
    # a train that nothing slows down, and a contact without relaxation: the bare spin equation
    bare = {"TRAIN_MASS": [1e15], "RELAXATION_LENGTH": [1e-9]}
    data = rg.simulate(scenario(), variations=bare).data
    time = data["time"].values
    creepage = -data["creepage"].values[0]
    after = (time > 0.25) & (time < 0.45)
    assert creepage[:, after].min() > 1e-6
    assert creepage[:, after].max() < 1e-4
    for axle in creepage:
        slope = np.polyfit(time[after], np.log(axle[after]), 1)[0]
        assert -1 / slope == pytest.approx(DECAY, rel=2e-3)
