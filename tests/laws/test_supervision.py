"""What holds of any train under ETCS supervision."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from railgrip.control.etcs.braked_weight import deceleration_of
from railgrip.control.etcs.ceiling import ceiling_margin
from railgrip.control.etcs.curves import brake_field, emergency_curve
from railgrip.control.etcs.deceleration_curve import deceleration_curve
from railgrip.control.etcs.intervention_times import times_of
from railgrip.control.etcs.limit_speed import limit_speed
from railgrip.control.etcs.steps import Steps, constant
from railgrip.control.etcs.supervision import supervision_limits
from railgrip.control.etcs.train_data import (
    Brakes,
    SupervisedTrain,
    Target,
    Track,
    reduced_adhesion,
)
from railgrip.core.errors import RailgripError

SPEEDS = np.linspace(2.0, 45.0, 30)


def train(
    deceleration: float = 0.9, length: float = 300.0, normal: float | None = None, **more: float
) -> SupervisedTrain:
    brake = Steps((0.0, 20.0), (1.1 * deceleration, deceleration))
    guide = None if normal is None else constant(normal)
    return SupervisedTrain(length, Brakes(brake, brake.scaled(0.8), 4.0, 5.0, guide), **more)


def track(*points: tuple[float, float]) -> Track:
    at, value = zip(*points, strict=True)
    return Track(Steps(at, value))


hills = st.lists(st.floats(-0.02, 0.02), min_size=1, max_size=4).map(
    lambda values: track(*((1500.0 + 900.0 * i, value) for i, value in enumerate(values)))
)


@settings(max_examples=40, deadline=None)
@given(hills, st.floats(0.5, 1.2), st.booleans(), st.booleans(), st.sampled_from([0.0, 12.0]))
def test_order_of_the_limits(
    hill: Track, b: float, interface: bool, cuts: bool, target_speed: float
) -> None:
    """Indication before permitted before warning before SBI2 before EBI before EBD."""
    one = train(b, normal=0.4, commands_service_brake=interface, cuts_traction=cuts,
                traction_cut_off_time=3.0, acceleration=0.3, compensates_speed=True)  # fmt: skip
    target = Target(5000.0, target_speed, is_end_of_authority=target_speed == 0.0)
    found = supervision_limits(one, hill, target, SPEEDS + target_speed)
    order = ("indication", "permitted", "warning", "sbi2", "ebi", "ebd")
    for outer, inner in pairwise(order):
        assert (getattr(found, outer) >= getattr(found, inner) - 1e-9).all(), (outer, inner)
    for name in order:
        assert (np.diff(getattr(found, name)) > 0.0).all(), name


@settings(max_examples=30, deadline=None)
@given(hills, st.floats(0.5, 1.2), st.floats(0.005, 0.3))
def test_a_stronger_brake_never_needs_more(hill: Track, b: float, more: float) -> None:
    weak, strong = (supervision_limits(train(x), hill, Target(5000.0), SPEEDS)
                    for x in (b, b + more))  # fmt: skip
    for name in ("ebd", "sbd", "ebi", "permitted", "indication"):
        assert (getattr(strong, name) < getattr(weak, name)).all()


@settings(max_examples=30, deadline=None)
@given(st.floats(-0.03, 0.03), st.floats(0.001, 0.01))
def test_a_steeper_fall_needs_more(gradient: float, steeper: float) -> None:
    found, worse = (supervision_limits(train(), track((0.0, g)), Target(5000.0), SPEEDS)
                    for g in (gradient, gradient - steeper))  # fmt: skip
    assert (worse.ebd > found.ebd).all()


@settings(max_examples=30, deadline=None)
@given(hills, st.floats(0.0, 200.0), st.floats(1.0, 500.0))
def test_a_longer_train_never_needs_less(hill: Track, length: float, more: float) -> None:
    """It has the least gradient under it for longer."""
    short, long = (supervision_limits(train(length=x), hill, Target(5000.0), SPEEDS)
                   for x in (length, length + more))  # fmt: skip
    assert (long.ebd >= short.ebd - 1e-9).all()


@settings(max_examples=15, deadline=None)
@given(hills, st.floats(0.5, 1.2))
def test_the_curve_is_the_motion_of_a_train_that_brakes(hill: Track, b: float) -> None:
    """Against an integration in time forwards from 44 m/s (scipy, small steps), 0.2 m."""
    one = train(b)
    curve = emergency_curve(one, hill, Target(5000.0), 45.0)
    field = brake_field(one, hill, one.brakes.safe)
    begin = float(curve.position_at(44.0))
    stands = lambda t, y: y[1] - 0.5  # noqa: E731
    stands.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(
        lambda t, y: (y[1], -field.at(y[1], y[0])), (0.0, 200.0), (begin, 44.0),
        events=stands, max_step=0.05, rtol=1e-8,
    )  # fmt: skip
    assert run.y[0, -1] == pytest.approx(float(curve.position_at(0.5)), abs=0.2)


def test_speed_and_position_are_inverse() -> None:
    hill = track((0.0, 0.0), (3000.0, -0.01), (4000.0, 0.008))
    curve = deceleration_curve(
        brake_field(train(), hill, train().brakes.safe), 5000.0, 10.0, lowest=0.0, highest=40.0
    )
    speeds = np.linspace(0.0, 40.0, 81)
    assert curve.speed_at(curve.position_at(speeds)) == pytest.approx(speeds, abs=1e-6)
    assert curve.position_at(10.0) == pytest.approx(5000.0)


def test_level_curve_is_the_textbook_one() -> None:
    """v²/2b with b in two steps, worked out by hand."""
    found = supervision_limits(train(1.0), track((0.0, 0.0)), Target(5000.0), [40.0])
    assert float(found.ebd[0]) == pytest.approx(400.0 / 2.2 + 1200.0 / 2.0)


def test_reduced_adhesion_caps_the_emergency_brake_only() -> None:
    wet = Track(constant(0.0), reduced_adhesion(((0.0, 5000.0),), 300.0, 0.5))
    found = supervision_limits(train(1.0), wet, Target(5000.0), [40.0])
    dry = supervision_limits(train(1.0), Track(constant(0.0)), Target(5000.0), [40.0])
    assert float(found.ebd[0]) == pytest.approx(1600.0)
    assert float(found.sbd[0]) == float(dry.sbd[0])


def test_guidance_moves_the_permitted_speed_outwards() -> None:
    for target in (Target(5000.0), Target(5000.0, 15.0, is_end_of_authority=False)):
        plain, guided = (supervision_limits(train(normal=n), track((0.0, -0.005)), target, [40.0])
                         for n in (None, 0.3))  # fmt: skip
        assert float(guided.permitted[0]) == float(guided.gui[0]) > float(plain.permitted[0])
        assert float(guided.warning[0]) == float(plain.warning[0])


def test_a_fall_that_the_brake_does_not_hold_is_refused() -> None:
    with pytest.raises(RailgripError, match="does not slow the train on the gradient"):
        supervision_limits(train(0.3), track((0.0, -0.05)), Target(5000.0), SPEEDS)


def test_the_driver_s_time_in_the_indication() -> None:
    """SUBSET-026 v4: 4 s more."""
    found = [supervision_limits(train(), track((0.0, 0.0)), Target(5000.0), SPEEDS,
                                driver_reacts=way) for way in (False, True)]  # fmt: skip
    assert found[1].indication - found[0].indication == pytest.approx(4.0 * SPEEDS)
    assert (found[1].permitted == found[0].permitted).all()


def test_the_indication_knows_the_true_brake_whoever_commands_it() -> None:
    """0.8 T_bs with T_bs = 10 s, with and without interface."""
    for interface in (False, True):
        one = train(commands_service_brake=interface)
        one = one._replace(brakes=one.brakes._replace(service_time=10.0))
        found = supervision_limits(one, track((0.0, 0.0)), Target(5000.0), [40.0])
        assert float(found.indication[0] - found.permitted[0]) == pytest.approx(8.0 * 40.0)


@pytest.mark.parametrize(
    ("interface", "cuts", "traction"),
    [(False, False, 9.0), (False, True, 7.0), (True, True, 2.0), (True, False, 9.0)],
)
def test_traction_before_the_brake(interface: bool, cuts: bool, traction: float) -> None:
    """T_traction = max(T_cutoff − (T_warning + T_bs2), 0) with an interface, else T_cutoff."""
    one = train(commands_service_brake=interface, cuts_traction=cuts, traction_cut_off_time=9.0)
    found = times_of(one)
    assert found.traction == pytest.approx(traction)
    assert found.remaining == pytest.approx(max(4.0 - traction, 0.0))


@given(st.floats(5.0, 35.0))
def test_to_a_speed_limit_the_curve_meets_the_ceiling_s_margin_at_the_target(v: float) -> None:
    target = Target(5000.0, v, is_end_of_authority=False)
    curve = emergency_curve(train(), track((0.0, 0.0)), target, 50.0)
    assert float(curve.position_at(v + ceiling_margin(v))) == pytest.approx(5000.0)
    found = supervision_limits(train(), track((0.0, 0.0)), target, [v - 0.5, v, v + 1.0])
    assert np.isnan(found.ebd[0])
    assert np.isnan(found.sbd).all()
    assert float(found.permitted[1]) >= 0.0


@given(st.floats(30.0, 245.0), st.floats(3.0, 5.0))
def test_more_braked_weight_never_needs_more(percentage: float, more: float) -> None:
    """Over the whole range of the conversion, at speeds up to 200 km/h."""
    found = []
    for value in (percentage, percentage + more):
        one = train()._replace(brakes=Brakes(deceleration_of(value), constant(1.0), 4.0, 5.0))
        found.append(supervision_limits(one, track((0.0, 0.0)), Target(9000.0), SPEEDS).ebd)
    assert (found[1] < found[0]).all()


@given(hills, st.floats(1000.0, 4800.0))
def test_limit_speed_inverts_the_limits(hill: Track, position: float) -> None:
    speed = limit_speed(train(), hill, Target(5000.0), position, ceiling=60.0)
    limits = supervision_limits(train(), hill, Target(5000.0), [speed])
    distance = 5000.0 - position
    assert speed == pytest.approx(60.0) or float(limits.permitted[0]) == pytest.approx(
        distance, abs=1e-5
    )


def test_a_supervised_location_behind_the_end_of_authority() -> None:
    """The emergency brake may use the overlap, the service brake not."""
    targets = Target(5000.0), Target(5000.0, supervised_location=5080.0)
    level = track((0.0, 0.0))
    plain, overlap = (supervision_limits(train(), level, target, SPEEDS) for target in targets)
    assert plain.ebd - overlap.ebd == pytest.approx(80.0)
    assert (plain.sbd == overlap.sbd).all()
    assert overlap.warning - 2.0 * SPEEDS == pytest.approx(np.maximum(overlap.sbi1, overlap.sbi2))
