"""The optimum where it is known on paper, and what it must do on lines drawn at random.

Tolerances: 0.02 % against closed forms, what the grid of 2 to 10 m is worth.
"""

import importlib.util
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from railgrip.campaign.optimum.leg import LegProblem
from railgrip.campaign.optimum.timetable import optimum
from railgrip.scenario.journey import Journey

NEAR = 2e-4
MASS = 200e3
PLAIN = {
    "mass": MASS,
    "rotating": 0.0,
    "max_speed": 60.0,
    "effort": {"force": 160e3, "power": 1e9},
    "max_deceleration": 0.5,
    "efficiency": {"traction": 1.0, "regeneration": 0.0},
}


def journey(train, length, *, gradient=0.0, passing_speed=0.0):
    line = {
        "length": length,
        "speed_limit": [{"at": 0, "value": 60.0}],
        "gradient": [{"at": 0, "value": gradient}],
    }
    return Journey(train={**PLAIN, **train}, line=line, passing_speed=passing_speed)


def trapezium(length, time, up, down):
    """Return the speed held between even acceleration and braking."""
    slope = 0.5 / up + 0.5 / down
    return (time - np.sqrt(time**2 - 4.0 * slope * length)) / (2.0 * slope)


@pytest.mark.parametrize("time", [320.0, 400.0, 700.0])
def test_without_resistance_the_least_top_speed_is_best(time):
    """Accelerate, roll, brake: the energy is that of the speed between."""
    top = trapezium(10e3, time, 0.8, 0.5)
    assert optimum(journey({}, 10e3), time).energy == pytest.approx(0.5 * MASS * top**2, rel=NEAR)


@pytest.mark.parametrize("time", [420.0, 520.0])
def test_with_perfect_regeneration_only_resistance_costs(time):
    """One speed is held; it is reached and left as fast as the train can, without coasting."""
    constant, quadratic = 2000.0, 8.0
    train = {
        "resistance": {"constant": constant, "quadratic": quadratic},
        "effort": {"force": 500e3, "power": 1e9},
        "regeneration": {"force": 500e3, "power": 1e9},
        "max_acceleration": 0.8,
        "efficiency": {"traction": 1.0, "regeneration": 1.0},
    }
    length = 12e3
    top = trapezium(length, time, 0.8, 0.5)
    changing = 0.5 * top**2 * (1 / 0.8 + 1 / 0.5)  # way that even changes take
    squares = 0.5 * top**2 * changing + top**2 * (length - changing)
    expected = constant * length + quadratic * squares
    assert optimum(journey(train, length), time).energy == pytest.approx(expected, rel=NEAR)


@pytest.mark.parametrize("hold", [22.0, 30.0])
def test_level_run_of_the_maximum_principle(hold):
    """Full power to V, hold V, coast to U = ψ(V)/φ'(V), brake.

    With the resistance r(v) over the mass, φ = v r and ψ = v² r' (Howlett and Pudney, Energy-
    Efficient Train Control, Springer 1995, doi 10.1007/978-1-4471-3084-0, ch. 2).
    """
    c0, c1, c2 = 0.012, 3e-4, 4e-5
    push, length, down = 0.8, 20e3, 0.5

    def r(v):
        return c0 + c1 * v + c2 * v * v

    steep = c1 + 2.0 * c2 * hold
    brakes_at = hold**2 * steep / (r(hold) + hold * steep)
    way_up = quad(lambda v: v / (push - r(v)), 0.0, hold)[0]
    time_up = quad(lambda v: 1.0 / (push - r(v)), 0.0, hold)[0]
    way_coasting = quad(lambda v: v / r(v), brakes_at, hold)[0]
    time_coasting = quad(lambda v: 1.0 / r(v), brakes_at, hold)[0]
    way_held = length - way_up - way_coasting - brakes_at**2 / (2.0 * down)
    assert way_held > 0.0
    time = time_up + way_held / hold + time_coasting + brakes_at / down
    expected = MASS * (push * way_up + r(hold) * way_held)
    train = {"resistance": {"constant": c0 * MASS, "linear": c1 * MASS, "quadratic": c2 * MASS}}
    run = optimum(journey(train, length), time)
    assert run.energy == pytest.approx(expected, rel=NEAR)
    # a second is worth what it costs at the speed that is held: V² r'(V) over the mass
    assert run.prices[0] == pytest.approx(MASS * hold**2 * steep, rel=2e-3)


def test_cruising_speed_solves_for_the_time():
    """The speed held follows from the time alone; found here by a root of its own."""
    c0, c2, push, down, length, time = 0.012, 4e-5, 0.8, 0.5, 20e3, 860.0

    def timed(hold):
        def r(v):
            return c0 + c2 * v * v

        foot = 2.0 * c2 * hold**3 / (r(hold) + 2.0 * c2 * hold**2)
        way = quad(lambda v: v / (push - r(v)), 0.0, hold)[0] + foot**2 / (2.0 * down)
        way += quad(lambda v: v / r(v), foot, hold)[0]
        taken = quad(lambda v: 1.0 / (push - r(v)), 0.0, hold)[0] + foot / down
        return taken + quad(lambda v: 1.0 / r(v), foot, hold)[0] + (length - way) / hold - time

    hold = brentq(timed, 15.0, 35.0)
    train = {"resistance": {"constant": c0 * MASS, "quadratic": c2 * MASS}}
    assert optimum(journey(train, length), time).speed.max() == pytest.approx(hold, rel=1e-3)


@pytest.mark.parametrize("back", [0.0, 0.8])
def test_downhill_the_train_speeds_up_by_itself(back):
    """At 20 m/s on −10 ‰ the brake holds; what it gives is all the energy there is."""
    train = {
        "resistance": {"constant": 3000.0, "quadratic": 6.0},
        "regeneration": {"force": 60e3, "power": 1e9},
        "efficiency": {"traction": 1.0, "regeneration": back},
    }
    length, speed = 10e3, 20.0
    spare = MASS * 9.81 * 0.01 - 3000.0 - 6.0 * speed**2
    run = optimum(journey(train, length, gradient=-0.01, passing_speed=speed), time=length / speed)
    assert run.running_time == pytest.approx(length / speed, rel=1e-6)
    assert run.energy == pytest.approx(-back * spare * length, rel=NEAR, abs=1.0)


@pytest.fixture(scope="module")
def study():
    file = Path(__file__).parents[2] / "studies" / "optimum_stress.py"
    spec = importlib.util.spec_from_file_location("optimum_stress", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(("kind", "seed"), [("strong", 2), ("strong", 8), ("weak", 2), ("weak", 9)])
def test_random_lines_at_every_time(study, kind, seed):
    """A part of `studies/optimum_stress.py`."""
    own = Journey(**study.random_journey(kind, seed))
    row = study.looked_at(f"{kind} {seed}", own, 0.0, own.line.length, rules=True)
    found = dict(zip(study.FIELDS[3:], map(float, row[3:]), strict=True))
    assert found["time_off"] < 1e-6
    assert found["rise"] < 1e-6
    assert found["price_rise"] == 0.0
    assert found["overspeed"] < 1e-6
    assert found["overpull"] < 1e-5
    assert found["integral_off"] < 1e-3
    assert found["rule_below"] < 5e-4


def test_a_fading_brake_is_no_step():
    """A brake that fades was a jump in a limit once, over which Newton's method went to and fro."""
    train = {
        "resistance": {"constant": 2000.0, "quadratic": 6.0},
        "regeneration": {"force": 50e3, "power": 1e6, "fade_start": 3.0, "fade_end": 1.0},
        "efficiency": {"traction": 0.9, "regeneration": 0.9},
    }
    leg = LegProblem(journey(train, 8e3, gradient=-0.004), 0.0, 8e3, 0.0, 0.0)
    energies = [leg.energy_of(leg.for_time(leg.least_time * (1 + s))) for s in (0.1, 0.15, 0.2)]
    assert all(b < a for a, b in pairwise(energies))


def test_an_efficiency_map_counts_and_steers_by_its_means():
    """An even map is a constant; one that is poor at part load costs what it says, run by run."""
    from railgrip.campaign.driving import driven
    from railgrip.campaign.optimum.mapped import by_the_map

    speeds, shares = [0.0, 60.0], [0.0, 0.5, 1.0]
    plain = {"resistance": {"constant": 2000.0, "quadratic": 6.0},
             "effort": {"force": 160e3, "power": 3e6}}  # fmt: skip

    def mapped(*row):
        chart = {"speed": speeds, "share": shares, "value": [list(row)] * 2}
        return journey({**plain, "efficiency": {"map": chart}}, 8e3)

    constant = journey({**plain, "efficiency": {"traction": 0.8, "regeneration": 0.8}}, 8e3)
    time = 420.0
    even = optimum(mapped(0.8, 0.8, 0.8), time)
    assert even.energy == pytest.approx(optimum(constant, time).energy, rel=1e-6)
    assert not even.is_optimal  # nothing is proved of a run with a map
    poor = mapped(0.5, 0.7, 0.9)
    run = optimum(poor, time)
    work = float(run.traction @ np.diff(run.position))
    (mean, _), energy = by_the_map(poor, run)
    assert 0.5 < mean < 0.9
    assert run.energy == pytest.approx(energy) == pytest.approx(work / mean)
    found = driven(poor.model_copy(update={"supplement": 0.1}))
    assert found.remarks() == [
        "The optimum is that of the mean efficiencies; its energy counts the map."
    ]
    assert found.ways[-1].energy["pantograph"] < found.ways[0].energy["pantograph"]
