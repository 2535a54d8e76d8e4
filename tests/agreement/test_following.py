"""A journey behind another train agrees with the exact run, and never runs beyond its authority."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from railgrip.campaign.coasting_tuning import tune_coasting
from railgrip.control.coasting.coasting_law import CoastingLaw
from railgrip.control.coasting.coasting_parameters import CoastingParameters
from railgrip.control.coasting.moving_authority import moving_authority
from railgrip.control.etcs.steps import constant
from railgrip.core.errors import RailgripError
from railgrip.engine.journey.coasting import coasting_of, indicators
from railgrip.engine.journey.drive import FLAT_OUT, drive
from railgrip.engine.journey.following import Authority, authority_of, follow, leading
from railgrip.laboratory.coasting_run import Driver
from railgrip.laboratory.point_train import PointTrain
from railgrip.scenario.coasting import Coasting
from railgrip.scenario.journey import Journey

FAST = PointTrain(200e3, 0.06, 150e3, 2.5e6, (2.5e3, 30.0, 6.0), 0.7)
SLOW = PointTrain(800e3, 0.04, 200e3, 2.5e6, (10e3, 80.0, 14.0), 0.3)
BRAKING, OWN, BAND = 0.7, 0.4, 1.0
WAY = 18500.0
JOURNEY = Journey(
    train={
        "mass": FAST.mass,
        "rotating": FAST.rotating_mass,
        "max_speed": 140 / 3.6,
        "effort": {"force": FAST.effort, "power": FAST.power},
        "resistance": dict(zip(("constant", "linear", "quadratic"), FAST.resistance, strict=True)),
        "max_acceleration": FAST.acceleration,
        "max_deceleration": BRAKING,
        "efficiency": {"traction": 1.0, "regeneration": 0.0},
    },
    line={"length": WAY, "speed_limit": [{"at": 0, "value": 140 / 3.6}]},
    step=0.25,
)


CUT = coasting_of(
    JOURNEY.model_copy(
        update={"coasting": Coasting(coasting_deceleration=OWN, hysteresis=BAND, least_speed=0.0)}
    )
)


@pytest.fixture(scope="module")
def authority():
    """Behind the exact run of a goods train at 80 km/h that set off 2 km ahead."""
    idle = CoastingLaw(CoastingParameters(0.5))
    ahead = Driver(SLOW, idle, constant(80 / 3.6), 20e3, with_coasting=False).run(2000.0)
    time, kept = np.unique(ahead.time, return_index=True)
    return moving_authority(time, ahead.position[kept], length=500.0, margin=100.0, period=10.0)


@pytest.mark.parametrize("law", [FLAT_OUT, CUT], ids=["flat out", "coasting"])
def test_the_march_from_renewal_to_renewal_is_the_exact_run(authority, law):
    """Same time to 10 ms and 1e-5 of the work, the switchings to the last one."""
    own = CoastingLaw(CoastingParameters(BRAKING, coasting_deceleration=OWN, hysteresis=BAND))
    exact = Driver(
        FAST, own, constant(140 / 3.6), WAY, authority=authority, with_coasting=law is CUT
    ).run(spacing=1.0)
    run = follow(JOURNEY, law, Authority(authority))
    assert exact.switchings > 4
    assert run.switchings == exact.switchings
    assert run.running_time == pytest.approx(exact.changes[-1].time, abs=0.01)
    assert run.energy["traction"] == pytest.approx(exact.energy, rel=1e-5)
    assert run.energy["friction"] == pytest.approx(exact.brake_work, rel=1e-5)
    # where the exact run's changes are; chords of braking steps of 0.36 s are 11 mm off
    places = np.interp(
        [change.time for change in exact.changes], run.trace["time"], run.trace["position"]
    )
    assert places == pytest.approx([change.position for change in exact.changes], abs=0.02)


@pytest.mark.parametrize("law", [FLAT_OUT, CUT], ids=["flat out", "coasting"])
def test_behind_a_steady_authority_it_is_the_exact_run(authority, law):
    """The braking curve moves with the leader: time to 10 ms, work to 1e-5, places to 2 cm."""
    own = CoastingLaw(CoastingParameters(BRAKING, coasting_deceleration=OWN, hysteresis=BAND))
    steady = authority._replace(period=0.0)
    exact = Driver(
        FAST, own, constant(140 / 3.6), WAY, authority=steady, with_coasting=law is CUT
    ).run(spacing=1.0)
    run = follow(JOURNEY, law, Authority(steady))
    print(run.switchings, exact.switchings, run.running_time, exact.changes[-1].time)
    print(run.energy, exact.energy, exact.brake_work)
    assert run.switchings == exact.switchings
    assert run.running_time == pytest.approx(exact.changes[-1].time, abs=0.01)
    assert run.energy["traction"] == pytest.approx(exact.energy, rel=1e-5)
    assert run.energy["friction"] == pytest.approx(exact.brake_work, rel=1e-5)
    places = np.interp(
        [change.time for change in exact.changes], run.trace["time"], run.trace["position"]
    )
    assert places == pytest.approx([change.position for change in exact.changes], abs=0.02)


def test_a_steady_authority_loses_no_work_on_a_real_line():
    journey = Journey(train="flirt_tpf", line="fribourg_bern",
                      leader={"train": "freight", "headway": 240.0, "renewal": 0.0})  # fmt: skip
    run, authority = follow(journey), authority_of(journey)
    ends = np.array([authority.end(float(moment)) for moment in run.trace["time"]])
    assert np.all(run.trace["position"] <= ends + 1e-6)
    e = run.energy
    left = e["traction"] - e["motor_brake"] - e["friction"] - e["resistance"] - e["grade"]
    assert abs(left) < 1e-5 * e["traction"]


def led(**coasting):
    """JOURNEY on a longer line, behind the goods train that set off 200 s before it."""
    train = {
        "mass": SLOW.mass,
        "rotating": SLOW.rotating_mass,
        "max_speed": 80 / 3.6,
        "length": 500.0,
        "effort": {"force": SLOW.effort, "power": SLOW.power},
        "resistance": dict(zip(("constant", "linear", "quadratic"), SLOW.resistance, strict=True)),
        "max_acceleration": SLOW.acceleration,
        "max_deceleration": 0.5,
    }
    leader = {"train": train, "stop": [{"at": 0.0}, {"at": 20e3}], "headway": 200.0,
              "margin": 100.0, **coasting}  # fmt: skip
    line = {"length": 20e3, "speed_limit": [{"at": 0, "value": 140 / 3.6}]}
    own = {"coasting_deceleration": OWN, "hysteresis": BAND, "least_speed": 0.0}
    told = JOURNEY.model_dump() | {"line": line, "stop": [{"at": 0.0}, {"at": WAY}],
                                   "leader": leader, "coasting": own}  # fmt: skip
    return Journey.model_validate(told)


def exact_follower(journey, ahead):
    """Return the exact run behind an exact leader."""
    time, kept = np.unique(ahead.time, return_index=True)
    record = moving_authority(time - 200.0, ahead.position[kept], length=500.0, margin=100.0)
    law = CoastingLaw(journey.coasting.parameters(BRAKING))
    return Driver(FAST, law, constant(140 / 3.6), WAY, authority=record).run(spacing=1.0)


def test_behind_a_leader_that_coasts_it_is_the_exact_run():
    """Both trains exact: time to 10 ms, work to 1e-4 (the record is straight between steps)."""
    coasting = {"coasting_deceleration": 0.1, "hysteresis": 2.0, "least_speed": 0.0}
    journey = led(coasting=coasting)
    law = CoastingLaw(CoastingParameters(0.5, coasting_deceleration=0.1, hysteresis=2.0))
    ahead = Driver(SLOW, law, constant(80 / 3.6), 20e3).run(spacing=0.25)
    exact = exact_follower(journey, ahead)
    run = follow(journey, coasting_of(journey))
    fast = leading(journey)
    assert fast.running_time == pytest.approx(ahead.changes[-1].time, rel=1e-5)
    assert fast.running_time > leading(led()).running_time + 4.0
    assert run.switchings == exact.switchings > 4
    assert run.running_time == pytest.approx(exact.changes[-1].time, abs=0.01)
    assert run.energy["traction"] == pytest.approx(exact.energy, rel=1e-4)
    assert run.energy["friction"] == pytest.approx(exact.brake_work, rel=1e-4)


@pytest.fixture(scope="module")
def plain_leader():
    idle = CoastingLaw(CoastingParameters(0.5))
    return Driver(SLOW, idle, constant(80 / 3.6), 20e3, with_coasting=False).run(spacing=0.25)


def test_indicators_behind_a_leader_are_those_of_the_exact_run(plain_leader):
    """Every change of the acting indicator, within 0.1 s and 2 m."""
    journey = led()
    exact = exact_follower(journey, plain_leader)
    told = indicators(follow(journey, coasting_of(journey)))
    changes = [b for a, b in pairwise([exact.changes[0], *exact.changes])
               if a.is_acting != b.is_acting]  # fmt: skip
    found = [b for a, b in pairwise([told[0], *told]) if a.is_acting != b.is_acting]
    assert len(changes) > 4
    assert [one.is_acting for one in found] == [one.is_acting for one in changes]
    assert [one.time for one in found] == pytest.approx([one.time for one in changes], abs=0.1)
    places = [one.position for one in changes]
    assert [one.position for one in found] == pytest.approx(places, abs=2.0)


def test_tuning_behind_a_leader_gives_what_the_exact_run_gives(plain_leader):
    journey = led()
    late = 1.03 * follow(journey).running_time
    found = tune_coasting(journey, late, rounds=1)
    exact = exact_follower(found.journey, plain_leader)
    assert found.run.running_time == pytest.approx(exact.changes[-1].time, rel=1e-4)
    assert found.run.energy["traction"] == pytest.approx(exact.energy, rel=1e-3)
    assert found.run.energy["pantograph"] < 0.5 * found.flat_out.energy["pantograph"]
    steady = led(renewal=0.0)
    with pytest.raises(RailgripError, match=r"leader.renewal: is steady"):
        tune_coasting(steady, late)


def test_coasting_behind_a_slow_train_saves_energy(authority):
    flat_out, coasting = (follow(JOURNEY, law, Authority(authority)) for law in (FLAT_OUT, CUT))
    assert coasting.energy["traction"] < 0.3 * flat_out.energy["traction"]
    assert coasting.energy["friction"] < 0.2 * flat_out.energy["friction"]
    assert coasting.switchings < flat_out.switchings
    assert coasting.running_time < 1.02 * flat_out.running_time


def behind(**leader):
    return Journey(
        train="flirt_tpf",
        line="st_gallen_wil",
        leader={"train": "kiss_sbb", "passing_speed": 0.0, **leader},
    )


@pytest.mark.parametrize("renewal", [3.0, 20.0])
def test_the_front_stays_behind_the_authority(renewal):
    journey = behind(
        headway=60.0,
        renewal=renewal,
        stop=[{"at": 0.0}, {"at": 15e3, "dwell": 90.0}, {"at": 29000.0}],
    )
    authority = authority_of(journey)
    run = follow(journey)
    time, place = run.trace["time"], run.trace["position"]
    ends = np.array([authority.end(float(moment)) for moment in time])
    assert np.all(place <= ends + 1e-6)
    assert run.running_time > drive(journey).running_time + 30.0
    e = run.energy
    left = e["traction"] - e["motor_brake"] - e["friction"] - e["resistance"] - e["grade"]
    assert abs(left) < 1e-5 * e["traction"]


def test_far_behind_it_is_the_free_run():
    journey = behind(headway=3000.0)
    free, run = drive(journey), follow(journey)
    assert run.running_time == pytest.approx(free.running_time, rel=1e-12)
    assert run.energy == pytest.approx(free.energy, rel=1e-12)
    assert run.switchings == free.switchings


def test_a_start_inside_the_leader_says_from_when_on_it_is_possible():
    with pytest.raises(RailgripError, match=r"leader.headway: .* allowed: above \d+\.\d s") as told:
        authority_of(behind(headway=5.0))
    least = float(str(told.value).rpartition("above ")[2].split()[0])
    ahead = leading(behind())
    front = float(np.interp(least, ahead.trace["time"], ahead.trace["position"]))
    assert front == pytest.approx(ahead.journey.train.length + 100.0, abs=5.0)
    assert authority_of(behind(headway=least + 0.2)).end(0.0) > 0.0


def test_what_is_wrong_with_the_leader_is_said_of_the_leader():
    with pytest.raises(RailgripError, match="leader: is missing"):
        leading(Journey(train="local", line="const"))
    with pytest.raises(RailgripError, match=r"leader.stop\[1\].at: lies off the line"):
        leading(behind(stop=[{"at": 0.0}, {"at": 90e3}]))
