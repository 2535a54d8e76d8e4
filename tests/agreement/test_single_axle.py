"""The full plant reduced to one axle with a first-order actuator is the source's vehicle model."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import railgrip as rg
from railgrip.contact.kalker_1990 import kalker_slope
from railgrip.contact.rail_friction import RailFriction
from railgrip.control.temperature_controlled import TemperatureControlled
from railgrip.core.constants import GRAVITY
from railgrip.laboratory.single_axle import Course, SingleAxle, polach_force, single_axle

MASS, ROTATING, FORCE, LAG, SPEED = 13e3, 1040.0, 16e3, 0.06, 40.0
ONE = SingleAxle(MASS, ROTATING, FORCE, LAG)
CONTINUED: dict[str, Any] = {"wheelbase": 0.0, "mass": 10.0, "height": 0.5, "traction_height": 0.8}
"""The second axle carries nothing and is not braked: it shows the true speed, as in the model."""


def plant(rail: RailFriction, **changes: Any) -> rg.Result:
    axle = {"rotating_mass": ROTATING, "wheel_radius": 0.425, "brake": "emb", "load_share": 1.0}
    shows = {"rotating_mass": 1e-3, "wheel_radius": 0.425, "load_share": 1e-6}
    brake = {
        "kind": "disc", "cylinder_pressure": 3e5, "cylinder_area": 0.01, "rigging_ratio": 1.0,
        "rigging_efficiency": 1.0, "friction_radius": 0.425, "fill": "lag", "lag": LAG,
        "dead_time": 0.0, "units": 1.0, "pad": {"law": "constant", "friction": FORCE / 3e3 / 10},
    }  # fmt: skip
    brake["rigging_ratio"] = 10.0
    vehicle = {
        "length": 12.0, "tare": MASS, "body_height": 0.8, "pivot_distance": 8.0,
        "bogie": [{**CONTINUED, "axle": [axle]}, {**CONTINUED, "axle": [shows]}],
    }  # fmt: skip
    sensor = {"teeth": 1000, "timer": 1e-7, "delay": 0.0}
    return rg.simulate(
        rg.Scenario(
            train={"brakes": {"emb": brake}, "sensor": sensor, "vehicle": [vehicle]},
            line={"use": {"length": 50e3}, "start": 1000.0},
            rail={"condition": {"contaminated": rail._asdict()}},
            run={"speed": SPEED, "demand": 1.0, "trace": 0.01},
            wsp={"controller": "temperature_controlled"},
        ).with_(changes)
    )


def model(rail: RailFriction) -> Course:
    load = MASS * GRAVITY
    slope = 2 * kalker_slope(load / 2, 0.425, np.inf, 0.3, 210e9, 0.28)
    force = polach_force(rail, load, slope)
    return single_axle(TemperatureControlled(), ONE, force, speed=SPEED)


@pytest.mark.parametrize(
    "rail",
    [
        RailFriction(0.06, 1.0, 0.0, 1.0, 0.4),
        RailFriction(0.08, 0.4, 0.2, 1.0, 0.4),
        RailFriction(0.3, 0.4, 0.2, 0.3, 0.1),
    ],
    ids=["constant", "falling", "wet"],
)
def test_the_plant_of_one_axle_is_the_model(rail: RailFriction) -> None:
    """0.5 % of distance and of the greatest speed, all the way down to walking pace."""
    result, course = plant(rail), model(rail)
    assert result.status.name == "STOPPED"
    distance = float(result["stopping_distance"].values[0])
    assert distance == pytest.approx(float(course.position[-1]), rel=5e-3)
    n = int(np.argmax(course.train_speed < 1.5))
    for ours, theirs in (
        (result["train_speed"].values[0], course.train_speed),
        (result["wheel_speed"].values[0, 0], course.wheel_speed),
    ):
        assert np.abs(ours[:n] - theirs[:n]).max() < 5e-3 * SPEED


def test_what_is_no_vehicle_is_refused() -> None:
    with pytest.raises(rg.RailgripError, match="the rotating mass must be positive"):
        single_axle(
            TemperatureControlled(), ONE._replace(rotating_mass=0.0), lambda w, v: 0.0, speed=1.0
        )
    with pytest.raises(rg.RailgripError, match="must not be negative"):
        single_axle(TemperatureControlled(), ONE, lambda w, v: 0.0, speed=-1.0)
