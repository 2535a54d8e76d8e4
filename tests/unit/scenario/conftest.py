"""A small complete scenario as a table, to be spoiled one way a test."""

from __future__ import annotations

import json
from typing import Any

import pytest

AXLE = {"count": 2, "rotating_mass": "700 kg", "wheel_radius": "0.445 m", "brake": "disc"}
BOGIE = {"count": 2, "wheelbase": "2.5 m", "mass": "6 t", "axle": [AXLE]}
VEHICLE = {"length": "26.4 m", "tare": "44 t", "pivot_distance": "19 m", "bogie": [BOGIE]}
DISC_BRAKE = {
    "kind": "disc",
    "cylinder_pressure": "3.0 bar",
    "cylinder_area": "324 cm^2",
    "cylinder_spring": "-500 N",
    "rigging_ratio": 5,
    "friction_radius": "0.27 m",
    "pad": {"law": "constant", "friction": 0.35},
}
TABLE = {
    "train": {
        "brakes": {"disc": DISC_BRAKE},
        "vehicle": [VEHICLE, {**VEHICLE, "count": 2, "payload": "6 t", "payload_max": "10 t"}],
    },
    "line": {"use": {"length": "5 km"}},
    "rail": {"condition": {"contaminated": {"static_friction": 0.08}}},
    "run": {"speed": "160 km/h"},
}


@pytest.fixture
def table() -> dict[str, Any]:
    return json.loads(json.dumps(TABLE))  # no part shared with another
