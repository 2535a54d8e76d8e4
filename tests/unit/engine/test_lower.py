"""From a scenario to numbers for the kernel: places, loads, rates, ticks, cells, heights."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.conftest import Coach

import railgrip as rg
from railgrip.core.constants import GRAVITY
from railgrip.core.errors import RailgripError
from railgrip.engine import layout as at
from railgrip.engine.lower import (
    NEVER,
    cell_length,
    controller_setup,
    curve_resistance,
    lower,
    ring_cells,
)
from railgrip.engine.plan import Plan

NO_PARAMETERS = np.zeros(0)


def planned(scenario: rg.Scenario, period: float = 0.01) -> Plan:
    return lower(scenario, period, NO_PARAMETERS)


def axle_numbers(plan: Plan, name: str) -> np.ndarray:
    return np.asarray(plan.parameters[1:, at.AXLE_PARAMETERS.split().index(name)])


def train_number(plan: Plan, name: str) -> float:
    return float(plan.parameters[0, at.TRAIN_PARAMETERS.split().index(name)])


def test_names_are_told_once() -> None:
    """The layout's numbers of a block are all different: nothing overwrites anything."""
    for names in (at.AXLE_STATES, at.AXLE_PARAMETERS, at.AXLE_TICK):
        offsets = [getattr(at, name) for name in names.split()]
        assert len(set(offsets)) == len(offsets)
    blocks = [at.AXLE_STATES, at.AXLE_PARAMETERS, at.AXLE_TICK]
    taken = [getattr(at, name) for names in blocks for name in names.split()]
    assert len(set(taken)) == len(taken)
    assert max(taken) < at.SPEED_HISTORY < at.VALVE_HISTORY < at.N_VARS
    train = [at.TRAIN_STATES, at.TRAIN_PARAMETERS, at.TRAIN_TICK]
    taken = [getattr(at, name) for names in train for name in names.split()]
    assert len(set(taken)) == len(taken)
    assert max(taken) < at.N_VARS


def test_masses_loads_and_places() -> None:
    """Loads sum to the weight, offsets are the axles', the motored ones carry their share."""
    scenario = rg.load("dry_emergency")
    plan = planned(scenario)
    loads = axle_numbers(plan, "STATIC_LOAD")
    assert loads.sum() == pytest.approx(scenario.mass * GRAVITY, rel=1e-12)
    assert train_number(plan, "TRAIN_MASS") == scenario.mass == 220e3
    assert loads[0] == pytest.approx(0.276 * 58e3 * GRAVITY)
    places = [place.behind_front for place in scenario.train.axles()]
    np.testing.assert_array_equal(axle_numbers(plan, "OFFSET"), places)
    np.testing.assert_array_equal(
        plan.formation.vehicle_of_axle, [place.vehicle for place in scenario.train.axles()]
    )
    assert plan.formation.vehicle_share.sum() == pytest.approx(1.0)
    assert axle_numbers(plan, "LOAD_TRANSFER").sum() == pytest.approx(0.0, abs=1e-9)


def test_load_changes_masses_and_brakes() -> None:
    empty, laden = (planned(rg.load("wagon_100").with_(load=load)) for load in ("empty", "laden"))
    assert train_number(laden, "TRAIN_MASS") == 90e3
    assert train_number(empty, "TRAIN_MASS") == 22.4e3
    forces = [axle_numbers(plan, "FULL_FORCE")[0] for plan in (empty, laden)]
    assert forces[0] < 0.4 * forces[1]
    pressures = [axle_numbers(plan, "FULL_PRESSURE")[0] for plan in (empty, laden)]
    assert pressures[0] < pressures[1] == pytest.approx(3.8e5)


def test_the_kalker_slope_is_that_of_two_wheels(coach: Coach) -> None:
    """Base case: 100 kN a wheel, 0.46 m, rail 0.3 m: 2 × 14.5237 MN; σ = 8a/(3π) = 6.105 mm."""
    axle = {"count": 2, "rotating_mass": 800.0, "wheel_radius": 0.46, "brake": "disc"}
    bogie = {"count": 2, "wheelbase": 2.5, "mass": 6e3, "axle": [axle]}
    tare = 4 * 200e3 / GRAVITY
    vehicle = {"length": 26.0, "tare": tare, "pivot_distance": 19.0, "bogie": [bogie]}
    plan = planned(coach(train={"vehicle": [vehicle]}))
    np.testing.assert_allclose(axle_numbers(plan, "KALKER_SLOPE"), 2 * 14.523733e6, rtol=1e-6)
    sigma = 8 * 7.191978396e-3 / (3 * np.pi)
    np.testing.assert_allclose(axle_numbers(plan, "RELAXATION_LENGTH"), sigma, rtol=1e-8)


def test_the_brake_of_the_en_14531_example() -> None:
    """Full force of each axle at its nominal friction: 16 073.5 and 9 104.2 N, to 0.1 N."""
    forces = axle_numbers(planned(rg.load("en14531_100")), "FULL_FORCE")
    tread, disc = 16073.5, 9104.2
    expected = [tread, tread, disc, disc, disc, disc, tread, tread]
    np.testing.assert_allclose(forces, expected, atol=0.1)


def test_the_pipe_delays_by_the_way_along_it() -> None:
    scenario = rg.load("freight_stop")
    delays = axle_numbers(planned(scenario), "DEMAND_DELAY")
    wagons = np.unique(delays[4:])
    np.testing.assert_allclose(np.diff(wagons), 14.04 / 250.0, rtol=1e-9)
    electric = planned(scenario.with_({"train.brake_control.kind": "ep"}))
    assert np.ptp(axle_numbers(electric, "DEMAND_DELAY")[4:]) == 0.0


def test_time_in_ticks(coach: Coach) -> None:
    demand = [{"at": 0.0, "level": "none"}, {"at": 2.5, "level": 0.4}]
    timing = planned(coach(demand=demand, step=0.005, trace=0.05, time_limit=30.0), 0.02).timing
    assert (timing.tick, timing.limit, timing.trace_every, timing.control_every) == (
        0.005, 6000, 10, 4,
    )  # fmt: skip
    assert timing.demand_tick.tolist() == [0, 500]
    assert timing.first_brake_tick == 500
    assert (timing.vent_delay, timing.fill_delay) == (10, 12)
    assert planned(coach(demand="none")).timing.first_brake_tick == NEVER


@pytest.mark.parametrize("period", [0.004, 0.0025, 0.015])
def test_a_period_that_the_step_does_not_divide(coach: Coach, period: float) -> None:
    with pytest.raises(RailgripError, match=r"run.step: the controller's period must be a mult"):
        planned(coach(), period)


def test_a_delay_too_long_for_the_step(coach: Coach) -> None:
    train: dict[str, Any] = {"dump_valve": {"vent_delay": 1.0}}
    with pytest.raises(RailgripError, match=r"train.dump_valve.vent_delay: .*; got 1000 ms"):
        planned(coach(train=train))


def test_no_more_ticks_are_kept_than_the_delays_reach_back(coach: Coach) -> None:
    """Vent 50 ms, fill 60 ms; a fault adds to the valve's own."""
    assert planned(coach()).timing.kept == 7
    assert planned(coach(step=0.005, trace=0.05)).timing.kept == 15
    late = {"fault": [{"axle": "all", "kind": "valve_delayed", "delay": 0.28}]}
    assert planned(coach().with_(late)).timing.kept == 63
    with pytest.raises(RailgripError, match=r"fault.delay and the valve's own: .*got 340 ms"):
        planned(coach(step=0.005, trace=0.05).with_(late))


@pytest.mark.parametrize(("speed", "step"), [(100.0, 0.01), (10.0, 0.001), (60.0, 0.02)])
def test_no_wheel_passes_a_whole_cell_in_a_tick(coach: Coach, speed: float, step: float) -> None:
    length = cell_length(coach(speed=speed, step=step, trace=0.1))
    assert length >= 1.2 * speed * step
    assert length <= max(0.5, 1.25 * speed * step + 0.5)


def test_conditions_by_cell(coach: Coach) -> None:
    """Each cell by its centre: the patch from 3 000 to 3 100 m, the rest the base condition."""
    patch = {"from": 3000.0, "to": 3100.0, "condition": "oil"}
    way = planned(coach(0.2).with_(rail={"patch": [patch]})).way
    centres = way.origin + (np.arange(len(way.condition_of_cell)) + 0.5) * way.cell_length
    inside = (centres > 3000.0) & (centres < 3100.0)
    np.testing.assert_array_equal(way.condition_of_cell == 1, inside)
    assert way.conditions[0, 0, 0] == 0.2
    assert way.conditions[0, 1, 0] == 0.08
    assert way.origin < 2000.0 - 26.0
    assert centres[-1] > 100e3


def test_heights_integrate_the_gradients(coach: Coach) -> None:
    table = [
        {"at": 0.0, "value": 0.0},
        {"at": 2500.4, "value": 0.02},
        {"at": 3000.0, "value": -0.01},
    ]
    line = {"use": {"length": 6e3, "gradient": table}, "start": 2000.0}
    way = planned(coach().with_(line=line)).way

    def height(place: float) -> float:
        grid = way.origin + way.elevation_step * np.arange(len(way.elevation))
        return float(np.interp(place, grid, way.elevation))

    assert height(2400.0) == pytest.approx(0.0, abs=1e-9)
    assert height(3000.0) - height(2400.0) == pytest.approx(0.02 * 499.6, rel=1e-9)
    assert height(4000.0) - height(3000.0) == pytest.approx(-10.0, rel=1e-9)
    assert way.is_level == 0
    assert planned(coach()).way.is_level == 1


@pytest.mark.parametrize(
    ("radius", "permil"), [(300.0, 2.653), (500.0, 1.461), (1000.0, 0.688), (200.0, 2.941)]
)
def test_curve_resistance(radius: float, permil: float) -> None:
    """Röckl: 650/(R − 55) ‰ from 300 m, 500/(R − 30) ‰ below."""
    assert curve_resistance(radius) * 1e3 == pytest.approx(permil, abs=5e-4)


def test_curve_resistance_acts(coach: Coach) -> None:
    """On 500 m radius a coasting coach loses 1.461 ‰ of g, over its mass with wheels."""
    bend = {"length": 100e3, "curve": [{"from": 0.0, "to": 100e3, "radius": 500.0}]}
    scenario = coach(0.3, speed=20.0, demand="none", time_limit=10.0)
    result = rg.simulate(scenario.with_(line={"use": bend}))
    lost = -result["acceleration"].values[0][10:-1]
    expected = 1.461e-3 * GRAVITY * 44e3 / (44e3 + 3200.0)
    np.testing.assert_allclose(lost, expected, rtol=1e-3)


def test_the_ring_holds_train_or_line(coach: Coach) -> None:
    plan = planned(coach())
    short, long = ring_cells(plan, 26.0, False), ring_cells(plan, 26.0, True)
    assert short * plan.way.cell_length > 26.0 + 10.0
    assert long >= len(plan.way.condition_of_cell)
    for number in (short, long):
        assert number & (number - 1) == 0


def test_controllers_are_told_the_believed_train() -> None:
    scenario = rg.load("wheel_diameters")
    setup = controller_setup(scenario, 0.01)
    assert setup.n_axles == 4
    np.testing.assert_array_equal(setup.wheel_radius, 0.46)
    assert setup.braked.all()
    assert not setup.motored.any()
    motored = controller_setup(rg.load("dry_emergency"), 0.01).motored
    assert np.flatnonzero(motored).tolist() == [0, 1, 14, 15]


def test_track_brakes_that_differ_are_refused() -> None:
    scenario = rg.load("track_brake_120")
    vehicle = scenario.train.vehicle[0]
    other = vehicle.model_copy(
        update={"track_brake": vehicle.track_brake.model_copy(update={"friction": 0.1})}
    )
    train = scenario.train.model_copy(update={"vehicle": (vehicle, other)})
    mixed = scenario.model_copy(update={"train": train})
    with pytest.raises(RailgripError, match=r"train.vehicle: track brakes must not differ"):
        planned(mixed)
