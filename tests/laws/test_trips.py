"""Trips on the plant: on dry rail they are the journey without slip; on bad rail they say so."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import railgrip as rg
from railgrip.core.errors import RailgripError
from railgrip.core.formulas.two_node_heat import DiscHeat, film_coefficient, two_node_heat_rates
from railgrip.engine import layout as at
from railgrip.engine.journey.of_scenario import journey_of
from railgrip.engine.left_behind import DISC
from railgrip.engine.lower_train import lower_train
from railgrip.engine.trip import TripRun, drive_trip

STOPS = [{"at": 0}, {"at": "4 km"}, {"at": "9 km"}]


def scenario(**trip: Any) -> rg.Scenario:
    table = {"line.use": "fribourg_bern", "trip": {"stop": STOPS, **trip}}
    return rg.load("dry_emergency").with_(table)


@pytest.fixture(scope="module")
def dry() -> TripRun:
    return drive_trip(scenario())


def test_on_dry_rail_it_is_the_journey_without_slip(dry: TripRun) -> None:
    """2 s a leg longer at most (motors build up in 2 s), work within 1.5 %."""
    assert [leg.run.status.name for leg in dry.legs] == ["STOPPED", "STOPPED"]
    times = np.array([leg.time for leg in dry.legs])
    assert np.all(times > dry.fast.running_times)
    assert np.all(times < dry.fast.running_times + 2.0)
    fast = dry.fast.energy
    assert dry.total("energy_traction") == pytest.approx(fast["traction"], rel=0.015)
    assert dry.total("energy_resistance") == pytest.approx(fast["resistance"], rel=0.01)
    assert dry.total("energy_gradient") == pytest.approx(fast["grade"], rel=0.01)
    braked = dry.total("energy_brake") + dry.total("energy_dynamic")
    assert braked == pytest.approx(fast["motor_brake"] + fast["friction"], rel=0.03)
    for leg in dry.legs:
        assert abs(float(leg.run.data["energy_balance"][0])) < 1e-6


def test_it_stops_where_it_should_and_obeys_the_limits(dry: TripRun) -> None:
    for leg in dry.legs:
        assert abs(leg.past_stop) < 1.0
    journey = dry.journey
    limit = max(point.value for point in journey.line.speed_limit)
    fastest = max(float(np.nanmax(leg.run.data["train_speed"].values)) for leg in dry.legs)
    assert fastest < min(limit, journey.train.max_speed) + 0.5
    assert dry.delay == 0.0


def test_coasting_acts_on_the_plant_as_in_the_journey() -> None:
    run = drive_trip(scenario(coasting={"coasting_deceleration": 0.08}))
    flat_out = drive_trip(scenario())
    times = [leg.time for leg in run.legs]
    assert times == pytest.approx(run.fast.running_times.tolist(), rel=0.012)
    assert run.total("energy_traction") == pytest.approx(run.fast.energy["traction"], rel=0.03)
    assert run.total("energy_traction") < 0.97 * flat_out.total("energy_traction")


def test_leaves_cost_time_and_the_stop(dry: TripRun) -> None:
    """The rail decides, whatever protects the wheels; a gentler curve keeps the stop."""
    leaves = {"rail.condition": "leaves", "wsp.controller": "conventional_traction"}
    hasty = drive_trip(scenario().with_(leaves))
    gentle = drive_trip(scenario(braking=0.25).with_(leaves))
    assert hasty.running_time > 1.05 * dry.running_time
    assert hasty.delay > 0.0
    assert hasty.legs[0].past_stop > 100.0
    assert gentle.legs[0].past_stop < 0.2 * hasty.legs[0].past_stop


def test_discs_stay_warm_and_cool_at_the_stop(dry: TripRun) -> None:
    """Ring and hub go on from the leg before by the two-node balance, here by small steps."""
    first, second = dry.legs
    table, _ = lower_train(dry.scenario)
    names = at.AXLE_PARAMETERS.split()
    both = [[leg.run.data[name].values[0] for name in ("disc_temperature", "hub_temperature")]
            for leg in (first, second)]  # fmt: skip
    axle = int(both[0][0][:, -1].argmax())  # most are braked by their motors
    disc = DiscHeat(*(float(table[1 + axle, names.index(name)]) for name in DISC))
    ring, hub = (float(one[axle, -1]) for one in both[0])
    assert ring > hub > 20.0
    assert ring > 25.0
    early = max(first.planned - first.time, 0.0)
    still = film_coefficient(disc.film_still, disc.film_wind, 0.0)
    for _ in range(round(100 * (dry.journey.stops()[1].dwell + early))):
        rates = two_node_heat_rates(disc, ring, hub, 0.0, still)
        ring, hub = ring + 0.01 * rates[0], hub + 0.01 * rates[1]
    begun = [float(one[axle, 0]) for one in both[1]]
    assert begun == pytest.approx([ring, hub], abs=0.3)


def test_the_next_leg_starts_on_the_rail_that_the_last_one_cleaned() -> None:
    """Under the train the wheels' energy is there still; before its front nothing is."""
    leaves = {"rail.condition": "leaves", "wsp.controller": "conventional_traction"}
    first, second = drive_trip(scenario(braking=0.3).with_(leaves)).legs

    def energy(leg: Any, places: Any) -> Any:
        rail = leg.run.data["rail_energy"]
        return np.interp(places, rail["cell"].values, rail.values[0])

    under = np.arange(3950.0, 3995.0)
    assert energy(first, under).min() > 0.0
    assert (energy(second, under) >= energy(first, under) - 1e-6).all()
    rear = 4000.0 - scenario().train.length
    behind = np.arange(rear, rear + 2.0, 0.5)  # under the train, behind its last axle
    assert energy(second, behind) == pytest.approx(energy(first, behind), rel=1e-6)
    assert second.sand >= 0.0


def test_a_trip_is_the_same_bit_for_bit(dry: TripRun) -> None:
    again = drive_trip(scenario())
    for one, other in zip(dry.legs, again.legs, strict=True):
        assert one.run.data.identical(other.run.data)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"trip": None}, "trip: is missing"),
        ({"line.use": "level"}, "line.speed_limit: leaves a gap where the journey begins"),
        ({"trip": {"stop": [{"at": 0}, {"at": "90 km"}]}}, "lies off the line"),
        ({"trip": {"stop": [{"at": 0}]}}, "needs at least two"),
        ({"trip": {"braking": 3.0, "stop": STOPS}}, "braking: is more than the train allows"),
    ],
)
def test_what_cannot_be_driven_is_said(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(RailgripError) as error:
        journey_of(scenario().with_(changes))
    assert sentence in str(error.value)


def test_a_train_without_motors_is_refused() -> None:
    with pytest.raises(RailgripError, match=r"has no .traction."):
        journey_of(scenario().with_({"train": "coach_disc"}))
