"""Halving the step divides the error by four: valves replayed by time, rail uniform, cells passed.

A threshold protection is chaotic, so its commands are replayed instead; delays are whole steps at
every step length (zero here). The reference is the same stop at 1 ms. Over three halvings the mean
order must be above 1.7: kinks (a pressure that reaches its end within a step, a wheel that locks)
cost a little of 2, and scatter the single halvings.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.conftest import Coach

import railgrip as rg
from railgrip.control.contract import FILL, HOLD, VENT, Command, Measured, Setup

STEPS = (0.02, 0.01, 0.005, 0.0025)
REFERENCE = 0.001


class Replay:
    """Valve commands by time alone: each axle vents, holds and fills in turn, or never does."""

    period = 0.02

    def __init__(self, *, works: bool) -> None:
        self.works = works

    def reset(self, setup: Setup) -> list[int]:
        return [0, setup.n_axles]

    def step(self, state: list[int], measured: Measured, dt: float) -> Command:
        tick, n_axles = state
        state[0] += 1
        valves = [self.valve(tick * dt, axle) if self.works else FILL for axle in range(n_axles)]
        ones = np.ones(n_axles)
        return Command(np.array(valves), ones, np.zeros(n_axles), 0.0)

    @staticmethod
    def valve(time: float, axle: int) -> float:
        phase = (time + 0.32 * axle) % 2.0
        if time < 3.0 or phase >= 0.6:
            return FILL
        return VENT if phase < 0.2 else HOLD


def stop(coach: Coach, step: float, *, works: bool, adhesion: float, ratio: float) -> float:
    scenario = coach(
        adhesion, friction_ratio=ratio, friction_decay=0.1, step=step, trace=0.02,
        brake={"fill_time": 2.0},
        train={
            "dump_valve": {"vent_delay": 0.0, "fill_delay": 0.0},
            "sensor": {"delay": 0.0},
            "resistance": {"constant": 2000.0, "quadratic": 4.0},
        },
    )  # fmt: skip
    result = rg.simulate(scenario, controller=Replay(works=works), traces=False)
    slides = float(result["axle_slide_time"].values.max()) > 1.0
    assert slides == (adhesion < 0.2)
    return float(result["stopping_distance"].values[0])


def errors(coach: Coach, **case: float) -> np.ndarray:
    exact = stop(coach, REFERENCE, **case)  # type: ignore[arg-type]
    return np.array([abs(stop(coach, step, **case) - exact) for step in STEPS])  # type: ignore[arg-type]


CASES = {
    "rolling": {"works": False, "adhesion": 0.5, "ratio": 1.0},
    "rolling, valves at work": {"works": True, "adhesion": 0.5, "ratio": 1.0},
    "sliding, constant friction": {"works": True, "adhesion": 0.12, "ratio": 1.0},
    "sliding, falling friction": {"works": True, "adhesion": 0.12, "ratio": 0.7},
    "locking": {"works": False, "adhesion": 0.1, "ratio": 1.0},
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_order(coach: Coach, case: dict[str, float]) -> None:
    found = errors(coach, **case)
    assert (np.diff(found) < 0.0).all(), found
    order = np.log2(found[0] / found[-1]) / (len(STEPS) - 1)
    assert order > 1.7, found


def test_order_with_a_dynamic_brake() -> None:
    """The four-car unit on dry rail: blending, fading, heat and pads that feel speed and heat."""
    described = rg.load("dry_emergency").with_({
        "train.dump_valve.vent_delay": 0.0,
        "train.dump_valve.fill_delay": 0.0,
        "train.sensor.delay": 0.0,
        "run.trace": 0.02,
    })  # fmt: skip

    def distance(step: float) -> float:
        scenario = described.with_({"run.step": step})
        result = rg.simulate(scenario, controller=Replay(works=False), traces=False)
        return float(result["stopping_distance"].values[0])

    exact = distance(REFERENCE)
    found = np.array([abs(distance(step) - exact) for step in STEPS])
    assert np.log2(found[0] / found[-1]) / (len(STEPS) - 1) > 1.7, found


def test_the_protection_does_not_feel_the_step() -> None:
    """On dry rail no valve works, at whatever step the plant is computed."""
    described = rg.load("dry_emergency").with_({
        "train.dump_valve.vent_delay": 0.0,
        "train.dump_valve.fill_delay": 0.0,
        "run.trace": 0.02,
    })  # fmt: skip
    for step in (0.01, 0.002, 0.001):
        result = rg.simulate(described.with_({"run.step": step}), traces=False)
        assert result["axle_valve_cycles"].values.sum() == 0.0, step
