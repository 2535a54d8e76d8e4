"""Brake control in plain Python: what its central and local units do with what they measure."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import railgrip as rg
from railgrip.control import brake_control_table as t
from railgrip.control.brake_control import BrakeControl
from railgrip.core.constants import GRAVITY
from railgrip.engine.brake_control_tick import _kernel
from railgrip.engine.lower_brake_control import lower_brake_control
from railgrip.engine.lower_train import lower_train

DT = 0.05


def control(**layer: Any) -> BrakeControl:
    scenario = rg.load("dry_emergency").with_({"brake_control": {"pressure_reserve": 1.3, **layer}})
    plan = lower_brake_control(scenario, lower_train(scenario)[0])
    parameters = t.BrakeControlParameters(*plan.parameters.tolist())
    return BrakeControl(parameters, plan.rules, plan.setup)


def signals(brake: BrakeControl, **train: float) -> np.ndarray:
    """Return what a train measures that brakes as it is asked to, all discs at 200 °C."""
    measured = np.zeros((len(brake.setup), t.N_MEASURED))
    measured[:, t.WHEEL_SPEED] = 30.0
    measured[:, t.DISC_TEMPERATURE] = 200.0
    measured[:, t.BELIEVED_TREAD] = brake.setup[:, t.NOMINAL_TREAD]
    measured[:, t.LEARNED_FRICTION] = 1.0
    measured[:, t.CYLINDER_PRESSURE] = brake.setup[:, t.FULL_PRESSURE]
    measured[0, t.TRAIN_SPEED] = 30.0
    measured[0, t.BRAKE_DEMAND] = 0.8
    resistance = brake.parameters.resistance_constant + 30.0 * (
        brake.parameters.resistance_linear + 30.0 * brake.parameters.resistance_quadratic
    )
    measured[0, t.DECELERATION] = 0.8 * brake.parameters.full_deceleration + resistance
    for name, value in train.items():
        measured[0, getattr(t, name)] = value
    return measured


def settle(brake: BrakeControl, measured: np.ndarray, seconds: float = 3.0) -> Any:
    """Return command and state after a while in which every cylinder has what it was told.

    Nothing brakes before the dead time of 0.3 s is over.
    """
    state = brake.reset()
    measured = measured.copy()
    braking = measured[0, t.DECELERATION]
    command = brake.step(state, measured, DT)
    for i in range(round(seconds / DT)):
        resisted = braking - 0.8 * brake.parameters.full_deceleration
        measured[0, t.DECELERATION] = braking if i > 5 else resisted
        demand = measured[0, t.BRAKE_DEMAND] * command[:, t.FORCE_FACTOR]
        share = demand * command[:, t.PRESSURE_FACTOR]
        measured[:, t.CYLINDER_PRESSURE] = share * brake.setup[:, t.FULL_PRESSURE]
        command = brake.step(state, measured, DT)
    return command, state


def force(brake: BrakeControl, command: np.ndarray, friction: np.ndarray) -> np.ndarray:
    """Return the brake force of each axle over its full one, by the pads' law."""
    setup = brake.setup
    share = 0.8 * command[:, t.FORCE_FACTOR] * command[:, t.PRESSURE_FACTOR]
    clamp = setup[:, t.CLAMP_PER_PRESSURE] * share * setup[:, t.FULL_PRESSURE]
    clamp = clamp + setup[:, t.CLAMP_OFFSET]
    return clamp * friction * setup[:, t.NOMINAL_TREAD] / setup[:, t.FULL_FORCE]


def test_the_clamp_force_gives_the_force_that_was_asked_for() -> None:
    brake = control(estimator={})
    command, _ = settle(brake, signals(brake))
    assert force(brake, command, command[:, t.ESTIMATED_FRICTION]) == pytest.approx(0.8, rel=1e-9)
    assert (command[:, t.ESTIMATED_FRICTION] < 0.37).all()


def test_weight_nothing_commands_what_no_estimator_does() -> None:
    brake = control(estimator={"rule": [{"control": {"weight": 0}}]})
    without = control()
    one, _ = settle(brake, signals(brake))
    other, _ = settle(without, signals(without))
    assert np.array_equal(one, other)


def test_a_rule_for_emergencies_leaves_service_alone() -> None:
    brake = control(estimator={"rule": [{"brake": "emergency"}]})
    service, _ = settle(brake, signals(brake))
    emergency, _ = settle(brake, signals(brake, EMERGENCY=1.0))
    assert (service[:, t.ESTIMATED_FRICTION] == 0.37).all()
    assert (emergency[:, t.ESTIMATED_FRICTION] < 0.37).all()


def test_characteristic_bends_the_pressure_by_the_friction() -> None:
    brake = control(estimator={}, adapts="characteristic")
    command, _ = settle(brake, signals(brake))
    expected = 0.37 / command[:, t.ESTIMATED_FRICTION]
    assert command[:, t.PRESSURE_FACTOR] == pytest.approx(expected)


def test_one_estimate_for_the_train_is_that_of_its_first_unit() -> None:
    brake = control(estimator={"per": "train"})
    measured = signals(brake)
    measured[:, t.DISC_TEMPERATURE] = 100.0 + 15.0 * np.arange(16)
    whole, _ = settle(brake, measured)
    of_units, _ = settle(control(estimator={}), measured)
    assert len(set(whole[:, t.ESTIMATED_FRICTION])) == 1
    assert len(set(of_units[:, t.ESTIMATED_FRICTION])) > 4
    assert whole[0, t.ESTIMATED_FRICTION] == of_units[0, t.ESTIMATED_FRICTION]


@pytest.mark.parametrize(("emergency", "deviation", "acts"), [
    (0.0, 0.08, False), (0.0, 0.12, True), (1.0, 0.04, False), (1.0, 0.08, True),
])  # fmt: skip
def test_thresholds_of_service_and_emergency(
    emergency: float, deviation: float, acts: bool
) -> None:
    brake = control(deceleration={"acts": "past_threshold"})
    measured = signals(brake, EMERGENCY=emergency)
    measured[0, t.DECELERATION] -= deviation
    command, _ = settle(brake, measured)
    assert (command[0, t.CORRECTION_OUT] > 0.0) == acts


def test_figure_5_passes_the_estimate_on_past_the_threshold_only() -> None:
    brake = control(estimator={"passed_on": "past_threshold"})
    good = signals(brake)
    bad = signals(brake)
    bad[0, t.DECELERATION] -= 0.15
    assert (settle(brake, good)[0][:, t.ESTIMATED_FRICTION] == 0.37).all()
    assert (settle(brake, bad)[0][:, t.ESTIMATED_FRICTION] < 0.37).all()


def test_nothing_to_correct_where_the_train_does_as_asked() -> None:
    """But for what the sensor's filter leaves of the step in which these signals begin."""
    brake = control(deceleration={})
    command, _ = settle(brake, signals(brake))
    assert command[0, t.CORRECTION_OUT] == pytest.approx(0.0, abs=0.01)


def test_pressure_keeps_its_reserve_and_the_controller_does_not_wind_up() -> None:
    brake = control(deceleration={}, pressure_reserve=1.0)
    measured = signals(brake, BRAKE_DEMAND=1.0)
    measured[0, t.DECELERATION] = 0.8
    command, state = settle(brake, measured, 20.0)
    asked = command[:, t.FORCE_FACTOR] * command[:, t.PRESSURE_FACTOR]
    assert asked[command[:, t.PRESSURE_FACTOR] < 1.0] == pytest.approx(1.0)
    assert state.values[t.INTEGRAL] < 0.05


def test_a_slide_takes_the_correction_back() -> None:
    brake = control(deceleration={})
    measured = signals(brake)
    measured[0, t.DECELERATION] -= 0.2
    assert settle(brake, measured, 5.0)[1].values[t.INTEGRAL] > 0.1
    state = settle(brake, measured, 5.0)[1]
    measured[:6, t.IS_HELD] = 1.0
    for _ in range(round(4.0 / DT)):
        command = brake.step(state, measured, DT)
    assert abs(command[0, t.CORRECTION_OUT]) < 0.001


def test_the_jerk_of_service_is_limited_and_that_of_emergency_free() -> None:
    brake = control(jerk_service=0.5)
    state = brake.reset()
    measured = signals(brake)
    factors = [brake.step(state, measured, DT)[0, t.FORCE_FACTOR] for _ in range(60)]
    per_period = 0.5 * DT / (0.8 * brake.parameters.full_deceleration)
    assert np.diff(factors).max() <= per_period * (1 + 1e-9)
    assert factors[-1] == pytest.approx(1.0)
    command, _ = settle(brake, signals(brake, EMERGENCY=1.0), 0.5)
    assert command[0, t.FORCE_FACTOR] == pytest.approx(1.0)


@pytest.mark.parametrize(("gradient", "emergency", "more"), [
    (-0.02, 0.0, 0.02), (0.02, 0.0, -0.02), (-0.02, 1.0, 0.02), (0.02, 1.0, 0.0),
])  # fmt: skip
def test_gradient_compensation_is_the_weight_down_the_slope(
    gradient: float, emergency: float, more: float
) -> None:
    brake = control(gradient_compensation=1.0)
    command, _ = settle(brake, signals(brake, GRADIENT=gradient, EMERGENCY=emergency))
    asked = 0.8 * brake.parameters.full_deceleration
    assert (command[0, t.FORCE_FACTOR] - 1.0) * asked == pytest.approx(GRAVITY * more, abs=1e-9)


def test_friction_gives_what_the_dynamic_brake_leaves() -> None:
    brake = control(estimator={})
    measured = signals(brake)
    measured[0, t.DYNAMIC_FORCE] = 0.3 * brake.setup[0, t.FULL_FORCE]
    command, _ = settle(brake, measured)
    setup = brake.setup[0]
    pressure = 0.5 * command[0, t.PRESSURE_FACTOR] * setup[t.FULL_PRESSURE]
    clamp = setup[t.CLAMP_PER_PRESSURE] * pressure + setup[t.CLAMP_OFFSET]
    given = clamp * command[0, t.ESTIMATED_FRICTION] * setup[t.NOMINAL_TREAD]
    assert given == pytest.approx(0.5 * setup[t.FULL_FORCE], rel=1e-9)


def test_sound_brakes_take_over_from_a_failed_one() -> None:
    brake = control(redistributes=True, estimator={})
    state = brake.reset()
    measured = signals(brake)
    command = brake.step(state, measured, DT)
    for _ in range(160):
        share = 0.8 * command[:, t.FORCE_FACTOR] * command[:, t.PRESSURE_FACTOR]
        measured[:, t.CYLINDER_PRESSURE] = share * brake.setup[:, t.FULL_PRESSURE]
        measured[4, t.CYLINDER_PRESSURE] = 0.0
        command = brake.step(state, measured, DT)
    assert state.values[t.N_FAILED] == 1.0
    full = brake.setup[:, t.FULL_FORCE]
    sound = np.delete(force(brake, command, command[:, t.ESTIMATED_FRICTION]) * full, 4)
    assert sound.sum() == pytest.approx(0.8 * full.sum(), rel=1e-3)


def test_plain_and_compiled_give_the_same_bits() -> None:
    """Two hundred periods of random signals, all parts at work."""
    brake = control(
        estimator={"temperature": "model", "rule": [{"control": {"form": "deviation"}}]},
        deceleration={"acts": "past_threshold"},
        jerk_service=0.8, redistributes=True, gradient_compensation=0.7,
    )  # fmt: skip
    generator = np.random.default_rng(5)
    plain, fast = brake.reset(), brake.reset()
    parameters = np.array(brake.parameters, dtype=float)
    for i in range(200):
        measured = signals(brake, EMERGENCY=float(i > 120), BRAKE_DEMAND=0.0 if i < 5 else 0.8)
        measured[:, : t.BELIEVED_TREAD] *= generator.uniform(0.5, 1.2, (16, t.BELIEVED_TREAD))
        measured[0, t.DECELERATION] *= generator.uniform(0.7, 1.1)
        measured[0, t.GRADIENT] = generator.uniform(-0.02, 0.02)
        command = brake.step(plain, measured, DT)
        _kernel(parameters, brake.rules, brake.setup, fast.values, measured, fast.command, DT)
        assert np.array_equal(command, fast.command)
        assert np.array_equal(plain.values, fast.values)
