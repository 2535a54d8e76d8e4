"""The conventional WSP in the loop with the small test train.

Bounds come from the work it has to do (no lock above 30 km/h for more than 0.4 s), not from runs.
"""

import numba
import numpy as np
import pytest

from railgrip.control import contract as ctl
from railgrip.control.contract_signals import bench_setup, faults, locking
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_wsp import ConventionalWSP
from railgrip.control.no_protection import NoProtection
from railgrip.core.errors import RailgripError

LOCK_LIMIT = 0.4  # s above 30 km/h, usual and unverified


class Unprotected(NoProtection):
    @staticmethod
    def initial(parameters, axle_setup, state, measured):
        pass


def test_a_wrong_band_gets_a_kind_reply():
    with pytest.raises(RailgripError, match="did you mean 'micro'"):
        ConventionalWSP(band="mirco")


@pytest.mark.parametrize(("lower", "upper"), [(0.2, 0.1), (-0.1, 0.1), (0.1, 1.5), (0.1, np.nan)])
def test_contradictory_thresholds_are_refused(lower, upper):
    parameters = ConventionalParameters()._replace(slip_lower=lower, slip_upper=upper)
    with pytest.raises(RailgripError, match="slip_lower"):
        ConventionalWSP(parameters)


def test_plain_and_compiled_form_give_the_same_bits(plant):
    """On a slide, on a locking axle and on failing sensors, command by command."""
    run = plant.stop(ConventionalWSP(), plant.LEAVES, plant.Train(n_axles=4))
    for speeds in (run.wheel_speed[:2000], locking(4, 0.01, 6.0), faults(4, 0.01)):
        controller = ConventionalWSP()
        setup = bench_setup(4, controller.period)
        state = controller.reset(setup)
        values = np.zeros(controller.state_size(4))
        command = ctl.command_array(4)
        parameters = np.array(controller.parameters)
        kernel, initial = plant.compiled(controller.kernel), plant.compiled(controller.initial)
        for tick, row in enumerate(speeds):
            pressure = np.full(4, 1e5 + 1e3 * (tick % 100))
            measured = ctl.Measured(row, pressure, np.where(setup.motored, 8e3, 0.0), 1.0, 1.0)
            columns = ctl.measured_array(measured)
            if tick == 0:
                initial(parameters, ctl.setup_array(setup), values, columns)
            kernel(parameters, ctl.setup_array(setup), values, columns, command, 0.01)
            plain = controller.step(state, measured, 0.01)
            assert np.array_equal(state.command, command, equal_nan=True), tick
            assert plain.reference_speed == command[0, ctl.REFERENCE_SPEED]
    assert isinstance(kernel, numba.core.registry.CPUDispatcher)


@pytest.mark.parametrize("band", ["macro", "micro"])
def test_nothing_happens_on_dry_rail(plant, band):
    with_it = plant.stop(ConventionalWSP(band=band), plant.DRY)
    without = plant.stop(Unprotected(), plant.DRY)
    assert with_it.distance == pytest.approx(without.distance, rel=1e-9)
    assert (with_it.valve == ctl.FILL).all()


@pytest.mark.parametrize("band", ["macro", "micro"])
@pytest.mark.parametrize("n_axles", [4, 16])
@pytest.mark.parametrize("friction", [0.03, 0.05, 0.10])
def test_no_wheel_locks_where_all_lock_without(plant, band, n_axles, friction):
    rail = plant.LEAVES._replace(friction=friction)
    train = plant.Train(n_axles=n_axles)
    run = plant.stop(ConventionalWSP(band=band), rail, train, time_limit=300.0)
    assert run.longest_lock <= LOCK_LIMIT
    assert run.deep_slide < 0.5  # nor turns it slower than half for long: s per axle
    assert run.speed[-1] < 0.1
    if friction == 0.05:
        without = plant.stop(Unprotected(), rail, train, time_limit=300.0)
        assert without.longest_lock > 60.0
        assert run.distance < 0.8 * without.distance


def test_micro_wins_on_leaves_and_macro_on_detergent(plant):
    macro, micro = ConventionalWSP(band="macro"), ConventionalWSP(band="micro")
    leaves = [plant.stop(one, plant.LEAVES).distance for one in (macro, micro)]
    detergent = [plant.stop(one, plant.DETERGENT).distance for one in (macro, micro)]
    assert leaves[1] < 0.9 * leaves[0]
    assert detergent[0] < 0.9 * detergent[1]


@pytest.mark.parametrize("band", ["macro", "micro"])
def test_adhesion_in_jumps(plant, band):
    rail = plant.LEAVES._replace(friction=0.03, patch_length=75.0, patch_friction=0.2)
    run = plant.stop(ConventionalWSP(band=band), rail, speed=120 / 3.6)
    without = plant.stop(Unprotected(), rail, speed=120 / 3.6)
    assert run.longest_lock <= LOCK_LIMIT
    assert run.distance < without.distance


@pytest.mark.parametrize("reading", [np.nan, 0.0, 1e6])
def test_a_lost_sensor_keeps_its_brake_and_harms_no_other(plant, reading):
    train = plant.Train(n_axles=8)
    lost = train._replace(lost_axle=3.0, lost_reading=reading)
    whole = plant.stop(ConventionalWSP(), plant.DRY, train)
    run = plant.stop(ConventionalWSP(), plant.DRY, lost)
    assert run.distance == pytest.approx(whole.distance, rel=0.07)
    others = [axle for axle in range(8) if axle != 3]
    assert (run.valve[:, others] == ctl.FILL).all()
    late = slice(round(20.0 / 0.01), None)
    assert (run.valve[late, 3] == ctl.FILL).mean() > 0.9
    assert run.alarm[round(18.0 / 0.01), 3] > 0.0


@pytest.mark.parametrize("reading", [np.nan, 0.0])
def test_a_lost_sensor_on_bad_rail_leaves_the_others_protected(plant, reading):
    train = plant.Train(n_axles=8, lost_axle=3.0, lost_reading=reading)
    run = plant.stop(ConventionalWSP(), plant.LEAVES, train)
    others = np.delete(run.wheel_speed, 3, axis=1)
    fast = run.speed > 30 / 3.6
    assert not (others[fast] < 0.05 * run.speed[fast, None]).any()


def test_dynamic_brake_is_reduced_before_the_valve_vents(plant):
    run = plant.stop(ConventionalWSP(), plant.LEAVES, plant.Train(dynamic_force=12e3))
    for axle in (0, 1, 4):
        first_vent = np.argmax(run.valve[:, axle] == ctl.VENT)
        assert run.dynamic[first_vent, axle] < 0.2
        assert run.dynamic[: first_vent + 1, axle].max() == 1.0
    assert (run.dynamic[:, 2] == 1.0).all()
    assert run.longest_lock <= LOCK_LIMIT


def test_the_brake_fills_at_the_end_of_the_stop(plant):
    run = plant.stop(ConventionalWSP(), plant.LEAVES)
    slow = run.reference < 0.9 * ConventionalParameters().inhibit_speed
    assert slow.any()
    assert not (run.valve[slow] == ctl.VENT).any()


def test_drag_braking_on_very_low_adhesion_does_not_drift(plant):
    """A minute at 60 km/h on a gradient: no lock, and the reference speed stays the train's."""
    rail = plant.LEAVES._replace(friction=0.03)
    run = plant.stop(
        ConventionalWSP(), rail, speed=60 / 3.6, demand=0.4, time_limit=60.0, hold_speed=True
    )
    assert run.time == pytest.approx(60.0)
    assert run.longest_lock <= LOCK_LIMIT
    error = run.reference[1000:] / run.speed[1000:] - 1.0
    assert abs(error).max() < 0.12


def test_sand_is_asked_for_on_leaves_and_not_on_dry_rail(plant):
    assert plant.stop(ConventionalWSP(), plant.LEAVES).sanding.any()
    assert not plant.stop(ConventionalWSP(), plant.DRY).sanding.any()


def test_a_worn_wheel_does_not_pass_for_the_train(plant):
    """Without coasting nothing can be learned: two per cent may cost little, and no lock."""
    run = plant.stop(ConventionalWSP(), plant.LEAVES, plant.Train(wheel_error=0.02))
    whole = plant.stop(ConventionalWSP(), plant.LEAVES)
    assert run.longest_lock <= LOCK_LIMIT
    assert run.distance == pytest.approx(whole.distance, rel=0.08)
