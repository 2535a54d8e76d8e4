"""Real and hard lines against direct collocation with CasADi and IPOPT on a grid of 20 m.

Tolerance 0.1 % from +2 % time. The collocation takes limits of power in the middle of each
interval; taken at both ends it loses a share of the step's power, 0.15 % of energy for the VIRM6
on 20 m, and converges to the same (`studies/results/optimum_collocation.csv`).
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

TOLERANCE = 1e-3
DRAG = 15.0
"""That a tunnel adds, N s²/m²."""
HARD = {
    # (limits, gradients, tunnels, changes of the train, length)
    "a climb that no speed is held on": (
        [(0, 38)],
        [(0, 0.0), (3000, 0.035), (5000, 0.0), (6500, -0.03), (8000, 0.0)],
        [],
        {},
        10e3,
    ),
    "tunnels": ([(0, 42)], [(0, 0.0)], [(2000, 5000), (6000, 7000)], {}, 10e3),
    "regeneration downhill": (
        [(0, 40), (4000, 25), (5000, 40)],
        [(0, 0.0), (5000, -0.02), (8000, 0.01)],
        [],
        {"motor": 150e3, "motor_power": 2e6, "back": 0.85},
        10e3,
    ),
    "limits close together": (
        [(0, 30), (700, 20), (1100, 33), (1600, 22), (1900, 36), (3200, 15), (3500, 25),
         (4200, 36), (5600, 28)],
        [(0, 0.0)],
        [],
        {"motor": 100e3, "motor_power": 1.5e6, "back": 0.7},
        7e3,
    ),
}  # fmt: skip


@pytest.mark.parametrize(
    ("train", "line", "end", "share"),
    [
        ("flirt_tpf", "st_gallen_wil", 29556.1, 0.02),
        ("flirt_tpf", "fribourg_bern", 31240.7, 0.10),
        ("virm6", "st_gallen_wil", 29556.1, 0.02),
        ("virm6", "vasteras_kolback", 19305.4, 0.05),
    ],
)
def test_energy_is_that_of_collocation(train, line, end, share):
    stops = [{"at": 0.0}, {"at": end}]
    journey = Journey(train=train, line=line, stop=stops, passing_speed=1.0)
    leg = LegProblem(journey, 0.0, end, 1.0, 1.0)
    time = leg.least_time * (1 + share)
    energy = leg.energy_of(leg.for_time(time))
    expected = collocation.solve(
        collocation.train_of(train), line, 0.0, end, time, power_at="middle"
    )
    assert energy == pytest.approx(expected, rel=TOLERANCE)


@pytest.mark.parametrize("name", HARD)
def test_energy_on_hard_lines(name):
    limits, gradients, tunnels, changes, end = HARD[name]
    train = {**collocation.train_of("virm6"), "up": 0.8, "down": 0.7, **changes}
    constant, linear, quadratic = train["resistance"]
    own = {
        "mass": train["mass"],
        "rotating": train["dynamic"] / train["mass"] - 1.0,
        "max_speed": train["top"],
        "resistance": {"constant": constant, "linear": linear, "quadratic": quadratic},
        "tunnel_resistance": [{"cross_section": 40.0, "quadratic": DRAG}],
        "effort": {"force": train["force"], "power": train["power"]},
        "regeneration": {"force": train["motor"], "power": train["motor_power"]},
        "friction_brake": train["friction"],
        "max_acceleration": train["up"],
        "max_deceleration": train["down"],
        "efficiency": {"traction": train["drive"], "regeneration": train["back"]},
    }
    line = {
        "length": end,
        "speed_limit": [{"at": at, "value": speed} for at, speed in limits],
        "gradient": [{"at": at, "value": slope} for at, slope in gradients],
        "tunnel": [{"from": a, "to": b, "cross_section": 40.0} for a, b in tunnels],
    }
    leg = LegProblem(Journey(train=own, line=line, passing_speed=1.0), 0.0, end, 1.0, 1.0)
    time = leg.least_time * 1.02
    table = {
        "speed limits": {"values": [(at, speed * 3.6) for at, speed in limits]},
        "gradients": {"values": [(at, slope * 1e3) for at, slope in gradients]},
        "drags": [(a, b, DRAG) for a, b in tunnels],
    }
    expected = collocation.solve(train, table, 0.0, end, time, power_at="middle")
    assert leg.energy_of(leg.for_time(time)) == pytest.approx(expected, rel=TOLERANCE)


def test_least_time_is_that_of_collocation():
    journey = Journey(train="flirt_tpf", line="st_gallen_wil", passing_speed=1.0)
    leg = LegProblem(journey, 0.0, journey.line.length, 1.0, 1.0)
    train = collocation.train_of("flirt_tpf")
    expected = collocation.solve(train, "st_gallen_wil", 0.0, journey.line.length)
    assert leg.least_time == pytest.approx(expected, rel=3e-4)
