"""Driving: effort, power, adhesion and gradient, against what is known without this engine."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import railgrip as rg
from railgrip.core.constants import GRAVITY
from railgrip.engine.simulate import overrides, prepare

START: dict[str, Any] = {
    "title": "start",
    "train": "emu_four_car",
    "line": {"use": "level", "start": 1000.0},
    "rail": {"condition": "dry"},
    "run": {"speed": 0.0, "demand": "none", "drive": 1.0, "duration": "60 s"},
    "wsp": {"controller": "none"},
}


def started(**changes: Any) -> rg.Result:
    return rg.simulate(rg.load(START).with_(changes))


def value(result: rg.Result, name: str) -> float:
    return float(result[name].values[0])


def as_a_point(scenario: rg.Scenario, seconds: float) -> tuple[float, float]:
    """Speed and distance of the same train as a point of mass, by an adaptive Runge-Kutta."""
    train = scenario.train
    traction, resistance = train.traction, train.resistance
    assert traction is not None
    rotating = sum(place.axle.rotating_mass for place in train.axles())

    def rates(time: float, state: np.ndarray) -> list[float]:
        speed = max(state[0], 0.0)
        ramp = min(1.0, time / traction.build_up)
        effort = ramp * min(traction.force, traction.power / max(speed, 0.1))
        drag = resistance.constant + resistance.linear * speed + resistance.quadratic * speed**2
        return [(effort - drag) / (scenario.mass + rotating), speed]

    end = solve_ivp(rates, (0.0, seconds), [0.0, 0.0], rtol=1e-9, atol=1e-9, max_step=0.05)
    return float(end.y[0, -1]), float(end.y[1, -1])


def test_a_start_on_dry_rail_is_that_of_a_point_of_mass() -> None:
    """Creep costs a little: 0.2 % is the creepage that 0.19 of the load needs on dry rail."""
    result = started()
    speed, distance = as_a_point(result.scenario, 60.0)
    assert result.status.name == "COMPLETED"
    assert value(result, "final_speed") == pytest.approx(speed, rel=2e-3)
    assert value(result, "covered_distance") == pytest.approx(distance, rel=2e-3)


@pytest.mark.parametrize("condition", ["dry", "wet", "leaves", "water_detergent"])
def test_energy_closes_while_driving_and_an_error_of_one_per_cent_shows(condition: str) -> None:
    result = started(**{"rail.condition": condition})
    work = value(result, "energy_traction")
    assert abs(value(result, "energy_balance")) < 1e-6
    contact = value(result, "energy_contact")
    assert contact > 0.0
    assert value(result, "energy_rail") == pytest.approx(contact, rel=1e-9)
    assert 0.01 * contact / work > 1e-6


def test_energy_of_traction_is_force_times_speed_of_the_wheel() -> None:
    result = rg.simulate(rg.load(START).with_({"run.trace": 0.01}))
    force, wheel = result["dynamic_force"].values[0], result["wheel_speed"].values[0]
    middle = 0.25 * (force[:, 1:] + force[:, :-1]) * (wheel[:, 1:] + wheel[:, :-1])
    assert value(result, "energy_traction") == pytest.approx(-0.01 * middle.sum(), rel=1e-6)


@pytest.mark.parametrize("adhesion", [0.03, 0.06, 0.1])
def test_no_start_beats_the_adhesion_of_the_motored_axles(adhesion: float) -> None:
    state = {"static_friction": adhesion, "friction_ratio": 1.0, "friction_decay": 0.0}
    plain = {**state, "adhesion_reduction": 1.0, "slip_reduction": 0.4}
    level = {"contaminated": plain, "clean": plain, "cleaning": 0.0}
    result = started(**{"rail.condition": level, "train.resistance": {}})
    weight = result["wheel_load"].values[0, :, 0]
    motored = np.array([place.axle.motor for place in result.scenario.train.axles()])
    # load moves in driving, never the sum of it by more than the transfer of a few per cent
    most = 1.02 * adhesion * weight[motored].sum() / result.scenario.mass
    assert value(result, "covered_distance") <= 0.5 * most * 60.0**2
    force = np.abs(result["contact_force"].values[0][motored])
    # a wheel that spins up outruns the chord of its creep law within a step: up to 5 %, for 0.2 s
    assert (force <= 1.06 * adhesion * result["wheel_load"].values[0][motored]).all()


def test_power_bounds_the_effort_at_speed() -> None:
    result = started(**{"run.speed": "120 km/h"})
    force, wheel = result["dynamic_force"].values[0], result["wheel_speed"].values[0]
    traction = result.scenario.train.traction
    assert traction is not None
    power = -(force * wheel).sum(axis=0)
    assert power.max() == pytest.approx(traction.power, rel=1e-3)
    assert power.max() < 1.001 * traction.power


def test_a_train_that_cannot_climb_stalls_and_the_brake_may_hold_it_meanwhile() -> None:
    steep = {"length": 5000.0, "gradient": [{"at": 0.0, "value": 0.03}]}
    weak = {"train.traction": {"force": "40 kN", "power": "500 kW"}}
    stalled = started(**{"line.use": steep, **weak})
    assert stalled.status.name == "STALLED"
    assert "rolled back" in stalled.sentence
    held = [{"at": 0.0, "level": 1.0}, {"at": 4.0, "level": 0.0}]
    climbs = started(**{"line.use": steep, "run.demand": held})
    assert climbs.status.name == "COMPLETED"
    assert value(climbs, "covered_distance") > 0.0
    # before the brake has pressure (dead time 0.3 s) the train moves a few centimetres
    assert climbs["train_position"].values[0].min() > 999.9


def test_the_pull_of_gravity_is_overcome_or_not_as_the_forces_say() -> None:
    gradient = {"length": 5000.0, "gradient": [{"at": 0.0, "value": 0.02}]}
    result = started(**{"line.use": gradient, "run.duration": "20 s"})
    scenario = result.scenario
    assert scenario.train.traction is not None
    rotating = sum(place.axle.rotating_mass for place in scenario.train.axles())
    pull = scenario.train.traction.force - 0.02 * scenario.mass * GRAVITY
    pull -= scenario.train.resistance.constant
    late = result["acceleration"].values[0][400:600]
    assert late.mean() == pytest.approx(pull / (scenario.mass + rotating), rel=0.03)


class Halved:
    """A controller that permits the first axle half of what is asked."""

    period = 0.01

    def reset(self, setup: Any) -> int:
        return setup.n_axles

    def step(self, state: int, measured: Any, dt: float) -> Any:
        from railgrip.control.contract import Command

        share = np.ones(state)
        share[0] = 0.5
        assert measured.drive_demand == 1.0
        return Command(np.zeros(state), share, np.zeros(state), 0.0)


@pytest.mark.parametrize(("inverter", "reduced"), [("axle", 1), ("bogie", 2), ("vehicle", 2)])
def test_motors_on_one_inverter_are_reduced_together(inverter: str, reduced: int) -> None:
    scenario = rg.load(START).with_(
        {"train.traction": {"force": "120 kN", "power": "2600 kW", "inverter": inverter},
         "run.duration": "10 s"}
    )  # fmt: skip
    result = rg.simulate(scenario, controller=Halved())
    force = -result["dynamic_force"].values[0][:, -1]
    assert int((abs(force - 15e3) < 1).sum()) == reduced
    assert int((abs(force - 30e3) < 1).sum()) == 4 - reduced


def test_many_starts_side_by_side_are_the_single_ones_bit_for_bit() -> None:
    scenario = rg.load(START).with_({"run.duration": "10 s", "rail.condition": "wet"})
    rail = {"mean": 0.1, "spread": 0.03, "correlation_length": 20.0}
    scenario = scenario.with_({"rail.random": rail})
    batch = rg.simulate(scenario, runs=6, traces=False)
    one = rg.simulate(scenario, traces=False)
    assert value(one, "covered_distance") == float(batch["covered_distance"].values[0])
    assert len(set(batch["covered_distance"].values.tolist())) == 6


def test_a_train_without_traction_says_so() -> None:
    with pytest.raises(rg.RailgripError, match=r"run\.drive: asks for tractive effort"):
        rg.load({**START, "train": "coach_disc"})
    with pytest.raises(rg.RailgripError, match=r"run\.drive\[1\]\.at: must be later"):
        rg.load({**START, "run": {"drive": [{"at": 3.0, "level": 1}, {"at": 2.0, "level": 0}]}})


def test_variations_know_the_traction_of_an_axle() -> None:
    prepared = prepare(rg.load(START))
    changed = overrides(prepared, {("TRACTION_MAX", 0): [1.0, 2.0]}, 2)
    assert changed.value.tolist() == [[1.0], [2.0]]
