"""What runs are judged by, on courses whose figures are known."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from railgrip.campaign.programme import answer_measures, measures, slide_measures
from railgrip.campaign.programme.measures import Measured
from railgrip.core.constants import GRAVITY
from railgrip.report.view import View
from railgrip.scenario import Scenario

TIME = np.arange(0.0, 20.0, 0.05)
SCENARIO = Scenario(
    train="emu_four_car", run={"speed": "100 km/h"},
    fault=[{"axle": "C1-V1-B1-A2", "kind": "sensor_dead", "from": "2 s"}],
)  # fmt: skip
AXLES = SCENARIO.train.n_axles


def measured(**signals: np.ndarray | float) -> Measured:
    """Return a run of 16 axles that brakes evenly from 100 km/h, with some signals as given."""
    train = 100 / 3.6 - 1.0 * TIME
    rows = np.ones((AXLES, 1))
    course: dict[str, np.ndarray | float] = {
        "status": 1.0,
        "train_speed": train,
        "wheel_speed": rows * train,
        "reference_speed": train,
        "train_position": 100 / 3.6 * TIME - 0.5 * TIME**2,
        "brake_demand": np.ones_like(TIME),
        "brake_cylinder_pressure": rows * np.full_like(TIME, 3e5),
        "dump_valve": rows * np.zeros_like(TIME),
        "dynamic_force": rows * np.zeros_like(TIME),
        "adhesion_used": rows * np.full_like(TIME, 0.1),
        "adhesion_available": rows * np.full_like(TIME, 0.2),
        "adhesion_asked": rows * np.full_like(TIME, 0.13),
        "alarm": rows * np.zeros_like(TIME),
        **signals,
    }
    dims = {0: ("run",), 1: ("run", "time"), 2: ("run", "axle", "time")}
    data = xr.Dataset(
        {name: (dims[np.ndim(value)], np.asarray(value)[None]) for name, value in course.items()},
        coords={"time": TIME, "axle": [place.label for place in SCENARIO.train.axles()]},
    )
    return Measured(View(data), SCENARIO)


def rows(values: np.ndarray, axle: int, otherwise: float) -> np.ndarray:
    """Return the course of one axle among 16 that keep a value."""
    full = np.full((AXLES, len(TIME)), otherwise)
    full[axle] = values
    return full


@pytest.mark.parametrize("gradient", [-0.02, 0.0, 0.01])
def test_a_stop_is_corrected_to_nominal_speed_and_level(gradient: float) -> None:
    """Newton's law: D = (F + m g i)/m_dyn, so a level stop from 100 km/h needs v²/(2 F/m_dyn)."""
    rotating = sum(place.axle.rotating_mass for place in SCENARIO.train.axles())
    force_per_mass = 1.1
    dynamic = SCENARIO.mass + rotating
    share = SCENARIO.mass / dynamic
    speed = 103 / 3.6
    distance = speed**2 / (2 * (force_per_mass + GRAVITY * gradient * share))
    way = float(np.ptp(100 / 3.6 * TIME - 0.5 * TIME**2))
    run = measured(
        deceleration_distance=distance, initial_speed=speed,
        energy_gradient=SCENARIO.mass * GRAVITY * gradient * way,
    )  # fmt: skip
    level = (100 / 3.6) ** 2 / (2 * force_per_mass)
    assert measures.corrected_distance(run) == pytest.approx(level, rel=1e-9)
    assert measures.extension(run._replace(reference=level / 1.25)) == pytest.approx(0.25)
    assert measures.k_wet(run._replace(reference=level / 1.25)) == pytest.approx(0.8)
    assert measures.corrected_distance(measured(status=5.0)) == np.inf  # the time was up


def test_initial_adhesion_is_that_of_the_first_second_of_slide() -> None:
    train = 100 / 3.6 - 1.0 * TIME
    wheel = np.ones((AXLES, 1)) * train
    used = np.full((AXLES, len(TIME)), 0.1)
    slides = TIME >= 2.0
    wheel[:3] = np.where(slides, 0.9 * train, train)
    used[:3] = np.where(slides, 0.06, 0.1)
    used[:3, TIME >= 3.0] = 0.2
    assert slide_measures.initial_adhesion(measured(wheel_speed=wheel, adhesion_used=used)) == (
        pytest.approx(0.06)
    )
    assert np.isnan(slide_measures.initial_adhesion(measured()))


def test_deep_slip_is_the_longest_unbroken_time_of_a_sound_axle() -> None:
    train = 100 / 3.6 - 1.0 * TIME
    deep = ((TIME >= 2.0) & (TIME < 3.0)) | ((TIME >= 5.0) & (TIME < 5.5))
    wheel = np.ones((AXLES, 1)) * train
    wheel[4] = np.where(deep, 0.4 * train, train)
    wheel[1] = 0.0  # the axle with the fault does not count
    assert slide_measures.deep_slip(measured(wheel_speed=wheel)) == pytest.approx(1.0)


def test_the_brake_is_back_after_as_long_as_it_takes_to_fill() -> None:
    available = rows(np.where(TIME < 4.0, 0.03, 0.15), 4, 0.2)
    pressure = rows(np.interp(TIME, [4.0, 6.0], [0.0, 3e5]), 4, 3e5)
    run = measured(adhesion_available=available, brake_cylinder_pressure=pressure)
    # 80 % of 3 bar at 5.6 s; adhesion returned at 4 s, seen within 0.2 s
    assert answer_measures.reapplication_time(run) == pytest.approx(1.6, abs=0.21)


def test_time_without_brake_counts_only_where_one_is_asked() -> None:
    pressure = rows(np.where((TIME > 3.0) & (TIME < 8.0), 0.0, 3e5), 4, 3e5)
    asked = np.where(TIME < 6.0, 1.0, 0.0)
    run = measured(brake_cylinder_pressure=pressure, brake_demand=asked)
    assert answer_measures.released_time(run) == pytest.approx(3.0, abs=0.11)


def test_the_alarm_is_timed_from_the_fault() -> None:
    alarm = rows(np.where(TIME >= 9.0, 1.0, 0.0), 1, 0.0)
    assert answer_measures.alarm_delay(measured(alarm=alarm)) == pytest.approx(7.0, abs=0.06)
    assert answer_measures.alarm_delay(measured()) == np.inf
    assert answer_measures.false_alarms(measured(alarm=rows(np.ones_like(TIME), 7, 0.0))) == 1.0


def test_the_reference_speed_errs_either_way() -> None:
    train = 100 / 3.6 - 1.0 * TIME
    run = measured(reference_speed=train - np.where(TIME > 3.0, 1.5, 0.0))
    assert answer_measures.reference_error(run) == pytest.approx(1.5)


def test_the_least_speed_of_venting_is_found() -> None:
    vents = rows(np.where(np.abs(TIME - 10.0) < 0.01, 2.0, 0.0), 5, 0.0)
    assert answer_measures.least_vent_speed(measured(dump_valve=vents)) == pytest.approx(
        100 / 3.6 - 10.0
    )
    assert np.isnan(answer_measures.least_vent_speed(measured()))


def test_overload_is_a_matter_of_the_rail_not_of_the_slip() -> None:
    half = np.where(TIME < 5.0, 0.05, 0.2)
    available = np.full((AXLES, len(TIME)), 0.2)
    available[:2] = half  # two of the first vehicle's four
    # above 60 km/h for 11.1 s
    expected = 5.0 / ((100 - 60) / 3.6)
    assert slide_measures.overload(measured(adhesion_available=available)) == (
        pytest.approx(expected, abs=0.01)
    )
