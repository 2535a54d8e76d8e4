"""Wheel rotation monitoring: in time, and no false alarm."""

import numpy as np
import pytest

from railgrip.control.contract import N_MEASURED, WHEEL_SPEED
from railgrip.control.rotation_monitoring import (
    RotationMonitoring,
    rotation_monitoring,
    rotation_state_size,
)

DT = 0.01


def watch(speeds):
    """Return the alarms [tick, axle] for wheel speeds [tick, axle]."""
    n_axles = speeds.shape[1]
    state = np.zeros(rotation_state_size(n_axles))
    measured = np.zeros((n_axles, N_MEASURED))
    alarm = np.zeros(n_axles)
    alarms = np.zeros(speeds.shape)
    for tick, row in enumerate(speeds):
        measured[:, WHEEL_SPEED] = row
        rotation_monitoring(np.array(RotationMonitoring()), state, measured, alarm, DT)
        alarms[tick] = alarm
    return alarms


def start(duration=60.0, n_axles=4):
    """Return wheel speeds of a train that sets off with 0.5 m/s²."""
    time = np.arange(0.0, duration, DT)
    return np.repeat(0.5 * time[:, None], n_axles, axis=1)


@pytest.mark.parametrize("reading", [0.0, np.nan])
def test_an_axle_locked_from_the_start_is_told_within_ten_seconds_after_50_kmh(reading):
    speeds = start()
    at_50 = np.argmax(speeds[:, 0] > 50 / 3.6)
    speeds[:, 2] = reading
    alarms = watch(speeds)
    told = np.argmax(alarms[:, 2] > 0)
    assert at_50 < told < at_50 + 10.0 / DT
    assert not alarms[:, [0, 1, 3]].any()


def test_a_slow_drift_is_told():
    speeds = np.full((6000, 4), 40.0)
    speeds[:, 1] = np.linspace(40.0, 0.0, 6000)
    limit = RotationMonitoring().deviation_constant + RotationMonitoring().deviation_share * 40.0
    beyond = np.argmax(speeds[:, 1] < 40.0 - limit)
    told = np.argmax(watch(speeds)[:, 1] > 0)
    assert beyond < told < beyond + 10.0 / DT


def test_a_slide_under_protection_is_no_alarm(plant):
    from railgrip.control.conventional_wsp import ConventionalWSP

    run = plant.stop(ConventionalWSP(), plant.LEAVES)
    assert not watch(run.wheel_speed).any()


def test_slow_trains_are_not_monitored():
    speeds = np.full((3000, 4), 45 / 3.6)
    speeds[:, 0] = 0.0
    assert not watch(speeds).any()


def test_the_alarm_ends_when_the_axle_turns_again():
    speeds = np.full((4000, 4), 30.0)
    speeds[:2000, 0] = 0.0
    alarms = watch(speeds)
    assert alarms[1999, 0] == 1.0
    assert alarms[-1, 0] == 0.0
