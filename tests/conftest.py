"""What all tests share: Hypothesis without a clock, shipped runs, and a plain coach to vary."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from typing import Any

import hypothesis
import pytest

import railgrip as rg

# The first example may have to compile a kernel. A change is judged on the same examples each time;
# whoever runs the tests by hand draws new ones.
hypothesis.settings.register_profile("railgrip", deadline=None)
hypothesis.settings.register_profile("ci", deadline=None, derandomize=True)
hypothesis.settings.load_profile(os.environ.get("RAILGRIP_TESTS", "railgrip"))

AXLE = {"count": 2, "rotating_mass": 800.0, "wheel_radius": 0.45, "brake": "disc"}
BOGIE = {"count": 2, "wheelbase": 2.5, "mass": 6e3, "axle": [AXLE]}
VEHICLE = {"length": 26.0, "tare": 44e3, "pivot_distance": 19.0, "bogie": [BOGIE]}
BRAKE = {
    "kind": "disc",
    "cylinder_pressure": 3e5,
    "cylinder_area": 0.0324,
    "rigging_ratio": 5.0,
    "units": 2.0,
    "friction_radius": 0.27,
    "pad": {"law": "constant", "friction": 0.35},
    "fill": "linear",
    "dead_time": 0.0,
    "fill_time": 0.5,
    "release_time": 0.5,
}

Shipped = Callable[[str], "rg.Result"]
Coach = Callable[..., "rg.Scenario"]


@pytest.fixture(scope="session")
def shipped() -> Shipped:
    """Shipped scenarios, each run once with its traces."""

    @cache
    def run(name: str) -> rg.Result:
        return rg.simulate(rg.load(name))

    return run


def build_coach(
    adhesion: float = 0.1,
    *,
    friction_ratio: float = 1.0,
    friction_decay: float = 0.0,
    gradient: float = 0.0,
    start: float = 2000.0,
    length: float = 100e3,
    controller: str = "none",
    brake: dict[str, Any] | None = None,
    train: dict[str, Any] | None = None,
    **run: Any,
) -> rg.Scenario:
    """A coach of 44 t without resistance on rail of one friction; everything else is added."""
    table = {
        "brakes": {"disc": {**BRAKE, **(brake or {})}},
        "dump_valve": {},
        "vehicle": [VEHICLE],
        **(train or {}),
    }
    line: dict[str, Any] = {"length": length}
    if gradient:
        line["gradient"] = [{"at": 0.0, "value": gradient}]
    friction = {
        "static_friction": adhesion,
        "friction_ratio": friction_ratio,
        "friction_decay": friction_decay,
    }
    return rg.Scenario(
        train=table,
        line={"use": line, "start": start},
        rail={"condition": {"contaminated": friction}},
        run={"speed": 100 / 3.6, "time_limit": 600.0, **run},
        wsp={"controller": controller},
    )


@pytest.fixture(scope="session")
def coach() -> Coach:
    """The builder of plain coaches."""
    return build_coach
