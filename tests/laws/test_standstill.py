"""Locked wheels, standing on a gradient, and release: no chatter, no creeping, no division by 0."""

from __future__ import annotations

import numpy as np
import pytest
from tests.conftest import Coach, Shipped

import railgrip as rg
from railgrip.core.constants import GRAVITY
from railgrip.core.status import RunStatus

SETTLED = 0.5
"""After so long the recoil of the stop has died away: the contacts are springs, s."""


def after(result: rg.Result, delay: float) -> np.ndarray:
    """Return which points of the traces lie more than a delay behind the stop."""
    stop = float(result["stopping_time"].values[0])
    return np.asarray(result.data["time"].values[:-1] > stop + delay)


def trace(result: rg.Result, name: str) -> np.ndarray:
    return np.asarray(result[name].values[0][..., :-1])


@pytest.mark.parametrize("controller", ["none", "conventional"])
@pytest.mark.parametrize("gradient", [0.03, -0.03, 0.0])
def test_a_held_train_does_not_creep(coach: Coach, gradient: float, controller: str) -> None:
    """Position constant to 1e-6 m over 29 s, wheels at exactly 0, the rail holds the weight."""
    result = rg.simulate(
        coach(0.3, gradient=gradient, controller=controller, speed=10.0, after_stop=30.0)
    )
    assert result.status == RunStatus.STOPPED
    standing = after(result, SETTLED)
    assert standing.sum() > 1400
    assert np.ptp(trace(result, "train_position")[standing]) < 1e-6
    assert np.abs(trace(result, "train_speed")[standing]).max() < 1e-9
    assert np.abs(trace(result, "wheel_speed")[:, standing]).max() == 0.0
    held = trace(result, "contact_force")[:, standing].sum(axis=0)
    weight = 44e3 * GRAVITY * gradient
    np.testing.assert_allclose(held, weight, rtol=1e-6, atol=1e-3)


@pytest.mark.parametrize("gradient", [0.03, -0.03])
def test_the_recoil_of_a_stop_is_small(coach: Coach, gradient: float) -> None:
    """Less than 1 mm back."""
    result = rg.simulate(coach(0.3, gradient=gradient, speed=10.0, after_stop=10.0))
    assert np.ptp(trace(result, "train_position")[after(result, 0.0)]) < 1e-3


def test_the_shipped_hold(shipped: Shipped) -> None:
    """gradient_hold: half a minute on 20 ‰, constant to 1e-6 m."""
    result = shipped("gradient_hold")
    position = trace(result, "train_position")[after(result, SETTLED)]
    assert len(position) > 1400
    assert np.ptp(position) < 1e-6


@pytest.mark.parametrize("gradient", [0.03, -0.03])
def test_a_released_train_rolls_downhill(coach: Coach, gradient: float) -> None:
    """With the slope's share of g over the mass with rotating parts, within 1e-3."""
    release = [{"at": 0.0, "level": "service"}, {"at": 15.0, "level": "none"}]
    result = rg.simulate(
        coach(
            0.3, gradient=gradient, speed=10.0, after_stop=15.0, demand=release,
            train={"dump_valve": None},
        )
    )  # fmt: skip
    time = result.data["time"].values[:-1]
    speed = trace(result, "train_speed")
    assert np.abs(speed[(time > 14.0) & (time < 15.0)]).max() < 1e-2
    rolling = time > 16.0
    expected = -GRAVITY * gradient * 44e3 / (44e3 + 4 * 800.0)
    found = np.diff(speed[rolling]) / np.diff(time[rolling])
    np.testing.assert_allclose(found, expected, rtol=1e-3)
    wheel = trace(result, "wheel_speed")[:, rolling]
    np.testing.assert_allclose(wheel, np.broadcast_to(speed[rolling], wheel.shape), atol=1e-3)


def test_a_train_that_rolls_out_of_the_line_ends(coach: Coach) -> None:
    """Back over where it came from, traced and untraced alike: never a traceback."""
    release = [{"at": 0.0, "level": "service"}, {"at": 15.0, "level": "none"}]
    scenario = coach(0.3, gradient=0.03, speed=10.0, after_stop=60.0, demand=release, start=100.0)
    traced, untraced = rg.simulate(scenario), rg.simulate(scenario, traces=False)
    assert traced.status in (RunStatus.END_OF_TRACK, RunStatus.STOPPED)
    assert traced.status == untraced.status
    for name in ("energy_contact", "energy_gradient", "energy_balance"):
        assert traced[name].values.tobytes() == untraced[name].values.tobytes()


@pytest.mark.parametrize("gradient", [0.03, -0.03])
def test_after_the_stop_traced_and_untraced_runs_are_the_same(
    coach: Coach, gradient: float
) -> None:
    release = [{"at": 0.0, "level": "service"}, {"at": 15.0, "level": "none"}]
    scenario = coach(0.3, gradient=gradient, speed=10.0, after_stop=20.0, demand=release)
    traced, untraced = rg.simulate(scenario), rg.simulate(scenario, traces=False)
    for name in untraced.data:
        assert traced[name].values.tobytes() == untraced[name].values.tobytes(), name


def test_locked_wheels_do_not_chatter(coach: Coach) -> None:
    """Once locked a wheel stands at exactly 0 to the end; its force is the friction of the rail."""
    result = rg.simulate(coach(0.05, speed=30.0))
    wheel, speed = trace(result, "wheel_speed"), trace(result, "train_speed")
    for axle in wheel:
        locked = int(np.argmax(axle == 0.0))
        assert 0 < locked < len(axle) // 2
        assert (axle[locked:] == 0.0).all()
    sliding = (wheel == 0.0).all(axis=0) & (speed > 0.5)
    used = trace(result, "adhesion_used")[:, sliding][:, 1:]
    np.testing.assert_allclose(used, 0.05, rtol=2e-3)
    locked_time = float(result["axle_locked_time"].values[0][0])
    assert locked_time == pytest.approx(float(result["axle_longest_lock"].values[0][0]))


def test_locked_wheels_turn_again_when_released(coach: Coach) -> None:
    """They roll to 1e-6 after 20 s and never faster than the train: spun up by the rail alone."""
    demand = [{"at": 0.0, "level": "service"}, {"at": 8.0, "level": "none"}]
    result = rg.simulate(coach(0.05, speed=30.0, demand=demand, time_limit=25.0))
    time = result.data["time"].values[:-1]
    wheel, speed = trace(result, "wheel_speed"), trace(result, "train_speed")
    assert (wheel[:, np.searchsorted(time, 7.9)] == 0.0).all()
    rolling = time > 20.0
    assert rolling.any()
    np.testing.assert_allclose(
        wheel[:, rolling], np.broadcast_to(speed[rolling], wheel[:, rolling].shape), rtol=1e-6
    )
    assert wheel.max() <= speed.max() * (1 + 1e-9)


@pytest.mark.parametrize("controller", ["none", "conventional"])
@pytest.mark.parametrize(
    ("length", "status"), [(100e3, RunStatus.TIME_LIMIT), (2500.0, RunStatus.END_OF_TRACK)]
)
def test_no_adhesion_at_all(
    coach: Coach, controller: str, length: float, status: RunStatus
) -> None:
    """Nothing slows the train, nothing divides by zero: it runs on to a limit at its speed."""
    result = rg.simulate(
        coach(0.0, controller=controller, speed=20.0, time_limit=60.0, length=length)
    )
    assert result.status == status
    for name in ("train_speed", "wheel_speed", "contact_force", "wheel_load", "train_position"):
        assert np.isfinite(trace(result, name)).all(), name
    np.testing.assert_allclose(trace(result, "train_speed"), 20.0, rtol=1e-12)
    assert np.abs(trace(result, "contact_force")).max() < 1e-3
    assert abs(float(result["energy_balance"].values[0])) < 1e-6


def test_a_slope_that_the_rail_cannot_hold(coach: Coach) -> None:
    """2 % adhesion on 30 ‰ down: the train gains speed by g (0.03 − 0.02), wheels locked."""
    result = rg.simulate(coach(0.02, gradient=-0.03, speed=5.0, time_limit=60.0))
    assert result.status == RunStatus.TIME_LIMIT
    gained = trace(result, "acceleration")[-500:]
    np.testing.assert_allclose(gained, GRAVITY * 0.01, rtol=5e-3)


@pytest.mark.parametrize("speed", [0.0, 1e-3])
def test_a_train_that_hardly_moves_stops(coach: Coach, speed: float) -> None:
    result = rg.simulate(coach(0.3, speed=speed, demand="emergency"))
    assert result.status == RunStatus.STOPPED
    assert float(result["stopping_distance"].values[0]) == pytest.approx(0.0, abs=0.02)


def test_resistance_alone_stops_and_holds(coach: Coach) -> None:
    """Dry friction of 6 kN: 24.5 m from 2.5 m/s with 47.2 t, then a stand, no rolling back."""
    train = {"resistance": {"constant": 6000.0}}
    result = rg.simulate(coach(0.3, train=train, speed=2.5, demand="none", after_stop=10.0))
    assert result.status == RunStatus.STOPPED
    way = np.ptp(trace(result, "train_position"))
    assert way == pytest.approx((44e3 + 3200.0) * 2.5**2 / (2 * 6000.0), rel=1e-4)
    assert trace(result, "train_speed").min() == 0.0
    assert np.isnan(result["stopping_distance"].values[0])
