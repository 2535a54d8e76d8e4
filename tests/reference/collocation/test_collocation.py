"""Real lines against direct collocation with CasADi and IPOPT on a grid of 20 m.

Tolerance 0.1 % from +2 % time for the FLIRT; the collocation's own grid is worth 0.2 % for the
VIRM6, whose power limits it for longer (on 5 m both agree to 0.03 %).
"""

import importlib.util
from pathlib import Path

import pytest

from railgrip.campaign.optimum.leg import LegProblem
from railgrip.scenario.journey import Journey

pytest.importorskip("casadi")
_spec = importlib.util.spec_from_file_location(
    "collocation", Path(__file__).with_name("collocation.py")
)
collocation = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(collocation)


@pytest.mark.parametrize(
    ("train", "line", "end", "share", "tolerance"),
    [
        ("flirt_tpf", "st_gallen_wil", 29556.1, 0.02, 1e-3),
        ("flirt_tpf", "fribourg_bern", 31240.7, 0.10, 1e-3),
        ("virm6", "vasteras_kolback", 19305.4, 0.05, 2e-3),
        ("kiss_sbb", "stadelhofen_altstetten", 1690.0, 0.10, 5e-3),
    ],
)
def test_energy_is_that_of_collocation(train, line, end, share, tolerance):
    stops = [{"at": 0.0}, {"at": end}]
    journey = Journey(train=train, line=line, stop=stops, passing_speed=1.0)
    leg = LegProblem(journey, 0.0, end, 1.0, 1.0)
    time = leg.least_time * (1 + share)
    energy = leg.energy_of(leg.for_time(time))
    expected = collocation.solve(collocation.train_of(train), line, 0.0, end, time)
    assert energy == pytest.approx(expected, rel=tolerance, abs=20e3)


def test_least_time_is_that_of_collocation():
    journey = Journey(train="flirt_tpf", line="st_gallen_wil", passing_speed=1.0)
    leg = LegProblem(journey, 0.0, journey.line.length, 1.0, 1.0)
    train = collocation.train_of("flirt_tpf")
    expected = collocation.solve(train, "st_gallen_wil", 0.0, journey.line.length)
    assert leg.least_time == pytest.approx(expected, rel=3e-4)
