"""What holds of the coasting-initiation law, its circuit, and runs under it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from railgrip.control.coasting.coasting_circuit import CoastingCircuit
from railgrip.control.coasting.coasting_law import AnnouncedTarget, CoastingLaw
from railgrip.control.coasting.coasting_parameters import CoastingParameters, check_coasting
from railgrip.control.coasting.moving_authority import moving_authority
from railgrip.control.etcs.steps import Steps, constant
from railgrip.core.errors import RailgripError
from railgrip.laboratory.coasting_run import CoastingRun, Driver
from railgrip.laboratory.point_train import PointTrain

TRAIN = PointTrain(200e3, 0.06, 150e3, 2.5e6, (2.5e3, 30.0, 6.0), 0.7)
SLOW = PointTrain(400e3, 0.06, 120e3, 1.0e6, (5e3, 60.0, 10.0), 0.4)
FAR = [AnnouncedTarget(1e6)]
LIMITS = Steps((0.0, 5000.0, 7000.0), (120 / 3.6, 60 / 3.6, 110 / 3.6))


def law(**changes: Any) -> CoastingLaw:
    return CoastingLaw(
        CoastingParameters(0.7)._replace(**{"coasting_deceleration": 0.2, **changes})
    )


def run(one: CoastingLaw, limits: Steps = LIMITS, **more: Any) -> CoastingRun:
    return Driver(TRAIN, one, limits, 10000.0, **more).run()


places = st.floats(0.0, 9000.0)
speeds = st.floats(0.0, 60.0)
targets = st.lists(
    st.builds(AnnouncedTarget, st.floats(9001.0, 30000.0), st.floats(0.0, 30.0)), max_size=4
)


@given(places, targets, st.sampled_from(["parabolic", "straight"]), st.floats(0.0, 2.0))
def test_the_curve_lies_below_the_braking_curve(
    x: float, announced: list[AnnouncedTarget], shape: str, lift: float
) -> None:
    one = law(shape=shape, flat_braking=1.0, knee_speed=15.0, lift=lift)
    plain = law(shape=shape)
    assert one.coasting_speed(x, announced) <= one.braking_speed(x, announced)
    assert one.coasting_speed(x, announced) >= plain.coasting_speed(x, announced)
    for target in announced:
        assert one.coasting_speed(x, announced) <= one.coasting_speed(x, [target])


@given(st.floats(0.0, 60.0))
def test_raised_at_high_speed_only_where_braking_is_flat(v: float) -> None:
    """Claim 3."""
    raised, steep = (law(flat_braking=b, knee_speed=20.0, lift=0.4) for b in (1.0, 0.5))
    plain = law()
    position = 1e6 - v**2 / 0.4
    assert steep.coasting_speed(position, FAR) == plain.coasting_speed(position, FAR)
    expected = v + 0.4 * max(v - 20.0, 0.0)
    assert raised.coasting_speed(position, FAR) == pytest.approx(
        min(expected, raised.braking_speed(position, FAR)), abs=1e-6
    )


@settings(max_examples=100)
@given(
    st.floats(1e3, 1e5), st.floats(1e3, 1e5), st.floats(1e3, 1e5),
    st.lists(st.tuples(st.floats(100.0, 3000.0), st.floats(0.0, 45.0)), min_size=1, max_size=30),
)  # fmt: skip
def test_the_circuit_is_the_formula(
    r1: float, r2: float, r9: float, track: list[tuple[float, float]]
) -> None:
    """The same curve, and the relay switches as the law does, in any order of situations."""
    circuit = CoastingCircuit(r1, r2, max(r2, 1.01e3), 1e3, r9, 2e-3, 0.1, 15.0)
    one = CoastingLaw(CoastingParameters(
        1e6, shape="straight", distance_gain=circuit.distance_gain,
        speed_gain=circuit.speed_gain, hysteresis=circuit.hysteresis,
    ))  # fmt: skip
    is_on = False
    for distance, v in track:
        target = [AnnouncedTarget(5000.0, 10.0)]
        x = 5000.0 - distance
        curve = circuit.curve(distance, 10.0)
        assert one.coasting_speed(x, target) == pytest.approx(curve, rel=1e-9)
        edge = curve - (circuit.hysteresis if is_on else 0.0)
        if abs(v - edge) < 1e-5:
            continue
        is_on = circuit.relay(is_on, distance, 10.0, v)
        assert one.step(x, v, target).is_acting == is_on


@given(places, speeds, targets)
def test_the_braking_curve_has_priority(
    x: float, v: float, announced: list[AnnouncedTarget]
) -> None:
    command = law().step(x, v, announced)
    assert command.must_brake == (v >= law().braking_speed(x, announced) - 1e-7)
    assert not (command.must_brake and command.is_acting)


def test_hysteresis() -> None:
    """On at the curve, on down to Δ below it, off there, and off up to the curve again."""
    one, at_20 = law(hysteresis=2.0), 1e6 - 1000.0
    seen = [one.step(at_20, v, FAR).is_acting for v in (19.9, 20.0, 19.0, 18.1, 17.9, 19.9, 20.1)]
    assert seen == [False, True, True, True, False, False, True]


@pytest.mark.parametrize(("switch", "expected"), [
    ("hand", [False, True, False, True]), ("control", [False, False, True, True]),
    ("both", [False, False, False, True]),
])  # fmt: skip
def test_switches(switch: str, expected: list[bool]) -> None:
    ways = [(False, False), (True, False), (False, True), (True, True)]
    found = [
        law(switch=switch).step(1e6 - 1000.0, 25.0, FAR, by_hand=hand, by_control=control)
        for hand, control in ways
    ]
    assert [command.is_acting for command in found] == expected
    assert [command.is_ready for command in found] == expected


@pytest.mark.parametrize(("action", "traction", "brake"), [
    ("cut", 0.0, 0.0), ("reduced", 0.3, 0.0), ("light braking", 0.0, 0.1),
])  # fmt: skip
def test_actions(action: str, traction: float, brake: float) -> None:
    command = law(action=action).step(1e6 - 1000.0, 25.0, FAR)
    assert (command.traction, command.brake, command.is_acting) == (traction, brake, True)


def test_off_below_the_least_speed_until_it_is_passed_by_the_hysteresis() -> None:
    one, near = law(least_speed=10.0, hysteresis=1.5), [AnnouncedTarget(200.0)]
    seen = [one.step(0.0, v, near).is_ready for v in (5.0, 10.5, 11.4, 11.6, 10.2, 9.9, 10.2)]
    assert seen == [False, False, False, True, True, False, False]


def test_off_near_a_station_but_not_near_a_speed_limit() -> None:
    one = law(station_distance=500.0)
    for is_station in (True, False):
        target = [AnnouncedTarget(1000.0, 0.0, is_station)]
        assert one.step(400.0, 18.0, target).is_acting
        assert one.step(550.0, 17.0, target).is_acting != is_station
    hold = law(station_distance=500.0, at_station="hold")
    assert hold.step(550.0, 17.0, [AnnouncedTarget(1000.0, 0.0, True)]).holds_speed


def test_the_station_rule_saves_time_and_costs_energy() -> None:
    ways = ((0.0, "hold"), (600.0, "accelerate"), (600.0, "hold"))
    plain, rule, hold = (run(law(station_distance=z, at_station=way)) for z, way in ways)
    assert rule.changes[-1].time < hold.changes[-1].time < plain.changes[-1].time
    assert rule.energy > hold.energy > plain.energy


@pytest.mark.parametrize("shape", ["parabolic", "straight"])
def test_coasting_saves_energy_and_brakes_and_costs_time(shape: str) -> None:
    """Cutting saves most, reducing less; braking lightly saves against running flat out too."""
    flat = run(law(), with_coasting=False)
    found = {a: run(law(shape=shape, action=a, reduced_share=0.1)) for a in
             ("cut", "reduced", "light braking")}  # fmt: skip
    for one in found.values():
        assert one.energy < flat.energy
        assert one.changes[-1].time > flat.changes[-1].time
        assert one.position[-1] == pytest.approx(10000.0, abs=0.01)
    assert found["cut"].energy < found["reduced"].energy
    # where the train does not pull again, both have paid the same
    assert found["cut"].energy <= found["light braking"].energy * (1.0 + 1e-9)
    assert found["cut"].brake_work < found["light braking"].brake_work
    assert found["cut"].changes[-1].time < found["light braking"].changes[-1].time
    assert found["cut"].brake_work < flat.brake_work


def test_runs_do_not_depend_on_the_step() -> None:
    found = [Driver(TRAIN, law(), LIMITS, 10000.0).run(spacing=dt) for dt in (20.0, 0.37)]
    assert found[0].energy == pytest.approx(found[1].energy, rel=1e-7)
    assert found[0].changes[-1].time == pytest.approx(found[1].changes[-1].time, rel=1e-7)
    assert [c.event for c in found[0].changes] == [c.event for c in found[1].changes]


def test_energy_is_conserved() -> None:
    """Traction = resistance + brakes, the resistance integrated apart."""
    gradient = Steps((0.0, 2000.0, 6000.0), (0.0, 0.006, -0.004))
    found = Driver(TRAIN, law(), LIMITS, 10000.0, gradient=gradient).run(spacing=0.1)
    v, x = found.speed, found.position
    g = np.select([x < 2000.0, x < 6000.0], [0.0, 0.006], -0.004)
    force = np.array([TRAIN.running_resistance(a, b) for a, b in zip(v, g, strict=True)])
    lost = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(x)))
    assert found.energy == pytest.approx(lost + found.brake_work, rel=1e-3)


def test_events_agree_with_small_steps() -> None:
    """The law stepped 200 times a second by plain forward steps: the same run within 0.2 %."""
    one, stop = law(), [AnnouncedTarget(4000.0)]
    found = Driver(TRAIN, one, constant(35.0), 4000.0).run()
    one.reset()
    dt, t, x, v, energy = 0.005, 0.0, 0.0, 0.0, 0.0
    while x < 3999.0 and v >= 0.0:
        command = one.step(x, v, stop)
        a = TRAIN.free_acceleration(v, 0.0, command.traction)
        if command.must_brake:
            a = -0.7 - 2.0 * (v - one.braking_speed(x, stop))
        elif v >= 35.0:
            a = min(a, 0.0)
        pull = TRAIN.inertia * a + TRAIN.running_resistance(v, 0.0)
        energy += max(pull, 0.0) * v * dt
        t, x, v = t + dt, x + v * dt + 0.5 * a * dt * dt, v + a * dt
    assert energy == pytest.approx(found.energy, rel=2e-3)
    assert t == pytest.approx(float(np.interp(3999.0, found.position, found.time)), rel=2e-3)


def record(line: float = 20000.0) -> tuple[np.ndarray, np.ndarray]:
    leader = Driver(SLOW, law(), constant(80 / 3.6), line, with_coasting=False).run(2000.0)
    time, first = np.unique(leader.time, return_index=True)
    return time, leader.position[first]


@pytest.mark.parametrize("period", [0.0, 10.0, 30.0])
def test_behind_a_slower_train(period: float) -> None:
    """The follower never passes its authority; coasting spares energy, brakes and switchings."""
    time, position = record()
    authority = moving_authority(time, position, length=300.0, margin=100.0, period=period)
    found = [
        Driver(TRAIN, law(coasting_deceleration=0.3), constant(140 / 3.6), 19000.0,
               authority=authority, with_coasting=on).run()
        for on in (False, True)
    ]  # fmt: skip
    for one in found:
        ends = np.array([authority.target(t).position for t in one.time])
        assert (ends - one.position > 0.0).all()
        assert one.position[-1] == pytest.approx(19000.0, abs=0.01)
    flat, coasting = found
    assert coasting.energy < flat.energy
    assert coasting.brake_work < flat.brake_work
    if period > 0.0:
        assert coasting.switchings < flat.switchings
        assert coasting.energy < 0.5 * flat.energy


def test_following_without_renewal_keeps_the_braking_distance() -> None:
    """Behind a leader at constant speed u the gap settles at u²/2b."""
    authority = moving_authority([0.0, 5000.0], [3000.0, 103000.0], length=100.0, margin=50.0,
                                 period=0.0)  # fmt: skip
    found = Driver(TRAIN, law(), constant(40.0), 60000.0, authority=authority,
                   with_coasting=False).run()  # fmt: skip
    k = int(np.searchsorted(found.time, 2000.0))
    gap = authority.target(float(found.time[k])).position - found.position[k]
    assert gap == pytest.approx(20.0**2 / (2 * 0.7), abs=0.1)


@pytest.mark.parametrize(("changes", "word"), [
    ({"braking": 0.0}, "braking"), ({"coasting_deceleration": 0.8}, "below braking"),
    ({"hysteresis": 0.0}, "hysteresis"), ({"speed_gain": 0.9}, "at least 1"),
    ({"reduced_share": 1.5}, "0 to 1"), ({"action": "brake"}, "action 'brake' unknown"),
])  # fmt: skip
def test_bad_parameters_are_refused(changes: dict[str, Any], word: str) -> None:
    with pytest.raises(RailgripError, match=word):
        check_coasting(CoastingParameters(0.7)._replace(**changes))


def test_a_braking_curve_beyond_the_brake_is_refused() -> None:
    with pytest.raises(RailgripError, match="on the steepest fall"):
        CoastingLaw(CoastingParameters(0.9), brake_on_steepest_fall=0.7)


def test_a_bad_record_of_the_leader_is_refused() -> None:
    with pytest.raises(RailgripError, match="must rise"):
        moving_authority([0.0, 0.0], [0.0, 1.0], length=100.0, margin=0.0)
    with pytest.raises(RailgripError, match="backwards"):
        moving_authority([0.0, 1.0], [1.0, 0.0], length=100.0, margin=0.0)


def test_a_train_that_cannot_climb_is_told_where() -> None:
    with pytest.raises(RailgripError, match="stands and cannot go on"):
        run(law(), gradient=Steps((0.0, 1000.0), (0.0, 0.1)))
