"""One axle: band, stepped filling, safety timer, dynamic brake, sand, diameter."""

import numpy as np
import pytest

from railgrip.control import contract as ctl
from railgrip.control import conventional_state as st
from railgrip.control import state_layout as layout
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.diameter_compensation import learn_diameters
from railgrip.control.dynamic_handover import hand_over
from railgrip.control.safety_timer import watch_release
from railgrip.control.sanding_request import request_sand
from railgrip.control.slip_band import note_slide, threshold, wish
from railgrip.control.stepped_filling import step_filling

PARAMETERS = ConventionalParameters()
P = np.array(PARAMETERS)
DT = 0.01
BASE = layout.axle_base(0)


@pytest.fixture
def state():
    state = np.zeros(layout.state_size(2))
    state[st.REFERENCE] = 30.0
    state[BASE + st.DIAMETER] = state[layout.axle_base(1) + st.DIAMETER] = 1.0
    return state


@pytest.fixture
def measured():
    return np.zeros((2, ctl.N_MEASURED))


def test_wish_follows_the_band_and_looks_ahead():
    lower, upper = 2.0, 4.0
    assert wish(PARAMETERS.lead_time, 1.0, 0.0, lower, upper) == ctl.FILL
    assert wish(PARAMETERS.lead_time, 3.0, 0.0, lower, upper) == ctl.HOLD
    assert wish(PARAMETERS.lead_time, 5.0, 0.0, lower, upper) == ctl.VENT
    assert wish(PARAMETERS.lead_time, 3.0, -10.0, lower, upper) == ctl.VENT
    assert wish(PARAMETERS.lead_time, 5.0, 10.0, lower, upper) == ctl.HOLD


def test_floor_rules_at_low_speed():
    assert threshold(0.008, 0.15, 40.0) == pytest.approx(0.32)
    assert threshold(0.008, 0.15, 10.0) == 0.15


def test_a_slide_ends_only_after_it_has_stayed_small(state):
    note_slide(state, BASE, ctl.VENT, 5.0, 2.0, DT)
    assert state[BASE + st.SLIDES] == 1.0
    for _ in range(25):
        note_slide(state, BASE, ctl.FILL, 1.0, 2.0, DT)
    assert state[BASE + st.SLIDES] == 1.0
    for _ in range(10):
        note_slide(state, BASE, ctl.FILL, 1.0, 2.0, DT)
    assert state[BASE + st.SLIDES] == 0.0


def test_filling_after_a_slide_comes_in_steps(state):
    valves = [step_filling(PARAMETERS, state, BASE, ctl.FILL, DT) for _ in range(56)]
    period = round((PARAMETERS.fill_pulse + PARAMETERS.fill_hold) / DT)
    assert period == 28
    assert valves[:28].count(ctl.FILL) == round(PARAMETERS.fill_pulse / DT)
    assert valves[:28] == valves[28:]
    assert ctl.VENT not in valves


def test_filling_is_even_once_the_axle_has_settled(state):
    state[BASE + st.ADHERED_CLOCK] = PARAMETERS.settle_time + 0.1
    assert {step_filling(PARAMETERS, state, BASE, ctl.FILL, DT) for _ in range(50)} == {ctl.FILL}


def test_hold_and_vent_pass(state):
    assert step_filling(PARAMETERS, state, BASE, ctl.HOLD, DT) == ctl.HOLD
    assert step_filling(PARAMETERS, state, BASE, ctl.VENT, DT) == ctl.VENT


def test_safety_timer_fills_after_its_time_and_until_the_wheel_answers(state):
    ticks = 0
    while not watch_release(PARAMETERS, state, BASE, ctl.VENT, DT):
        ticks += 1
        assert ticks < 2000
    assert ticks * DT == pytest.approx(PARAMETERS.safety_time, abs=0.02)
    assert watch_release(PARAMETERS, state, BASE, ctl.FILL, DT)
    state[BASE + st.ACCELERATION] = -5.0
    assert not watch_release(PARAMETERS, state, BASE, ctl.FILL, DT)


def test_safety_timer_waits_for_a_wheel_on_its_way_back(state):
    state[BASE + st.ACCELERATION] = 1.0
    assert not any(watch_release(PARAMETERS, state, BASE, ctl.VENT, DT) for _ in range(3000))


def test_safety_timer_does_not_count_an_axle_held_under_pressure(state):
    state[BASE + st.PRESSURE] = 1e5
    assert not any(watch_release(PARAMETERS, state, BASE, ctl.HOLD, DT) for _ in range(3000))


def test_dynamic_brake_goes_out_in_its_time_and_comes_back_late(state):
    share = 1.0
    ticks = 0
    while share > 0.0:
        share = hand_over(PARAMETERS, state, BASE, ticks == 0, 8e3, share, DT)
        ticks += 1
    assert ticks * DT == pytest.approx(PARAMETERS.dynamic_release_time, abs=0.011)
    state[BASE + st.ADHERED_CLOCK] = PARAMETERS.dynamic_return_after - 0.5
    assert hand_over(PARAMETERS, state, BASE, False, 0.0, share, DT) == 0.0
    state[BASE + st.ADHERED_CLOCK] = PARAMETERS.dynamic_return_after + 0.5
    for _ in range(round(PARAMETERS.dynamic_return_time / DT) + 1):
        share = hand_over(PARAMETERS, state, BASE, False, 0.0, share, DT)
    assert share == 1.0


def test_an_axle_without_dynamic_force_hands_nothing_over(state):
    assert hand_over(PARAMETERS, state, BASE, True, 0.0, 1.0, DT) == 1.0


def sand_asked(state):
    return request_sand(PARAMETERS, state, BASE, state[st.REFERENCE], DT)


def test_sand_after_a_while_of_sliding_and_for_a_while(state):
    state[BASE + st.SLIDES] = 1.0
    sand = [sand_asked(state) for _ in range(100)]
    assert sand.index(1.0) * DT == pytest.approx(PARAMETERS.sand_after, abs=0.02)
    state[BASE + st.SLIDES] = 0.0
    after = [sand_asked(state) for _ in range(400)]
    assert sum(after) * DT == pytest.approx(PARAMETERS.sand_time, abs=0.02)


def test_no_sand_near_the_stop(state):
    state[BASE + st.SLIDES] = 1.0
    state[st.REFERENCE] = PARAMETERS.sand_above - 0.1
    assert not any(sand_asked(state) for _ in range(500))


def test_diameters_agree_after_coasting(state, measured):
    measured[:, ctl.WHEEL_SPEED] = [30.6, 30.0]
    for _ in range(round(5 * PARAMETERS.diameter_time / DT)):
        learn_diameters(P, state, measured, DT)
    factors = state[[BASE + st.DIAMETER, layout.axle_base(1) + st.DIAMETER]]
    assert factors * measured[:, ctl.WHEEL_SPEED] == pytest.approx([30.3, 30.3], rel=1e-3)


@pytest.mark.parametrize(
    ("column", "value"),
    [
        (ctl.BRAKE_DEMAND, 0.1),
        (ctl.CYLINDER_PRESSURE, 1e5),
        (ctl.CYLINDER_PRESSURE, np.nan),
        (ctl.DYNAMIC_FORCE, 5e3),
    ],
)
def test_diameters_are_left_alone_under_any_brake(state, measured, column, value):
    measured[:, ctl.WHEEL_SPEED] = [30.6, 30.0]
    measured[1, column] = value
    for _ in range(1000):
        learn_diameters(P, state, measured, DT)
    assert state[BASE + st.DIAMETER] == 1.0


def test_a_sliding_or_dead_axle_is_no_diameter(state, measured):
    measured[:, ctl.WHEEL_SPEED] = [0.0, 30.0]
    for _ in range(1000):
        learn_diameters(P, state, measured, DT)
    assert state[BASE + st.DIAMETER] == 1.0
