"""What a protection does about sensors: readings no wheel can give, leaders, followers."""

import numpy as np
import pytest

from railgrip.control import contract as ctl
from railgrip.control import conventional_state as st
from railgrip.control import state_layout as layout
from railgrip.control.axle_signals import take_measured
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_wsp import conventional_initial
from railgrip.control.faulty_axle import follow_neighbours
from railgrip.control.train_observer import look_at_wheels
from railgrip.control.wheel_speed import read_wheel

PARAMETERS = ConventionalParameters()
P = np.array(PARAMETERS)
DT = 0.01


def bench(n_axles=4, speed=30.0):
    setup = np.zeros((n_axles, ctl.N_SETUP))
    setup[:, ctl.BRAKED] = 1.0
    setup[:, ctl.BOGIE] = np.arange(n_axles) // 2
    measured = np.zeros((n_axles, ctl.N_MEASURED))
    measured[:, ctl.WHEEL_SPEED] = speed
    measured[:, ctl.BRAKE_DEMAND] = 1.0
    state = np.zeros(layout.state_size(n_axles))
    conventional_initial(P, setup, state, measured)
    return setup, state, measured


def look(setup, state, measured, speeds, n):
    seen = []
    for _ in range(n):
        measured[:, ctl.WHEEL_SPEED] = speeds
        seen.append(look_at_wheels(P, state, measured, 0.008, DT).seen)
    return seen


def read_first(state, measured, dt=DT):
    take_measured(state, measured)
    read_wheel(PARAMETERS, state, layout.axle_base(0), True, dt)


def faulty(state, axle):
    return state[layout.axle_base(axle) + st.IS_FAULTY] > 0.0


@pytest.mark.parametrize("dt", [0.005, 0.01, 0.02])
@pytest.mark.parametrize(("noise", "is_told"), [(0.02, False), (0.2, True)])
def test_noise_is_told_whatever_the_period(noise, is_told, dt):
    _, state, measured = bench(1)
    generator = np.random.default_rng(1)
    for _ in range(round(2.0 / dt)):
        measured[0, ctl.WHEEL_SPEED] = 30.0 + noise * generator.standard_normal()
        read_first(state, measured, dt)
    assert faulty(state, 0) == is_told


def test_a_wheel_that_seizes_does_not_tremble():
    """120 m/s² down, held, 34 m/s² up again (adhesion 0.28), ten times: no fault of the sensor."""
    _, state, measured = bench(1)
    measured[0, ctl.CYLINDER_PRESSURE] = 3e5
    down = np.maximum(30.0 - 120.0 * DT * np.arange(26), 0.0)
    up = np.minimum(34.0 * DT * np.arange(90), 30.0)
    for speed in np.tile(np.concatenate([down, up]), 10):
        measured[0, ctl.WHEEL_SPEED] = speed
        read_first(state, measured)
        assert not faulty(state, 0)


def test_a_jump_is_a_fault_for_a_while_and_heals():
    _, state, measured = bench(1)
    falling = iter(30.0 - 0.005 * np.arange(2000))

    def read(n, offset=0.0):
        for _ in range(n):
            measured[0, ctl.WHEEL_SPEED] = next(falling) + offset
            read_first(state, measured)

    read(50)
    read(1, 5.0)
    assert faulty(state, 0)
    read(200)
    assert faulty(state, 0)
    read(150)
    assert not faulty(state, 0)


def test_two_released_wheels_correct_a_leader_that_is_a_little_too_fast():
    setup, state, measured = bench()
    measured[0, ctl.CYLINDER_PRESSURE] = 2e5
    speeds = np.array([30.0, 30.0, 30.0, 30.0])
    look(setup, state, measured, speeds, 30)
    state[layout.axle_base(0) + st.DIAMETER] = 1.0
    speeds[0] = 31.2
    state[layout.axle_base(0) + st.LAST_READING] = 31.2
    generator = np.random.default_rng(2)
    for _ in range(100):
        # a braked wheel never reads the very same
        speeds[0] = 31.2 + 0.01 * generator.standard_normal()
        look(setup, state, measured, speeds, 1)
    assert not faulty(state, 0)
    assert state[layout.axle_base(0) + st.DIAMETER] == pytest.approx(0.995 * 30.0 / 31.2, rel=2e-3)


def test_one_that_is_much_too_fast_is_dropped_until_the_brake_is_released():
    setup, state, measured = bench()
    measured[0, ctl.CYLINDER_PRESSURE] = 2e5
    look(setup, state, measured, np.full(4, 30.0), 30)
    state[layout.axle_base(0) + st.LAST_READING] = 36.0
    fast = 36.0 + 0.001 * np.arange(400)
    for speed in fast[:40]:
        look(setup, state, measured, np.array([speed, 30, 30, 30]), 1)
    assert faulty(state, 0)
    measured[:, ctl.BRAKE_DEMAND] = 0.0
    for speed in fast[40:]:
        look(setup, state, measured, np.array([speed, 30, 30, 30]), 1)
    assert not faulty(state, 0)


def test_one_released_wheel_alone_convicts_nobody():
    setup, state, measured = bench()
    measured[:3, ctl.CYLINDER_PRESSURE] = 2e5
    generator = np.random.default_rng(3)
    for _ in range(300):
        look(setup, state, measured, [31, 30, 29, 30] + 0.01 * generator.standard_normal(4), 1)
    assert not faulty(state, 0)


def test_a_follower_takes_its_bogie_s_valve_and_without_it_the_vehicle_s():
    setup, state, measured = bench()
    command = np.zeros((4, ctl.N_COMMAND))
    command[:, ctl.DUMP_VALVE] = [ctl.FILL, ctl.HOLD, ctl.VENT, ctl.FILL]
    state[layout.axle_base(0) + st.IS_FAULTY] = 1.0
    follow_neighbours(setup, state, measured, command)
    assert command[0, ctl.DUMP_VALVE] == ctl.HOLD
    state[layout.axle_base(1) + st.IS_FAULTY] = 1.0
    follow_neighbours(setup, state, measured, command)
    assert command[:2, ctl.DUMP_VALVE].tolist() == [ctl.VENT, ctl.VENT]


def test_a_follower_with_more_pressure_vents_and_the_freed_axle_is_no_neighbour():
    setup, state, measured = bench()
    command = np.zeros((4, ctl.N_COMMAND))
    state[layout.axle_base(0) + st.IS_FAULTY] = 1.0
    measured[0, ctl.CYLINDER_PRESSURE] = 1e5
    follow_neighbours(setup, state, measured, command)
    assert command[0, ctl.DUMP_VALVE] == ctl.VENT
    command[1, ctl.DUMP_VALVE] = ctl.VENT
    state[st.FREED_AXLE] = 2.0
    measured[0, ctl.CYLINDER_PRESSURE] = 0.0
    follow_neighbours(setup, state, measured, command)
    assert command[0, ctl.DUMP_VALVE] == ctl.FILL
