"""The driveline in the plant: energy, bits, refusals, and what traction control makes of it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import railgrip as rg
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.core.errors import RailgripError
from railgrip.engine import layout
from railgrip.engine.simulate import prepare

SHAFT: dict[str, Any] = {
    "stiffness": "5 MN*m/rad", "damping": "2.5 kN*m*s/rad", "motor_share": 0.7,
}  # fmt: skip
HOLD_SLIP = Path(__file__).parents[2] / "docs/examples/experiments/hold_slip.py"
RADIUS, ROTATING = 0.625, 3.7e3


def start(condition: str, shaft: Any = SHAFT, **changes: Any) -> rg.Scenario:
    locomotive = rg.load("start_leaves").with_({"train": "locomotive_bobo"})
    run = {
        "speed": 0.0, "demand": "none", "drive": 1.0, "duration": 15.0, "step": 0.002,
        "trace": 0.002,
    }  # fmt: skip
    return locomotive.with_(
        {
            "train.traction.driveline": shaft,
            "rail.condition": condition,
            "run": run,
        }
    ).with_(changes)


def test_energy_closes_and_the_shaft_took_what_it_stores_and_damps() -> None:
    result = rg.simulate(start("dry"))
    assert abs(float(result["energy_balance"].values[0])) < 1e-11
    run = result.data.isel(run=0)
    lead = (run["motor_speed"] - run["wheel_speed"]).values
    spring, damper = 5e6 / RADIUS**2, 2.5e3 / RADIUS**2
    twist = (run["driveline_torque"].values / RADIUS - damper * lead) / spring
    stored = 0.5 * spring * (twist[:, -1] ** 2).sum()
    lost = damper * np.trapezoid(lead**2, run["time"].values, axis=1).sum()
    # of second order in the step: 1.7e-5 of the motors' work at 2 ms
    error = float(run["energy_driveline"]) - stored - lost
    assert abs(error) < 5e-5 * float(run["energy_traction"])
    assert stored > 200.0


def test_a_stiff_shaft_is_a_rigid_one() -> None:
    """Four times as stiff, damped: the start differs by 2 % at most."""
    stiff = {"stiffness": 20e6, "damping": 20e3, "motor_share": 0.7}
    change = {"wsp": {"controller": "conventional_traction"}}
    shaft = rg.simulate(start("wet", stiff, **change))
    rigid = rg.simulate(start("wet", None, **change))
    found = float(shaft["covered_distance"].values[0])
    assert found == pytest.approx(float(rigid["covered_distance"].values[0]), rel=0.02)
    assert "motor_speed" in shaft.data
    assert "motor_speed" not in rigid.data


def test_alone_and_in_company_a_run_gives_the_same_bits() -> None:
    described = start("dry", **{"run.duration": 2.0})
    alone = rg.simulate(described)["energy_driveline"].values
    many = rg.simulate(described, runs=17)["energy_driveline"].values
    assert np.array_equal(many, np.repeat(alone, 17))


def swings(result: rg.Result, axle: int = 0) -> np.ndarray:
    """Return the deviation of the torque from its mean of 0.1 s, for each half second, [N m]."""
    torque = result["driveline_torque"].values[0, axle]
    off = (torque - np.convolve(torque, np.ones(50) / 50, "same"))[25:-25]
    parts: np.ndarray = off[: len(off) // 250 * 250].reshape(-1, 250).std(axis=1)
    return parts


def swing(result: rg.Result) -> float:
    """Return the same over the last 4 s."""
    torque = result["driveline_torque"].values[0, 0, -2000:]
    mean = np.convolve(torque, np.ones(50) / 50, "valid")
    return float(np.std(torque[25 : 25 + len(mean)] - mean))


def held(damping: float) -> rg.Result:
    """Return a start of the four-car unit on dry rail, driven wheels held at 1 m/s of slip."""
    unit = rg.load("start_leaves").with_({"train": "emu_four_car", "rail": {"condition": "dry"}})
    return rg.simulate(
        unit.with_(
            {
                "train.traction.driveline": dict(SHAFT, damping=damping),
                "train.traction.force": "900 kN", "train.traction.power": "40 MW",
                "wsp": {"controller": str(HOLD_SLIP)},
                "run": {"speed": 0.0, "demand": "none", "drive": 1.0, "duration": 9.5,
                        "step": 0.002, "trace": 0.002},
            }
        )
    )  # fmt: skip


def limit(result: rg.Result, axle: int = -1, slip: float = 1.0, speed: float = 7.5) -> float:
    """Return the least damping at which the swing dies, by the slope of the creep curve."""
    row = prepare(result.scenario, None).plan.parameters[1:][axle]
    numbers = {name: row[i] for i, name in enumerate(layout.AXLE_PARAMETERS.split())}
    found = result.scenario.rail.condition.contaminated.model_dump()
    rail = RailFriction(*(found[name] for name in RailFriction._fields))

    def force(w: float) -> float:
        load, slope = numbers["STATIC_LOAD"], numbers["KALKER_SLOPE"]
        return float(polach_2005(rail, load, slope, w, w / (speed + w)))

    fall = (force(slip - 0.01) - force(slip + 0.01)) / 0.02
    return float(fall * SHAFT["motor_share"] ** 2 * numbers["WHEEL_RADIUS"] ** 2)


def test_falling_friction_of_dry_rail_makes_a_weakly_damped_shaft_stick_and_slip() -> None:
    """The swing grows below the known limit and dies above it; far below, the wheelset sticks."""
    bound = limit(held(1e3))
    assert bound == pytest.approx(1.29e3, rel=0.02)
    grows, dies = swings(held(0.6 * bound), -1), swings(held(1.3 * bound), -1)
    assert grows[17] > 3.0 * grows[11] > 20.0
    assert dies[11:18].max() < 20.0
    loud = held(0.2e3)
    grown = swings(loud, -1)
    assert grown[-3:].min() > 20e3
    assert grown[-1] < 1.3 * grown[-3]
    torque = loud["driveline_torque"].values[0, -1]
    mean = float(torque[2000:2500].mean())
    assert np.abs(torque).max() < 4.0 * mean
    moving = loud["time"].values > 7.0
    wheel, train = loud["wheel_speed"].values[0, -1], loud["train_speed"].values[0]
    assert (wheel - train)[moving].min() < 0.05


def test_a_swinging_wheel_is_told_as_a_trembling_sensor() -> None:
    """With a protection that doubts sensors the motor lets go before the wheelset sticks."""
    deep = {"start": 2, "decide_distance": 1e9, "macro_slip": 0.01, "macro_slip_floor": 1.0}
    spinning = {
        "train.traction.force": "700 kN", "train.traction.power": "20 MW", "run.duration": 4.0,
        "wsp": {"controller": "adaptive_traction", "parameters": deep},
    }  # fmt: skip
    quiet = rg.simulate(start("dry", **spinning))
    loud = rg.simulate(start("dry", dict(SHAFT, damping="0.2 kN*m*s/rad"), **spinning))
    assert loud["wsp_alarm"].values[0].max() == 1.0
    assert quiet["wsp_alarm"].values[0].max() == 0.0


@pytest.mark.parametrize(
    ("controller", "parameters"),
    [
        ("conventional_traction", {}),
        ("peak_seeking_traction", {}),
        ("peak_seeking_traction", {"slip_gain": 12.0}),
    ],
)
def test_traction_control_does_not_swing_the_shaft(
    controller: str, parameters: dict[str, float]
) -> None:
    """On leaves, with three times the gain too: swings stay below a tenth of the torque."""
    wsp = {"wsp": {"controller": controller, "parameters": parameters}}
    shaft = rg.simulate(start("leaves", **wsp))
    rigid = rg.simulate(start("leaves", None, **wsp))
    torque = shaft["driveline_torque"].values[0, 0, -2500:]
    assert swing(shaft) < 0.1 * torque.mean()
    covered = [float(r["covered_distance"].values[0]) for r in (shaft, rigid)]
    assert covered[0] == pytest.approx(covered[1], rel=0.03)


def test_a_step_too_long_and_a_shaft_that_only_creeps_are_refused() -> None:
    with pytest.raises(RailgripError, match=re.escape("run.step: is too long for the driveline")):
        rg.simulate(start("dry", **{"run.step": 0.01, "run.trace": 0.02}))
    dead = dict(SHAFT, damping="1000 kN*m*s/rad")
    with pytest.raises(RailgripError, match=re.escape("train.traction.driveline.damping: must")):
        rg.simulate(start("dry", dead))
