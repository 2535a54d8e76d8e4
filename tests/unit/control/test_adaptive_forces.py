"""F0, FB and slid distance of axles whose motion and brake are given."""

import numpy as np
import pytest

from railgrip.control import contract as ctl
from railgrip.control import conventional_state as st
from railgrip.control.adaptive_forces import weigh_axles
from railgrip.control.adaptive_parameters import BY_LOAD, FORCES, PRESSURE, AdaptiveParameters
from railgrip.control.adaptive_state import (
    F0,
    FACTOR,
    FOLLOWER_FORCE,
    IS_LEAD,
    LEADER_FORCE,
    MACRO_FORCE,
    MEAN,
    MICRO_FORCE,
    N_MACRO,
    N_MICRO,
    RANGE_CLOCK,
    SLID,
)
from railgrip.control.adaptive_supervisor import set_range
from railgrip.control.adaptive_wsp import AdaptiveWSP, adaptive_initial
from railgrip.control.contract_signals import bench_setup
from railgrip.control.conventional_state import (
    ACCELERATION,
    DECELERATION,
    FREED_AXLE,
    IS_FAULTY,
    REFERENCE,
    SETTLED_CLOCK,
    SPEED,
)
from railgrip.control.state_layout import axle_base, state_size

N = 4
DT = 0.02
SPEED_NOW = 40.0


class Bench:
    """Four axles, trailing ones of a bench train; motion and brake are written by hand."""

    def __init__(self, setup=None, **parameters):
        self.parameters = np.array(AdaptiveParameters(**parameters))
        setup = bench_setup(N, 0.01)._replace(motored=np.zeros(N, bool)) if setup is None else setup
        self.setup = ctl.setup_array(setup)
        self.measured = np.zeros((N, ctl.N_MEASURED))
        self.measured[:, ctl.WHEEL_SPEED] = SPEED_NOW
        self.state = np.zeros(state_size(N))
        adaptive_initial(self.parameters, self.setup, self.state, self.measured)
        self.state[REFERENCE] = SPEED_NOW
        self.state[DECELERATION] = 0.5

    def run(self, seconds, slip=0.0, acceleration=-0.5, pressure=1e5, axles=range(N)):
        for axle in axles:
            self.state[axle_base(axle) + SPEED] = SPEED_NOW * (1 - slip)
            self.state[axle_base(axle) + ACCELERATION] = acceleration
            self.state[axle_base(axle) + st.PRESSURE] = pressure
        for _ in range(round(seconds / DT)):
            weigh_axles(self.parameters, self.state, N, DT)

    def of(self, axle, place):
        return self.state[axle_base(axle) + place]

    def sum(self, place):
        return self.state[place]


def test_f0_is_stored_at_breakaway_and_kept():
    bench = Bench(signal=PRESSURE)
    bench.run(2.0, slip=0.002, pressure=1.0e5)
    assert bench.of(0, F0) == 0.0
    bench.run(DT, slip=0.02, acceleration=-3.0, pressure=1.0e5)
    assert bench.of(0, F0) == pytest.approx(1.0e5, rel=1e-6)
    bench.run(2.0, slip=0.1, acceleration=-3.0, pressure=2.0e5)
    assert bench.of(0, F0) == pytest.approx(1.0e5, rel=1e-6)
    bench.run(DT, slip=0.002, pressure=2.0e5)
    bench.run(DT, slip=0.02, acceleration=-3.0, pressure=2.0e5)
    assert bench.of(0, F0) > 1.9e5


def test_slip_that_does_not_grow_is_no_breakaway():
    bench = Bench()
    bench.run(1.0, slip=0.002)
    bench.run(1.0, slip=0.03, acceleration=-0.6)
    assert bench.of(0, F0) == 0.0


def test_the_force_of_the_rail_leaves_out_what_slows_the_wheel():
    """A cylinder that fills on: pressure runs ahead by the wheel's inertia, the force does not."""
    found = {}
    for name, signal in (("pressure", 0.0), ("force", 1.0)):
        bench = Bench(signal=signal, f0_filter=0.0)
        bench.run(1.0, slip=0.002, pressure=1.0e5)
        bench.run(DT, slip=0.02, acceleration=-4.0, pressure=2.0e5)
        found[name] = bench.of(0, F0)
    assert found["pressure"] == pytest.approx(2.0e5)
    # rotating share 0.1, 4e-6 m/(s² Pa): 4 m/s² stand for 1 bar
    assert found["force"] == pytest.approx(1.0e5)


def test_means_and_slid_distance_begin_anew_after_a_change_of_range():
    bench = Bench(mean_time=0.0)
    bench.run(3.0, slip=0.1)
    assert bench.of(1, SLID) == pytest.approx(4.0 * 1.5, abs=0.2)
    set_range(bench.state, 1, ctl.MICRO)
    bench.run(1.4, slip=0.1)
    assert bench.of(1, SLID) == 0.0
    bench.run(1.1, slip=0.1)
    assert bench.of(1, SLID) == pytest.approx(4.0 * 1.0, abs=0.2)
    assert bench.of(0, SLID) > 4.0 * 3.5


def broken_away(**parameters):
    bench = Bench(**parameters)
    bench.run(2.0, slip=0.002)
    bench.run(0.1, slip=0.03, acceleration=-3.0)
    bench.run(2.0, slip=0.1)
    return bench


def test_sums_over_the_ranges():
    bench = broken_away(rule=FORCES)
    set_range(bench.state, 2, ctl.MICRO)
    bench.run(2.0, slip=0.1)
    assert (bench.sum(N_MACRO), bench.sum(N_MICRO)) == (3.0, 1.0)
    macro = sum(bench.of(axle, MEAN) for axle in (0, 1, 3))
    assert bench.sum(MACRO_FORCE) == pytest.approx(macro)
    assert bench.sum(MICRO_FORCE) == pytest.approx(bench.of(2, MEAN))


def test_an_axle_that_never_broke_away_enters_no_sum():
    bench = Bench()
    bench.run(3.0, slip=0.002)
    assert bench.sum(N_MACRO) == 0.0


@pytest.mark.parametrize(
    "spoil",
    [
        lambda state: state.__setitem__(FREED_AXLE, 2.0),
        lambda state: state.__setitem__(axle_base(1) + IS_FAULTY, 1.0),
        lambda state: state.__setitem__(axle_base(1) + SETTLED_CLOCK, 2.0),
    ],
)
def test_released_faulty_and_cut_out_axles_enter_no_sum(spoil):
    bench = broken_away()
    spoil(bench.state)
    bench.run(DT, slip=0.1)
    assert bench.sum(N_MACRO) == 3.0
    assert bench.of(1, RANGE_CLOCK) == 0.0


def test_the_lookout_moves_on_when_an_axle_fails():
    bench = broken_away()
    assert [bench.of(axle, IS_LEAD) for axle in range(N)] == [1.0, 1.0, 0.0, 0.0]
    bench.state[axle_base(0) + IS_FAULTY] = 1.0
    bench.run(1.0, slip=0.1)
    assert [bench.of(axle, IS_LEAD) for axle in range(N)] == [0.0, 1.0, 1.0, 0.0]
    assert bench.sum(LEADER_FORCE) == bench.of(1, MEAN)
    assert bench.sum(FOLLOWER_FORCE) == bench.of(2, MEAN)


def test_scaled_by_load_or_a_given_factor():
    load = np.array([1.6e5, 1.6e5, 1.2e5, 1.2e5])
    motored = np.array([True, False, False, False])
    setup = bench_setup(N, 0.01)._replace(motored=motored, axle_load=load)
    bench = Bench(setup, scale=BY_LOAD, motored_factor=0.8)
    factors = [bench.of(axle, FACTOR) for axle in range(N)]
    assert factors == pytest.approx([0.8, 1.0, 1.6 / 1.2, 1.6 / 1.2])


def test_the_start_in_micro_keeps_the_lookout_in_macro():
    controller = AdaptiveWSP(AdaptiveParameters(start=ctl.MICRO))
    state = controller.reset(bench_setup(N, 0.01))
    one = np.full(N, 30.0)
    command = controller.step(state, ctl.Measured(one, one, 0 * one, 1.0, 1.0), 0.01)
    assert command.slip_range.tolist() == [2.0, 2.0, 1.0, 1.0]
