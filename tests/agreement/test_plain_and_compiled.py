"""A controller or a creep law gives the same bits as plain Python and compiled into the plant."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba
import numpy as np
import pytest
from tests.conftest import Coach

import railgrip as rg
from railgrip.compiler import inlined
from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005, RailFriction
from railgrip.control.contract import Command, Measured, Setup
from railgrip.control.conventional_wsp import ConventionalWSP
from railgrip.control.no_protection import NoProtection
from railgrip.engine.plug_ins import creep_law


class OnlyPlain:
    """A controller without its compiled form: the engine steps it from Python."""

    def __init__(self, inner: Any) -> None:
        self.inner, self.period = inner, inner.period

    def reset(self, setup: Setup) -> Any:
        return self.inner.reset(setup)

    def step(self, state: Any, measured: Measured, dt: float) -> Command:
        command: Command = self.inner.step(state, measured, dt)
        return command


def assert_same(one: rg.Result, other: rg.Result) -> None:
    assert set(one.data) == set(other.data)
    for name in one.data:
        assert np.array_equal(one[name].values, other[name].values, equal_nan=True), name


@pytest.mark.parametrize(
    ("scenario", "speed"),
    [
        ("coach_leaves", "60 km/h"),
        ("wheel_diameters", "120 km/h"),
        ("detergent_160", "70 km/h"),
        ("sanded_leaves", "60 km/h"),
    ],
)
def test_conventional_protection(scenario: str, speed: str) -> None:
    """Traces and outcomes of a stop with slides, bit for bit; the last two with sand."""
    described = rg.load(scenario).with_({"run.speed": speed})
    compiled = rg.simulate(described, controller=ConventionalWSP())
    assert compiled["axle_valve_cycles"].values.sum() > 0
    assert_same(rg.simulate(described, controller=OnlyPlain(ConventionalWSP())), compiled)


def test_no_protection(coach: Coach) -> None:
    described = coach(0.05, speed=15.0)
    compiled = rg.simulate(described, controller=NoProtection())
    assert_same(rg.simulate(described, controller=OnlyPlain(NoProtection())), compiled)


def test_a_controller_slower_than_the_step(coach: Coach) -> None:
    """Period 40 ms at a step of 10 ms: commands stand in between, plain and compiled alike."""
    described = coach(0.05, speed=15.0)
    slow = ConventionalWSP(period=0.04)
    compiled = rg.simulate(described, controller=slow)
    assert_same(rg.simulate(described, controller=OnlyPlain(slow)), compiled)
    fast = rg.simulate(described, controller=ConventionalWSP())
    assert fast["stopping_distance"].values[0] != compiled["stopping_distance"].values[0]


def test_each_run_begins_with_a_fresh_controller(coach: Coach) -> None:
    described = coach(0.05, speed=15.0)
    three = rg.simulate(described, controller=OnlyPlain(ConventionalWSP()), runs=3)
    assert len(set(three["stopping_distance"].values.tolist())) == 1


def points(count: int) -> np.ndarray:
    generator = np.random.default_rng(11)
    lows, highs = (1e4, 5e6, 0.0, 1e-6), (1.5e5, 2e7, 20.0, 1.0)
    return generator.uniform(lows, highs, (count, 4))


@pytest.mark.parametrize("rail", [DRY_POLACH_2005, WET_POLACH_2005])
def test_the_creep_law(rail: RailFriction) -> None:
    """As the kernel has it and as the engine passes on somebody's own law."""
    compiled: Callable[..., float] = inlined(polach_2005)
    driver = numba.njit(error_model="numpy")(lambda *given: compiled(*given))
    foreign = creep_law(polach_2005)
    for load, slope, slip_speed, creepage in points(200).tolist():
        plain = polach_2005(rail, load, slope, slip_speed, creepage)
        assert driver(rail, load, slope, slip_speed, creepage) == plain
        assert foreign.ctypes(*rail, load, slope, slip_speed, creepage) == plain


def test_the_limit_of_friction() -> None:
    compiled: Callable[..., float] = inlined(falling_friction)
    driver = numba.njit(error_model="numpy")(lambda *given: compiled(*given))
    for slip_speed in np.linspace(0.0, 60.0, 200).tolist():
        plain = falling_friction(WET_POLACH_2005, slip_speed)
        assert driver(WET_POLACH_2005, slip_speed) == plain
