"""At a steady brake force the plant's creepage is the one where Polach's curve gives that force."""

from __future__ import annotations

import numpy as np
import pytest

import railgrip as rg
from railgrip.core.constants import GRAVITY

FORCE = 2 * 16138.10
"""Of an axle at 1 % creepage, wet, 20 m/s, N."""


def settled(force: float) -> tuple[float, float]:
    """Return creepage and contact force of an axle under a steady brake force at 20 m/s."""
    axle = {"count": 2, "rotating_mass": 500.0, "wheel_radius": 0.46, "brake": "b"}
    bogie = {"count": 2, "wheelbase": 2.5, "mass": 6e3, "axle": [axle]}
    brake = {
        "kind": "block", "cylinder_pressure": 1e5, "cylinder_area": force / 1e5,
        "rigging_ratio": 1.0, "pad": {"law": "constant", "friction": 1.0}, "fill": "linear",
        "dead_time": 0.0, "fill_time": 2.0,
    }  # fmt: skip
    tare = 4 * 200e3 / GRAVITY
    vehicle = {"length": 26.0, "tare": tare, "pivot_distance": 19.0, "bogie": [bogie]}
    scenario = rg.Scenario(
        train={"brakes": {"b": brake}, "vehicle": [vehicle]},
        rail={"condition": "wet"},
        run={"speed": 20.0, "time_limit": 6.0},
        wsp={"controller": "none"},
    )
    # a train so heavy that its speed stays
    data = rg.simulate(scenario, variations={"TRAIN_MASS": [1e15]}).data
    last = data.isel(time=-2, run=0)
    assert np.ptp(last["creepage"].values) < 1e-12
    return float(last["creepage"].values[0]), float(last["contact_force"].values[0])


def test_the_force_at_one_per_cent() -> None:
    creepage, force = settled(FORCE)
    assert force == pytest.approx(-FORCE, rel=1e-9)
    assert creepage == pytest.approx(-0.01, rel=1e-4)


def test_the_initial_slope() -> None:
    """Small forces: (k_A + k_S)/2 = 0.2 of Kalker's 2 × 14.5237 MN, within 0.1 %."""
    creepage, force = settled(500.0)
    assert force / creepage == pytest.approx(0.2 * 2 * 14.523733e6, rel=1e-3)
