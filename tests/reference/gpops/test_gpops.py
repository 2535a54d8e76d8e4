"""GPOPS-II's optimum on 00_var_speed_limit_100 in 1541 s: 440.14 kWh.

Source: dkouzoup/ms-eetc, gpops/ (BSD 2-Clause). Tolerance of the energy 0.05 %, as demanded; the
profile is compared too, since an energy alone could be right by accident.
"""

import csv
from pathlib import Path

import numpy as np
import pytest

from railgrip.campaign.optimum.timetable import optimum
from railgrip.core.errors import RailgripError
from railgrip.scenario.journey import Journey

TRAIN = {
    "mass": "391 t",
    "rotating": 0.06,
    "max_speed": "160 km/h",
    "resistance": {"constant": 5854.0, "linear": 74.16, "quadratic": 12.96},
    "effort": {"force": "213.9 kN", "power": 3_129_277.0},
    "regeneration": {"force": "213.9 kN", "power": 3_129_277.0},
    "friction_brake": 0.0,
    "efficiency": {"traction": 0.73, "regeneration": 0.73},
}


@pytest.fixture(scope="module")
def journey():
    return Journey(train=TRAIN, line="var_speed_limit_100", passing_speed=1.0)


@pytest.fixture(scope="module")
def rows():
    file = Path(__file__).with_name("00_var_speed_limit_100_GPOPSII.csv")
    with file.open(encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def test_energy_is_that_of_gpops(journey, rows):
    run = optimum(journey, 1541.0)
    published = float(rows[0]["Energy [kWh]"])
    assert run.running_time == pytest.approx(1541.0, abs=1e-4)
    assert run.energy / 3.6e6 == pytest.approx(published, rel=5e-4)


def test_profile_is_that_of_gpops(journey, rows):
    run = optimum(journey, 1541.0)
    place = np.array([float(row["Position [m]"]) for row in rows])
    speed = np.array([float(row["Velocity [m/s]"]) for row in rows])
    found = np.interp(place, run.position, run.speed)
    assert np.abs(found - speed)[5:-5].max() < 0.25


def test_energy_hardly_depends_on_the_grid(journey):
    energies = [optimum(journey, 1541.0, step=step).energy for step in (40.0, 20.0, 10.0)]
    assert np.ptp(energies) < 2e-5 * energies[0]


def test_least_time_is_a_run_and_less_is_refused(journey):
    least = optimum(journey, None).least_times[0]
    at_least = optimum(journey, least)
    a_little_more = optimum(journey, least * 1.001)
    assert at_least.running_time == pytest.approx(least, rel=1e-9)
    assert a_little_more.energy < at_least.energy
    with pytest.raises(RailgripError, match=r"impossible .* got 1400.0 s; allowed: from 1453.5 s"):
        optimum(journey, 1400.0)
