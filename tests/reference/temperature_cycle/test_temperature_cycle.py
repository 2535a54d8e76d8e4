"""Saw-tooth of the tread and pulses of the rail, against the plain sum over all pulses."""

from __future__ import annotations

import math

import numpy as np
import pytest

from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002, effusivity
from railgrip.laboratory.heat_pulses import HeatPulses, rail_pulses, wheel_pulses
from railgrip.laboratory.temperature_cycle import pulse_rises

BETA = effusivity(STEEL_ERTZ_2002)


def plain_sum(pulses: HeatPulses, times: np.ndarray) -> np.ndarray:
    rise = np.zeros(times.shape)
    for start, end, flux in zip(pulses.start, pulses.end, pulses.flux, strict=True):
        roots = np.sqrt(np.maximum(times - start, 0.0)) - np.sqrt(np.maximum(times - end, 0.0))
        rise += 2.0 * flux * roots / (BETA * math.sqrt(math.pi))
    return rise


def braked_wheel() -> HeatPulses:
    time = np.linspace(0.0, 20.0, 41)
    speed = 40.0 - 1.5 * time
    return wheel_pulses(time, speed, 20e3 * speed / 40.0, 2.9, 12e-3, 21e-3)


def test_the_saw_tooth_is_the_plain_sum() -> None:
    pulses = braked_wheel()
    times = np.concatenate([pulses.start[1:], pulses.end[:-1], np.linspace(0.0, 21.0, 997)])
    expected = plain_sum(pulses, times)
    assert pulse_rises(pulses, BETA, times) == pytest.approx(
        expected, abs=1e-6 * expected.max()
    )  # fmt: skip


def test_a_tread_is_heated_once_a_revolution_and_its_mean_grows() -> None:
    pulses = wheel_pulses([0.0, 10.0], [30.0, 30.0], [15e3, 15e3], 3.0, 12e-3, 20e-3)
    assert np.diff(pulses.start) == pytest.approx(0.1)
    assert pulses.duration == pytest.approx(12e-3 / 30.0)
    peaks = pulse_rises(pulses, BETA, pulses.end[:-1])
    valleys = pulse_rises(pulses, BETA, pulses.start[1:])
    assert (np.diff(valleys) > 0.0).all()
    assert (np.diff(peaks) > 0.0).all()
    # each tooth is the rise of one contact; what was left of the earlier ones falls meanwhile
    tooth = 2.0 * pulses.flux[0] * math.sqrt(pulses.duration[0] / math.pi) / BETA
    assert peaks[0] == pytest.approx(tooth, rel=1e-12)
    assert peaks[1:] - valleys[: peaks.size - 1] == pytest.approx(tooth, rel=0.02)
    # the growing mean is that of the mean flux, up to the first revolutions
    mean = 2.0 * pulses.flux[0] * (12e-3 / 3.0) * math.sqrt(10.0 / math.pi) / BETA
    assert valleys[-1] == pytest.approx(mean, rel=0.1)


def test_a_rail_is_heated_once_per_wheel_and_cools_between() -> None:
    places = np.array([0.0, 2.5, 19.0, 21.5])
    pulses = rail_pulses(places, 25.0, 10e3, 12e-3, 20e-3)
    assert pulses.start == pytest.approx(places / 25.0)
    before = pulse_rises(pulses, BETA, pulses.start)
    after = pulse_rises(pulses, BETA, pulses.end)
    assert before[0] == 0.0
    assert (after > before + 50.0).all()
    late = pulse_rises(pulses, BETA, [100.0])
    heat = float((pulses.flux * pulses.duration).sum())
    assert late[0] == pytest.approx(heat / (BETA * math.sqrt(math.pi * 99.5)), rel=1e-3)
