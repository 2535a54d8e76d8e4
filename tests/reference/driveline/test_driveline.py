"""Natural frequency, damping and stability of the driveline against the linear equations."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

import railgrip as rg
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.engine import layout
from railgrip.engine.simulate import prepare

STIFFNESS, SHARE, RADIUS, ROTATING = 5.0e6, 0.7, 0.625, 3.7e3
SPRING = STIFFNESS / RADIUS**2
MOTOR, WHEELSET = SHARE * ROTATING, (1.0 - SHARE) * ROTATING
REDUCED = MOTOR * WHEELSET / ROTATING
STEP = 1.0e-3
UNLOADED = {"TRAIN_MASS": [1e15]}
"""A train whose speed and wheel loads nothing changes."""


def scenario(rail: Any, speed: float, level: float, damping: float) -> rg.Scenario:
    """Return a locomotive whose motors come within 50 ms."""
    start = rg.load("start_leaves").with_({"train": "locomotive_bobo"})
    return start.with_(
        {
            "train.traction.build_up": 0.05,
            "train.traction.driveline": {
                "stiffness": STIFFNESS, "damping": damping, "motor_share": SHARE,
            },
            "rail": rail,
            "line.use": {"length": 15e3},
            "run": {
                "speed": speed, "demand": "none", "drive": level, "duration": 2.4, "step": STEP,
                "trace": STEP,
            },
            "wsp": {"controller": "none"},
        }
    )  # fmt: skip


def own_rail(ratio: float, decay: float) -> dict[str, Any]:
    state = {
        "static_friction": 0.2, "friction_ratio": ratio, "friction_decay": decay,
        "adhesion_reduction": 1.0, "slip_reduction": 0.4,
    }  # fmt: skip
    return {"condition": {"cleaning": 0.0, "contaminated": state, "clean": state}}


@cache
def run(name: str, speed: float, level: float, damping: float) -> tuple[Any, Any]:
    rail = {"dry": {"condition": "dry"}, "flat": own_rail(1.0, 0.0), "falling": own_rail(0.4, 0.05)}
    described = scenario(rail[name], speed, level, damping)
    return described, rg.simulate(described, variations=UNLOADED).data.isel(run=0, axle=0)


def complex_rate(torque: Any, order: int) -> complex:
    """Return the complex rate of the oscillation in a signal, [1/s]."""
    change = np.diff(torque)
    rows = np.array([change[i : i + order] for i in range(len(change) - order)])
    recurrence = np.linalg.lstsq(rows, change[order:], rcond=None)[0]
    roots = np.roots([1.0, *(-recurrence[::-1])])
    rates = np.log(roots[np.abs(roots) > 0.3].astype(complex)) / STEP
    swinging = [rate for rate in rates if 30.0 < rate.imag < 300.0]
    return complex(max(swinging, key=lambda rate: rate.real))


def torque_while_it_spins(data: Any, above: float, below: float) -> Any:
    """Return the shaft's torque from a first spin until another, [N m]."""
    spin = data["wheel_speed"].values - data["train_speed"].values
    return data["driveline_torque"].values[np.argmax(spin > above) : np.argmax(spin > below)]


def numbers_of_axle(described: rg.Scenario) -> dict[str, float]:
    row = prepare(described, None).plan.parameters[1]
    return {name: row[i] for i, name in enumerate(layout.AXLE_PARAMETERS.split())}


def creep_slope(described: rg.Scenario) -> tuple[float, float]:
    """Return the slope of the creep curve at no creepage [N], and the relaxation length [m]."""
    number = numbers_of_axle(described)
    rail = RailFriction(0.55, 0.4, 0.6, 1.0, 0.4)
    force = polach_2005(rail, number["STATIC_LOAD"], number["KALKER_SLOPE"], 0.0, 1e-6)
    return force / 1e-6, number["RELAXATION_LENGTH"]


@pytest.mark.parametrize("speed", [5.0, 40.0])
def test_motor_swings_on_an_adhering_wheelset(speed: float) -> None:
    damping = 2500.0
    described, data = run("dry", speed, 0.05, damping)
    slope, relaxation = creep_slope(described)
    d = damping / RADIUS**2
    matrix = np.array(
        [  # w_m, w, x, T
            [-d / MOTOR, d / MOTOR, -SPRING / MOTOR, 0.0],
            [d / WHEELSET, -d / WHEELSET, SPRING / WHEELSET, -1.0 / WHEELSET],
            [1.0, -1.0, 0.0, 0.0],
            [0.0, slope / relaxation, 0.0, -speed / relaxation],
        ]
    )
    expected = max(np.linalg.eigvals(matrix), key=lambda rate: (0 < rate.imag < 300, rate.imag))
    time = data["time"].values
    found = complex_rate(data["driveline_torque"].values[(time > 0.06) & (time < 0.4)], 4)
    assert found.imag == pytest.approx(expected.imag, rel=5e-3)
    assert found.real == pytest.approx(expected.real, rel=3e-2)


def test_both_swing_when_the_wheelset_spins() -> None:
    """Free: the reduced mass on the shaft, 20.4 Hz; 4 m/s of spin and more, friction 0.2."""
    damping = 2500.0
    _, data = run("flat", 10.0, 0.75, damping)
    found = complex_rate(torque_while_it_spins(data, 4.0, 8.0), 4)
    frequency = np.sqrt(SPRING / REDUCED)
    ratio = damping / RADIUS**2 / (2.0 * REDUCED * frequency)
    assert abs(found) == pytest.approx(frequency, rel=5e-3)
    assert -found.real / abs(found) == pytest.approx(ratio, abs=1e-3)


@pytest.mark.parametrize("over_limit", [0.5, 1.5])
def test_falling_friction_feeds_the_oscillation_up_to_a_known_limit(over_limit: float) -> None:
    """Damping half of what the limit asks: it grows; half as much again: it dies away."""
    spin, speed = 6.0, 10.0
    number = numbers_of_axle(scenario(own_rail(0.4, 0.05), speed, 0.7, 1000.0))
    rail = RailFriction(0.2, 0.4, 0.05, 1.0, 0.4)
    force = [
        polach_2005(rail, number["STATIC_LOAD"], number["KALKER_SLOPE"], s, s / (speed + s))
        for s in (spin - 0.1, spin + 0.1)
    ]
    limit = (force[0] - force[1]) / 0.2 * (MOTOR / ROTATING) ** 2
    _, data = run("falling", speed, 0.7, over_limit * limit * RADIUS**2)
    found = complex_rate(torque_while_it_spins(data, spin - 2.0, spin + 2.0), 4)
    expected = (1.0 - over_limit) * limit / (2.0 * REDUCED)
    assert found.real == pytest.approx(expected, abs=0.02)
