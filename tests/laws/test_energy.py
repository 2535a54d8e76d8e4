"""Energy: what the train had is found again, term by term, and an error of 1 % is noticed.

Balance: kinetic energy lost = work of contact, friction brake, dynamic brake, track brake,
resistance and gradient, over the initial kinetic energy. Limit 1e-6 at the default step.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.conftest import Shipped

import railgrip as rg
from railgrip import data
from railgrip.brake.dynamic_brake import DynamicBrake, dynamic_brake_limit
from railgrip.core.constants import GRAVITY

TERMS = ("contact", "brake", "dynamic", "track_brake", "resistance", "gradient")
"""What takes energy; what traction gives is added to the energy at the start."""
LIMIT = 1e-6


def balance(terms: dict[str, float], start: float, end: float) -> float:
    return (start - end - sum(terms.values())) / start


def outcome(result: rg.Result, name: str) -> float:
    return float(result[name].values[0])


@pytest.mark.parametrize("name", data.names("scenarios"))
def test_every_shipped_scenario_closes_and_notices_one_per_cent(
    shipped: Shipped, name: str
) -> None:
    result = shipped(name)
    start, end = (outcome(result, f"energy_kinetic_{at}") for at in ("initial", "final"))
    start += outcome(result, "energy_traction") if "energy_traction" in result.data else 0.0
    terms = {term: outcome(result, f"energy_{term}") for term in TERMS}
    assert abs(balance(terms, start, end)) < LIMIT
    assert outcome(result, "energy_balance") == pytest.approx(balance(terms, start, end), abs=1e-9)
    for term, energy in terms.items():
        spoiled = {**terms, term: 1.01 * energy}
        if abs(energy) > 2e-4 * start:
            assert abs(balance(spoiled, start, end)) > LIMIT, term


@pytest.mark.parametrize("name", data.names("scenarios"))
def test_the_rail_receives_the_work_of_the_contacts(shipped: Shipped, name: str) -> None:
    """Sum over the cells, sum over the axles, and the total: equal to 1e-9."""
    result = shipped(name)
    contact = outcome(result, "energy_contact")
    cells = result["rail_energy"].values[0]
    length = float(np.diff(result.data["cell"].values)[0])
    assert float(cells.sum()) * length == pytest.approx(contact, rel=1e-9)
    assert outcome(result, "energy_rail") == pytest.approx(contact, rel=1e-9)
    assert float(result["axle_slid_energy"].values[0].sum()) == pytest.approx(contact, rel=1e-9)


def middle(values: np.ndarray) -> np.ndarray:
    return 0.5 * (values[..., 1:] + values[..., :-1])


class Retold:
    """A stop without slide, told again from its traces: each term from its own force and speed."""

    def __init__(self, scenario: rg.Scenario) -> None:
        scenario = scenario.with_({"run.trace": scenario.run.step})
        self.scenario, self.train = scenario, scenario.train
        data = rg.simulate(scenario).data.isel(run=0)
        self.of = {str(name): data[name].values for name in data}
        self.step = scenario.run.step
        self.speed, self.wheel = self.of["train_speed"], self.of["wheel_speed"]

    def terms(self) -> dict[str, float]:
        pull = middle(self.of["contact_force"]) * middle(self.wheel - self.speed)
        way = self.step * middle(self.speed)
        return {
            "contact": float((self.step * pull).sum()),
            "brake": float((self.step * self.brake_force() * middle(self.wheel)).sum()),
            "dynamic": float((self.step * self.dynamic_force() * middle(self.wheel)).sum()),
            "resistance": float((middle(self.resistance()) * way).sum()),
            "gradient": self.height(),
        }

    def brake_force(self) -> np.ndarray:
        """Clamp force × friction of the pads × lever to the tread, in the middle of each step."""
        levers = []
        for place in self.train.axles():
            brake = self.train.brakes[place.axle.brake]
            radius = place.axle.wheel_radius
            levers.append((brake.friction_radius or radius) / radius)
        friction = self.of["pad_friction"][:, 1:]
        return friction * middle(self.of["clamp_force"]) * np.array(levers)[:, None]

    def dynamic_force(self) -> np.ndarray:
        """Force of the motors, never above its limit at the speed in the middle of the step."""
        dynamic = self.train.dynamic_brake
        if dynamic is None:
            return np.zeros_like(self.wheel[:, 1:])
        limits = DynamicBrake(dynamic.force, dynamic.power, dynamic.fade_start, dynamic.fade_end)
        before = np.hstack([self.wheel[:, :1], self.wheel[:, :-2]])
        expected = np.maximum(1.5 * self.wheel[:, :-1] - 0.5 * before, 0.0)
        limit = np.vectorize(lambda speed: dynamic_brake_limit(limits, speed))(expected)
        return np.minimum(middle(self.of["dynamic_force"]), limit)

    def resistance(self) -> np.ndarray:
        r = self.train.resistance
        return r.constant + r.linear * self.speed + r.quadratic * self.speed**2

    def height(self) -> float:
        points = self.scenario.line.use.gradient
        slope = points[0].value if points else 0.0
        way = self.of["train_position"][-1] - self.of["train_position"][0]
        return self.scenario.mass * GRAVITY * slope * float(way)

    def kinetic(self, i: int) -> float:
        rotating = np.array([place.axle.rotating_mass for place in self.train.axles()])
        wheels = float((rotating * self.wheel[:, i] ** 2).sum())
        return 0.5 * self.scenario.mass * float(self.speed[i]) ** 2 + 0.5 * wheels


def on_slope(name: str, line: str) -> rg.Scenario:
    return rg.load(name).with_(line={"use": line, "start": 1000.0})


@pytest.mark.parametrize(
    "scenario",
    [
        rg.load("en14531_100"),
        rg.load("coach_120"),
        rg.load("wagon_100"),
        rg.load("dry_emergency"),
        on_slope("dry_emergency", "uphill_20"),
        on_slope("coach_120", "downhill_10"),
    ],
    ids=lambda scenario: f"{scenario.title} {scenario.line.use.title}",
)
def test_the_balance_from_forces_and_speeds_of_the_traces(scenario: Any) -> None:
    """Closes to 1e-6 of the initial energy without the engine's own sums; 1 % in a term does not.

    Stops without slide: there a force changes little from tick to tick, so that its mean over a
    tick is the mean of its ends to 1e-7. The dynamic brake's limit has a kink in speed.
    """
    retold = Retold(scenario)
    start, end = retold.kinetic(0), retold.kinetic(-1)
    terms = retold.terms()
    assert abs(balance(terms, start, end)) < LIMIT
    for term, energy in terms.items():
        if energy:
            spoiled = {**terms, term: 1.01 * energy}
            assert abs(balance(spoiled, start, end)) > 2 * LIMIT, term


def test_the_brake_force_is_clamp_times_friction_times_lever() -> None:
    """What the brake took from the wheel is what its law gives, to 1e-9, also in a slide."""
    retold = Retold(rg.load("detergent_160"))
    turning = retold.wheel[:, 1:] > 0.5
    found = retold.of["brake_force"][:, 1:][turning]
    np.testing.assert_allclose(found, retold.brake_force()[turning], rtol=1e-9, atol=1e-4)
