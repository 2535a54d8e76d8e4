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
from railgrip.control.adaptive_wsp import AdaptiveWSP
from railgrip.control.contract import Command, Measured, Setup
from railgrip.control.conventional_wsp import ConventionalWSP
from railgrip.control.no_protection import NoProtection
from railgrip.control.temperature_controlled import TemperatureControlled
from railgrip.engine.mixture import mixture
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


ALL = tuple(range(16))
FIRST_TWO, LAST_TWO = tuple(range(8)), tuple(range(8, 16))
APART = (tuple(range(0, 16, 2)), tuple(range(1, 16, 2)))
"""Every second axle: rows that do not lie side by side."""


def _leaves() -> rg.Scenario:
    return rg.load("leaves_160").with_({"run.speed": "60 km/h"})


def _mixed_controllers() -> list[Any]:
    return [AdaptiveWSP(), ConventionalWSP()]


@pytest.mark.parametrize("controller", [ConventionalWSP, AdaptiveWSP, TemperatureControlled])
def test_one_unit_for_all_axles_is_the_controller_alone(controller: Any) -> None:
    alone = rg.simulate(_leaves(), controller=controller())
    assert alone["axle_valve_cycles"].values.sum() > 0
    assert_same(rg.simulate(_leaves(), controller=mixture([controller()], [ALL])), alone)
    plain = mixture([OnlyPlain(controller())], [ALL])
    assert_same(rg.simulate(_leaves(), controller=plain), alone)


@pytest.mark.parametrize("axles", [(FIRST_TWO, LAST_TWO), APART], ids=["halves", "every second"])
@pytest.mark.parametrize("plain", [(True, True), (True, False), (False, True)], ids=str)
def test_units_compiled_and_plain(axles: Any, plain: tuple[bool, bool]) -> None:
    """Any of the units may be plain Python; the bits do not depend on it."""
    compiled = rg.simulate(_leaves(), controller=mixture(_mixed_controllers(), list(axles)))
    assert (compiled["axle_valve_cycles"].values[0] > 0).any()
    controllers = [
        OnlyPlain(controller) if is_plain else controller
        for controller, is_plain in zip(_mixed_controllers(), plain, strict=True)
    ]
    assert_same(rg.simulate(_leaves(), controller=mixture(controllers, list(axles))), compiled)


def test_units_of_different_periods() -> None:
    """A unit that looks every 30 ms stands beside one of 10 ms; plain and compiled alike."""
    controllers = [ConventionalWSP(period=0.03), ConventionalWSP()]
    halves = [FIRST_TWO, LAST_TWO]
    compiled = rg.simulate(_leaves(), controller=mixture(controllers, halves))
    plain = [OnlyPlain(controller) for controller in controllers]
    assert_same(rg.simulate(_leaves(), controller=mixture(plain, halves)), compiled)
    every = rg.simulate(_leaves(), controller=mixture([ConventionalWSP()] * 2, halves))
    assert not np.array_equal(every["axle_slid_energy"].values, compiled["axle_slid_energy"].values)


def test_units_in_the_lanes() -> None:
    """A batch of mixed protection gives each run the bits that it has alone."""
    varied = {"INITIAL_SPEED": np.linspace(8.0, 16.0, 20)}
    whole = mixture(_mixed_controllers(), [FIRST_TWO, LAST_TWO])
    batch = rg.simulate(_leaves(), runs=20, variations=varied, controller=whole)
    for i in (0, 19):
        alone = rg.simulate(
            _leaves(), variations={"INITIAL_SPEED": varied["INITIAL_SPEED"][i : i + 1]},
            controller=whole, traces=False,
        )  # fmt: skip
        for name in ("stopping_distance", "axle_slid_energy", "axle_valve_cycles"):
            assert np.array_equal(batch[name].values[i], alone[name].values[0]), name


class Witness:
    """Notes what it was told and what it saw; brakes on."""

    period = 0.01

    def reset(self, setup: Setup) -> list[Measured]:
        self.setup = setup
        self.seen: list[Measured] = []
        return self.seen

    def step(self, state: list[Measured], measured: Measured, dt: float) -> Command:
        state.append(measured)
        n = len(measured.wheel_speed)
        return Command(np.zeros(n), np.ones(n), np.zeros(n), float(measured.wheel_speed[0]))


def test_a_unit_sees_its_own_axles_only() -> None:
    """Rows, setup and the count of its bogies are its own, and so is its reference speed."""
    witness = Witness()
    scenario = _leaves().with_({
        "wsp.unit": [{"controller": "none", "vehicles": [1, 2, 4]}, {"vehicles": [3]}],
        "run.trace": "10 ms",
    })  # fmt: skip
    own = scenario.wsp.unit[1].places(scenario.train)
    others = scenario.wsp.unit[0].places(scenario.train)
    result = rg.simulate(scenario, controller=mixture([NoProtection(), witness], [others, own]))
    assert own == (8, 9, 10, 11)
    assert witness.setup.n_axles == 4
    assert witness.setup.vehicle is not None
    assert witness.setup.bogie is not None
    assert witness.setup.vehicle.tolist() == [0.0] * 4
    assert witness.setup.bogie.tolist() == [0.0, 0.0, 1.0, 1.0]
    seen = np.array([measured.wheel_speed for measured in witness.seen])
    measured = result["measured_speed"].values[0, 8:12].T
    assert np.array_equal(seen[: len(measured) - 1], measured[1 : len(seen) + 1])
    believed = result["unit_reference_speed"].values[0]
    assert np.array_equal(believed[8], believed[11])
    assert not np.array_equal(believed[8, 1:-1], believed[0, 1:-1])
    assert np.array_equal(believed[8, 1 : len(seen)], seen[: len(seen) - 1, 0])


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
