"""What brakes do on the train: blending, handing over, track brake, pipe, load, air."""

from __future__ import annotations

import numpy as np
import pytest
from tests.conftest import Coach, Shipped

import railgrip as rg


def of(result: rg.Result, name: str) -> np.ndarray:
    return np.asarray(result[name].values[0])


def distance(result: rg.Result) -> float:
    return float(of(result, "stopping_distance"))


def test_blending_keeps_the_sum(shipped: Shipped) -> None:
    """Dry: the dynamic brake rises and fades, the friction brake fills up; the sum stays.

    Between 35 and 5 m/s within 8 %: the pads' friction depends on speed, force and heat, and
    blending counts with its reference value.
    """
    result = shipped("dry_emergency")
    speed = of(result, "train_speed")
    built = (speed > 5.0) & (speed < 35.0)
    dynamic, friction = of(result, "dynamic_force")[0], of(result, "brake_force")[0]
    total = (dynamic + friction)[built]
    assert np.ptp(dynamic[built]) > 1e3
    np.testing.assert_allclose(total, np.median(total), rtol=0.08)


def test_the_dynamic_brake_fades_out_before_the_stand(shipped: Shipped) -> None:
    """Nothing is left below 5 km/h, where friction brakes alone with more pressure."""
    result = shipped("dry_emergency")
    speed = of(result, "train_speed")
    slow, fast = speed < 4.9 / 3.6, (speed > 5.0) & (speed < 15.0)
    pressure = of(result, "brake_cylinder_pressure")[0]
    end = speed == np.nanmin(speed[speed > 0.0])
    assert np.nanmax(of(result, "dynamic_force")[0][slow][5:]) == 0.0
    assert pressure[end][0] > 1.3 * pressure[fast].mean()


def test_on_a_slide_the_dynamic_brake_goes_first(shipped: Shipped) -> None:
    """It is reduced at the first slide, and the friction brake takes its place.

    Later it may be tried again for a moment: its mean is below 5 % of what it was.
    """
    result = shipped("leaves_160")
    time = result.data["time"].values
    dynamic = of(result, "dynamic_force")[0]
    pressure = of(result, "brake_cylinder_pressure")[0]
    slid = int(np.argmax(of(result, "is_sliding")[0] > 0.0))
    assert slid > 0
    assert dynamic[slid - 1] > 10e3
    gone = np.searchsorted(time, time[slid] + 2.0)
    braking = of(result, "train_speed") > 10.0
    assert dynamic[gone : braking.sum()].mean() < 0.05 * dynamic[slid - 1]
    assert pressure[gone : braking.sum()].max() > 1.2 * pressure[: slid + 1].max()


def test_the_dynamic_brake_may_be_left_out_of_an_emergency(shipped: Shipped) -> None:
    """The locomotive: in_emergency = false; a service brake has it."""
    emergency = shipped("locomotive_light")
    assert np.nanmax(of(emergency, "dynamic_force")) == 0.0
    service = rg.simulate(emergency.scenario.with_({"run.demand": "service"}))
    assert np.nanmax(of(service, "dynamic_force")) > 20e3
    assert float(service["energy_dynamic"].values[0]) > 0.0


def test_the_track_brake_shortens_the_stop(shipped: Shipped) -> None:
    """On oil by more than a quarter; it works in an emergency only and lifts at 50 km/h."""
    result = shipped("track_brake_120")
    without = rg.simulate(result.scenario.with_(train="coach_disc"), traces=False)
    assert distance(result) < 0.75 * distance(without)
    force, speed = of(result, "track_brake_force").sum(axis=0), of(result, "train_speed")
    assert np.nanmax(force) == pytest.approx(168e3 * 0.2, rel=0.3)
    # it is lifted within its build-up time of 1 s after 50 km/h
    assert np.nanmax(force[speed < 40 / 3.6]) == 0.0
    service = rg.simulate(result.scenario.with_({"run.demand": "service"}))
    assert np.nanmax(of(service, "track_brake_force")) == 0.0


def first_pressure(result: rg.Result, threshold: float) -> np.ndarray:
    time = result.data["time"].values
    pressure = of(result, "brake_cylinder_pressure")
    return np.array([time[int(np.argmax(axle > threshold))] for axle in pressure])


def test_the_brake_pipe_reaches_the_rear_later() -> None:
    """At 250 m/s: along the wagons the first pressure comes 4 ms later a metre, within 2 %."""
    result = rg.simulate(rg.load("freight_stop").with_({"run.trace": 0.01, "run.time_limit": 5.0}))
    begins = first_pressure(result, 2e3)[4::4]
    fronts = np.array(result.scenario.train.vehicle_fronts())[1:]
    slope = np.polyfit(fronts, begins, 1)[0]
    assert slope == pytest.approx(1 / 250.0, rel=0.02)
    assert begins[-1] - begins[0] == pytest.approx(np.ptp(fronts) / 250.0, abs=0.02)


def test_an_electric_brake_is_told_everywhere_at_once() -> None:
    scenario = rg.load("freight_stop").with_(
        {"train.brake_control.kind": "ep", "run.trace": 0.01, "run.time_limit": 5.0}
    )
    assert np.ptp(first_pressure(rg.simulate(scenario), 2e3)[4:]) == 0.0


def test_position_g_is_slower_than_p(shipped: Shipped) -> None:
    fast, slow = shipped("freight_stop"), shipped("freight_stop_g")
    assert distance(slow) > 1.2 * distance(fast)
    assert float(slow["build_up_time"].values[0]) > 2 * float(fast["build_up_time"].values[0])


def test_changeover_brakes_the_empty_wagon_less(shipped: Shipped) -> None:
    """Empty 0.33 of the clamp force (its data); the laden brake would lock empty wheels."""
    laden = shipped("wagon_100")
    empty = rg.simulate(laden.scenario.with_(load="empty"))
    clamp = [np.nanmax(of(result, "clamp_force")) for result in (empty, laden)]
    assert clamp[0] / clamp[1] == pytest.approx(0.33, rel=1e-3)
    assert np.nanmax(of(empty, "adhesion_asked")) < 0.25


def test_continuous_load_braking_keeps_the_deceleration(shipped: Shipped) -> None:
    """Four-car unit on friction alone: clamp force as the mass, stops equal within 3 %."""
    stops, clamps, masses = [], [], []
    for load in ("empty", "laden"):
        scenario = shipped("dry_emergency").scenario.with_(
            {"load": load, "train.dynamic_brake": None}
        )
        result = rg.simulate(scenario)
        stops.append(distance(result))
        clamps.append(np.nanmax(of(result, "clamp_force")[4]))
        masses.append(scenario.train.vehicle[1].tare + scenario.payloads()[1])
    assert masses[1] > 1.1 * masses[0]
    assert clamps[1] / clamps[0] == pytest.approx(masses[1] / masses[0], rel=1e-3)
    assert stops[1] == pytest.approx(stops[0], rel=0.03)


def test_an_exhausted_reservoir_weakens_the_brake(shipped: Shipped) -> None:
    """60 l on very low adhesion: the pressure left bounds the cylinders."""
    small = shipped("exhausted_air")
    large = rg.simulate(small.scenario.with_({"train.reservoir.volume": "10 m^3"}))
    air = of(small, "reservoir_pressure")[0]
    cylinders = of(small, "brake_cylinder_pressure")
    assert np.nanmin(air) < 1e5
    assert np.nanmin(of(large, "reservoir_pressure")) > 5e5
    assert (np.diff(air[:-1]) <= 1e-6).all()
    late = slice(len(air) // 2, -1)
    assert cylinders[:, late].max() <= air[late].max() * (1 + 1e-6)
    assert cylinders[:, late].max() < 0.6 * of(large, "brake_cylinder_pressure")[:, late].max()


def test_a_reservoir_too_small_makes_the_stop_longer() -> None:
    """Dry: 4 cylinders of 12 l from 40 l at 6 bar end near 6·40/88 bar, 0.72 of the 3.8 asked for.

    The pads' force follows less the springs', so that the stop grows by at least a quarter.
    """
    enough = rg.simulate(rg.load("coach_120"))
    scenario = rg.load("coach_120").with_({"train.reservoir.volume": "40 l"})
    result = rg.simulate(scenario)
    pressure = of(result, "brake_cylinder_pressure")[:, :-1]
    assert pressure.max() == pytest.approx(6e5 * 40 / 88, rel=0.01)
    assert of(result, "reservoir_pressure")[0][-2] == pytest.approx(pressure[:, -1].max(), rel=0.02)
    assert distance(result) > 1.25 * distance(enough)


def test_air_is_counted_where_it_goes(shipped: Shipped) -> None:
    """Nothing recharges: what the reservoir lost is what was used, within 2 %.

    The traces end up to 20 ms before the run, in which time valves may still work.
    """
    result = shipped("coach_leaves")
    reservoir = result.scenario.train.reservoir
    lost = reservoir.pressure - of(result, "reservoir_pressure")[0][:-1]
    used = float(result["air_used"].values[0]) * 1e5 / reservoir.volume
    assert lost[-1] == pytest.approx(used, rel=0.02)


def test_full_service_and_half_service(coach: Coach) -> None:
    """Half the demand: half the pressure and deceleration (no spring, no resistance)."""
    full, half = (rg.simulate(coach(0.5, demand=level)) for level in (1.0, 0.5))
    pressures = [np.nanmax(of(result, "brake_cylinder_pressure")) for result in (full, half)]
    assert pressures[1] == pytest.approx(0.5 * pressures[0], rel=1e-6)
    decelerations = [-np.nanmin(of(result, "acceleration")) for result in (full, half)]
    assert decelerations[1] == pytest.approx(0.5 * decelerations[0], rel=1e-3)


def test_a_timed_sequence_is_followed(shipped: Shipped) -> None:
    """sequence: the demand of the trace is the scenario's at every moment."""
    result = shipped("sequence")
    time, demand = result.data["time"].values, of(result, "brake_demand")
    points = result.scenario.run.demand
    expected = [[p.level for p in points if p.at <= t + 1e-9][-1] for t in time]
    np.testing.assert_array_equal(demand[:-1], expected[:-1])
