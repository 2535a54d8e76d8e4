"""Laws of journeys without slip: energy balance, no dependence on the step, none beats the best."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from railgrip.campaign.optimum.leg import LegProblem
from railgrip.campaign.optimum.timetable import optimum
from railgrip.core.errors import RailgripError
from railgrip.engine.journey.drive import DrivingLaw, drive
from railgrip.engine.journey.profile import ceiling, limits
from railgrip.scenario.journey import Journey

PLAIN = {
    "mass": "200 t",
    "rotating": 0.0,
    "max_speed": "144 km/h",
    "effort": {"force": "200 kN", "power": "100 MW"},
    "max_deceleration": 0.5,
    "efficiency": {"traction": 1.0, "regeneration": 0.0},
}


def line(length=20e3, **more):
    return {"length": length, "speed_limit": [{"at": 0, "value": "144 km/h"}], **more}


def capped(position, speed, parameters, state, demand):
    """Drive with a share of the effort, and coast above a speed until below another."""
    share, high, low = parameters[0], parameters[1], parameters[2]
    coasting = state[0]
    if speed > high:
        coasting = 1.0
    elif speed < low:
        coasting = 0.0
    demand[0] = 0.0 if coasting > 0.5 else share
    demand[1] = 0.0
    demand[2] = coasting


def coasting_between(share, high, low):
    parameters = np.array([share, high, low])
    return DrivingLaw(capped, lambda leg: (parameters, np.zeros(1)))


def test_a_run_on_paper():
    """200 t, 1 m/s² to 40 m/s in 40 s, 0.5 m/s² to a stand in 80 s and 1600 m, 20 km."""
    run = drive(Journey(train=PLAIN, line=line()))
    assert run.running_time == pytest.approx(40 + 80 + (20e3 - 800 - 1600) / 40, rel=1e-9)
    assert run.energy["pantograph"] == pytest.approx(0.5 * 200e3 * 40**2, rel=1e-7)
    assert run.energy["friction"] == pytest.approx(0.5 * 200e3 * 40**2, rel=1e-7)
    assert run.switchings == 2


def test_preset_acceleration_and_power():
    """At constant power P from v₁ to v₂: t = m (v₂² − v₁²)/(2 P)."""
    train = {**PLAIN, "effort": {"force": "200 kN", "power": "2 MW"}, "max_acceleration": 0.5}
    run = drive(Journey(train=train, line=line()))
    i = int(np.argmax(run.trace["speed"] >= 40.0 - 1e-6))
    # 0.5 m/s² up to 20 m/s, where it takes 2 MW, then constant power up to 40 m/s
    expected = 40.0 + 200e3 * (40.0**2 - 20.0**2) / (2 * 2e6)
    assert run.trace["time"][i] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("gradient_under", ["front", "train"])
@pytest.mark.parametrize("train", ["flirt_tpf", "kiss_sbb", "virm6"])
def test_energy_balance_closes(train, gradient_under):
    journey = Journey(
        train=train, line="st_gallen_wil", gradient_under=gradient_under, curve_resistance=True
    )
    run = drive(journey)
    e = run.energy
    left = e["traction"] - e["motor_brake"] - e["friction"] - e["resistance"] - e["grade"]
    assert abs(left) < 1e-5 * e["traction"]  # work is booked by Simpson's rule, step by step
    chain = journey.train.efficiency
    expected = e["traction"] / chain.traction - e["motor_brake"] * chain.regeneration
    assert e["pantograph"] == pytest.approx(expected, rel=1e-9)


@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    share=st.floats(0.3, 1.0),
    high=st.floats(18.0, 40.0),
    band=st.floats(0.5, 8.0),
    step=st.sampled_from([0.3, 0.7, 2.0]),
)
def test_no_run_beats_the_optimum_nor_depends_on_the_step(share, high, band, step):
    journey = Journey(train="flirt_tpf", line="fribourg_bern", step=1.0)
    law = coasting_between(share, high, high - band)
    run = drive(journey, law)
    again = drive(journey.model_copy(update={"step": step}), law)
    assert again.running_time == pytest.approx(run.running_time, rel=1e-5)
    assert again.energy["pantograph"] == pytest.approx(run.energy["pantograph"], rel=2e-4)
    assert again.switchings == run.switchings
    leg = LegProblem(journey, 0.0, journey.line.length, 0.0, 0.0)
    best = leg.energy_of(leg.for_time(run.running_time))
    assert best <= run.energy["pantograph"] * (1 + 5e-4)
    assert np.all(run.trace["speed"] <= run.trace["permitted"] + 1e-6)


def test_optimum_falls_with_time_and_keeps_every_condition():
    journey = Journey(train="kiss_sbb", line="st_gallen_wil")
    leg = LegProblem(journey, 0.0, journey.line.length, 0.0, 0.0)
    shares = (0.0, 1e-9, 1e-6, 1e-5, 1e-3, 0.02, 0.1, 0.5)
    runs = [leg.for_time(leg.least_time * (1 + share)) for share in shares]
    energies = [leg.energy_of(run) for run in runs]
    assert all(b < a * (1 + 1e-6) for a, b in pairwise(energies))
    assert energies[1] == pytest.approx(energies[0], rel=1e-4)  # nothing jumps at the least time
    train = journey.train
    for run, share in zip(runs, shares, strict=True):
        assert leg.time_of(run.square) == pytest.approx(leg.least_time * (1 + share), rel=1e-7)
        assert np.all(run.square <= leg.grid.limit * (1 + 1e-6))
        pull = leg.traction_of(run) * leg.mass
        middle = 10 * np.sqrt(0.5 * (run.square[1:] + run.square[:-1]))
        assert np.all(pull <= 400e3 * (1 + 1e-5))
        assert np.all(pull * middle <= 6e6 * (1 + 2e-5))
        acceleration = np.diff(run.square) / (2 * leg.grid.width)
        assert acceleration.min() > -1.1 - 1e-5
        assert acceleration.max() < train.max_acceleration + 1e-5


def test_the_price_of_time_is_what_a_second_saves():
    journey = Journey(train="virm6", line="vasteras_kolback")
    leg = LegProblem(journey, 0.0, journey.line.length, 0.0, 0.0)
    time = leg.least_time * 1.06
    less, more = (leg.energy_of(leg.for_time(time + dt)) for dt in (-0.5, 0.5))
    assert leg.for_time(time).price == pytest.approx(less - more, rel=0.01)


def test_a_supplement_is_spread_so_that_no_shift_saves():
    stops = [{"at": 0}, {"at": 8500}, {"at": 13710}]
    journey = Journey(train="flirt_tpf", line="reference", stop=stops, supplement=0.08)
    run = optimum(journey)
    assert run.running_time == pytest.approx(1.08 * run.least_times.sum(), rel=1e-9)
    legs = [LegProblem(journey, a, b, 0.0, 0.0) for a, b in ((0, 8500), (8500, 13710))]
    for shift in (-3.0, 3.0):
        times = [run.running_times[0] + shift, run.running_times[1] - shift]
        other = sum(leg.energy_of(leg.for_time(t)) for leg, t in zip(legs, times, strict=True))
        assert run.energy < other


def climbing():
    """Return 1142 t on 27 ‰ with 170 kN: only with a run-up."""
    hill = [{"at": 0, "value": 0.0}, {"at": 3000, "value": 0.027}, {"at": 3900, "value": 0.0}]
    train = {
        **PLAIN,
        "mass": "1142 t",
        "effort": {"force": "170 kN", "power": "6 MW"},
        "friction_brake": "900 kN",
    }
    return Journey(train=train, line=line(6e3, gradient=hill))


def test_a_climb_with_a_run_up_takes_any_time():
    """Slow before and behind it, fast enough at its foot."""
    leg = LegProblem(climbing(), 0.0, 6e3, 0.0, 0.0)
    for share in (0.3, 1.5, 4.0):
        run = leg.for_time((1 + share) * leg.least_time)
        assert run.is_optimal
        assert leg.time_of(run.square) == pytest.approx((1 + share) * leg.least_time, rel=1e-6)
    assert leg.energy_of(run) < leg.energy_of(leg.fastest)
    foot = np.searchsorted(leg.position, 3000.0)
    # 1142 t lack 132.5 kN over 900 m of the climb, and enter it with what that takes
    lack = 1142e3 * 9.81 * 0.027 - 170e3
    assert 50.0 * run.square[foot] * 1142e3 >= lack * 900.0 * (1 - 1e-3)


def test_a_run_that_arrives_early_says_so(monkeypatch):
    """Where no slower run is found, the result names the seconds."""
    found = LegProblem._newton

    def only_fast(leg, target, price):
        return None if target * 10.0 > 1.2 * leg.least_time else found(leg, target, price)

    monkeypatch.setattr(LegProblem, "_newton", only_fast)
    run = optimum(climbing().model_copy(update={"supplement": 1.0}))
    assert not run.is_optimal
    assert run.early == pytest.approx(2.0 * run.least_times[0] - run.running_time)
    assert run.early > 0.8 * run.least_times[0]


def test_tunnels_cost_energy_and_regeneration_saves_it():
    stops = [{"at": 0}, {"at": 8500}]
    open_line = Journey(train="flirt_tpf", line="reference", stop=stops)
    tunnels = Journey(train="flirt_tpf", line="reference_with_tunnels", stop=stops)
    time = 320.0
    assert optimum(tunnels, time).energy > 1.005 * optimum(open_line, time).energy
    none = open_line.train.model_copy(
        update={"regeneration": open_line.train.regeneration.model_copy(update={"receptivity": 0})}
    )
    without = open_line.model_copy(update={"train": none})
    assert optimum(without, time).energy > optimum(open_line, time).energy


def test_a_higher_limit_waits_for_the_rear():
    steps = [{"at": 0, "value": 20.0}, {"at": 1000, "value": 30.0}]
    train = {**PLAIN, "length": 150.0}
    journey = Journey(train=train, line={"length": 3000.0, "speed_limit": steps})
    assert limits(journey) == [(0.0, 20.0), (1150.0, 30.0)]
    front = Journey(train={**train, "rear_clears": False}, line=journey.line)
    assert limits(front) == [(0.0, 20.0), (1000.0, 30.0)]


@given(speeds=st.lists(st.floats(5.0, 50.0), min_size=1, max_size=8), b=st.floats(0.2, 1.2))
def test_ceiling_is_the_least_of_limits_and_curves(speeds, b):
    steps = [{"at": 500.0 * k, "value": v} for k, v in enumerate(speeds)]
    length = 500.0 * len(speeds)
    train = {**PLAIN, "max_speed": 60.0}
    journey = Journey(train=train, line={"length": length, "speed_limit": steps})
    bounds, square, slope = ceiling(journey, 0.0, length, 0.0, b)
    for place in np.linspace(0.1, length - 0.1, 40):
        k = int(np.searchsorted(bounds, place, "right")) - 1
        found = square[k] + slope[k] * (place - bounds[k])
        targets = [(s["at"], s["value"]) for s in steps if s["at"] > place] + [(length, 0.0)]
        here = [s["value"] for s in steps if s["at"] <= place][-1]
        best = min(here**2, *(v**2 + 2 * b * (at - place) for at, v in targets))
        assert found == pytest.approx(best, rel=1e-9)


def test_what_cannot_be_driven_gets_a_sentence():
    steep = line(gradient=[{"at": 5000, "value": 0.12}])
    with pytest.raises(RailgripError, match=r"cannot climb here and stalls; got a stand at \d+ m"):
        drive(Journey(train=PLAIN, line=steep))
    with pytest.raises(RailgripError, match=r"cannot climb here and stalls; got a stand at \d+ m"):
        optimum(Journey(train=PLAIN, line=steep))
    weak = {**PLAIN, "friction_brake": "50 kN"}
    with pytest.raises(RailgripError, match=r"braking: is more than the brakes give here"):
        drive(Journey(train=weak, line=line()))
    fast = Journey(train=PLAIN, line=line(), time=100.0)
    with pytest.raises(RailgripError, match=r"time: is impossible .*allowed: from 560\.0 s"):
        optimum(fast)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"stop": [{"at": 0}, {"at": 30e3}]}, r"stop\[1\].at: lies off the line"),
        ({"stop": [{"at": 0}]}, "stop: needs at least two"),
        ({"line": {"length": 1e3}}, "line.speed_limit: leaves a gap .* none at all"),
        ({"braking": 0.9}, r"braking: is more than the train allows"),
        ({"time": 900.0, "supplement": 0.1}, "time: and supplement say the same"),
    ],
)
def test_bad_descriptions_get_a_sentence(change, sentence):
    from railgrip.io.checked import checked

    with pytest.raises(RailgripError, match=sentence):
        checked(Journey, {"train": PLAIN, "line": line(), **change}, "x.toml")


def test_efficiency_map_and_auxiliaries():
    even = {"speed": [0.0, 50.0], "share": [0.0, 1.0], "value": [[0.8, 0.8], [0.8, 0.8]]}
    train = {**PLAIN, "efficiency": {"map": even}, "auxiliaries": "100 kW"}
    run = drive(Journey(train=train, line=line()))
    kinetic = 0.5 * 200e3 * 40**2
    expected = kinetic / 0.8 + 100e3 * run.running_time
    assert run.energy["pantograph"] == pytest.approx(expected, rel=1e-6)
    assert math.isclose(run.energy["dc_link"], run.energy["pantograph"])
