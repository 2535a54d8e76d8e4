"""Readings of one sensor: what is believed, and what is not."""

import numpy as np
import pytest

from railgrip.control import conventional_state as st
from railgrip.control import state_layout as layout
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.wheel_speed import read_wheel

P = ConventionalParameters()
DT = 0.01


def wheel(reference=30.0, speed=30.0):
    state = np.zeros(layout.state_size(1))
    state[st.REFERENCE] = reference
    base = layout.axle_base(0)
    state[base + st.DIAMETER] = 1.0
    state[base + st.SPEED] = state[base + st.SPEED_LAG] = speed
    return state, base


def read(state, base, speed, pressure=0.0, n=1):
    state[base + st.PRESSURE] = pressure
    for _ in range(n):
        state[base + st.READING] = speed() if callable(speed) else speed
        read_wheel(P, state, base, state[st.REFERENCE] > P.dead_reference, DT)


def test_acceleration_of_a_steady_ramp():
    state, base = wheel()
    ramp = iter(30.0 - 1.2 * DT * np.arange(1, 101))
    read(state, base, lambda: next(ramp), n=100)
    assert state[base + st.ACCELERATION] == pytest.approx(-1.2, abs=1e-6)


def test_acceleration_does_not_depend_on_speed():
    state, base = wheel(speed=12.0)
    read(state, base, 12.0, n=10)
    assert state[base + st.ACCELERATION] == 0.0


@pytest.mark.parametrize("reading", [np.nan, np.inf, -np.inf, 1e6])
def test_no_number_is_a_fault_at_once_and_leaves_the_rest_alone(reading):
    state, base = wheel()
    read(state, base, reading)
    assert state[base + st.IS_FAULTY] == 1.0
    assert state[base + st.SPEED] == 30.0


def test_a_sensor_that_comes_back_is_believed_after_a_while():
    state, base = wheel()
    read(state, base, np.nan)
    read(state, base, 30.0, n=299)
    assert state[base + st.IS_FAULTY] == 1.0
    read(state, base, 30.0, n=2)
    assert state[base + st.IS_FAULTY] == 0.0


def test_a_locked_wheel_under_pressure_is_no_dead_sensor():
    state, base = wheel()
    read(state, base, 0.0, pressure=2e5, n=1000)
    assert state[base + st.IS_FAULTY] == 0.0


def test_a_wheel_that_stands_without_brake_is_a_dead_sensor():
    state, base = wheel()
    read(state, base, 0.0, pressure=0.0, n=310)
    assert state[base + st.IS_FAULTY] == 1.0


def test_direction_does_not_count():
    state, base = wheel()
    read(state, base, -25.0)
    assert state[base + st.SPEED] == 25.0


def test_a_braked_wheel_that_reads_the_very_same_is_frozen_and_an_unbraked_one_is_not():
    state, base = wheel()
    state[base + st.LAST_READING] = 30.0
    read(state, base, 30.0, pressure=0.0, n=200)
    assert state[base + st.IS_FAULTY] == 0.0
    read(state, base, 30.0, pressure=2e5, n=49)
    assert state[base + st.IS_FAULTY] == 0.0
    read(state, base, 30.0, pressure=2e5, n=2)
    assert state[base + st.IS_FAULTY] == 1.0


def test_a_locked_wheel_is_not_a_frozen_sensor():
    state, base = wheel()
    read(state, base, 0.0, pressure=2e5, n=500)
    assert state[base + st.IS_FAULTY] == 0.0
