"""Properties of the deceleration controller, jerk limit, stopping at a place, disc temperature."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.control.deceleration_controller import (
    DecelerationGains,
    correct_deceleration,
    limit_jerk,
    stopping_deceleration,
)
from railgrip.control.disc_temperature import advance_disc, lagging_sensor
from railgrip.core.formulas.two_node_heat import DiscHeat

GAINS = DecelerationGains(0.3, 0.8, 0.3, 0.5)


def closed_loop(gain: float, seconds: float = 20.0, lag: float = 0.5) -> float:
    """Return the correction after a while with brakes of a wrong gain that follow with a lag."""
    integral = correction = followed = 0.0
    dt = 0.05
    for _ in range(round(seconds / dt)):
        followed += (correction - followed) * dt / lag
        error = 1.0 - gain * (1.0 + followed)
        integral, correction = correct_deceleration(
            GAINS, integral, correction, error, 1.0, 1.0, dt
        )
    return correction


@given(st.floats(0.8, 1.25))
def test_it_finds_the_exact_correction(gain: float) -> None:
    """Integral action: no error remains, so the correction is 1/gain − 1."""
    assert closed_loop(gain) == pytest.approx(1.0 / gain - 1.0, abs=1e-4)


def test_it_never_leaves_its_bounds_and_comes_back_at_once() -> None:
    integral = correction = 0.0
    for _ in range(400):
        integral, correction = correct_deceleration(
            GAINS, integral, correction, 1.0, 1.0, 1.0, 0.05
        )
    assert correction == GAINS.greatest
    assert integral <= GAINS.greatest
    for _ in range(20):
        integral, correction = correct_deceleration(
            GAINS, integral, correction, -0.2, 1.0, 1.0, 0.05
        )
    assert correction < 0.16


@given(st.lists(st.floats(-1, 1), min_size=1, max_size=40))
def test_its_rate_is_limited(errors: list[float]) -> None:
    integral = correction = 0.0
    for error in errors:
        before = correction
        integral, correction = correct_deceleration(
            GAINS, integral, correction, error, 1.0, 1.0, 0.05
        )
        assert abs(correction - before) <= GAINS.rate * 0.05 + 1e-15


@given(st.floats(0.0, 1.0), st.integers(1, 200))
def test_no_windup_where_brakes_cannot_follow(error: float, periods: int) -> None:
    integral, correction = 0.1, 0.1
    for _ in range(periods):
        integral, correction = correct_deceleration(
            GAINS, integral, correction, error, 0.0, 1.0, 0.05
        )
    assert integral == pytest.approx(0.1)


@given(st.floats(0, 2), st.floats(0, 2))
def test_jerk_is_limited_and_the_wanted_is_reached(start: float, wanted: float) -> None:
    asked = start
    for _ in range(100):
        before = asked
        asked = limit_jerk(asked, wanted, 1.0, 0.05)
        assert abs(asked - before) <= 0.05 + 1e-12
    assert asked == pytest.approx(wanted)


@given(st.floats(5, 60), st.floats(0.3, 1.5), st.floats(0.0, 0.8))
def test_stopping_is_exact_for_brakes_that_follow_late(
    speed: float, deceleration: float, response: float
) -> None:
    """With a dead time that is known, the deceleration asked for at first need never change."""
    place = speed * speed / (2 * deceleration)
    asked = stopping_deceleration(speed, place, response, deceleration, 0.5)
    assert asked == pytest.approx(deceleration, rel=1e-6)


def test_a_sensor_follows_a_ramp_by_its_lag() -> None:
    reading, dt, lag = 20.0, 0.05, 4.0
    for i in range(2000):
        reading = lagging_sensor(reading, 20.0 + 0.5 * (i + 1) * dt, lag, dt)
    assert 20.0 + 0.5 * 100.0 - reading == pytest.approx(0.5 * lag, rel=0.01)


def _heat(temperature: float) -> float:
    """Heat of 1 kg above 20 °C: the integral of 460 + 0.35 (T − 20)."""
    rise = temperature - 20.0
    return 460.0 * rise + 0.175 * rise * rise


def test_the_model_of_a_disc_keeps_all_heat() -> None:
    """Without cooling, the heat of ring and hub is the friction power's share, to 1e-5."""
    disc = DiscHeat(65.0, 55.0, 450.0, 2.0, 0.9, 0.0, 0.0, 0.0, 20.0)
    ring = hub = 20.0
    put_in, dt = 0.0, 0.05
    for i in range(800):
        power = 300e3 * (1.0 - i / 800.0)
        put_in += 0.9 * power * dt
        ring, hub = advance_disc(disc, ring, hub, power, 40.0, dt)
    stored = 65.0 * _heat(ring) + 55.0 * _heat(hub)
    assert stored == pytest.approx(put_in, rel=1e-5)


def test_the_model_of_a_disc_is_of_second_order() -> None:
    disc = DiscHeat(65.0, 55.0, 450.0, 2.0, 0.9, 9.0, 3.0, 0.7, 20.0)

    def after(steps: int) -> float:
        ring = hub = 20.0
        for _ in range(steps):
            ring, hub = advance_disc(disc, ring, hub, 250e3, 40.0, 20.0 / steps)
        return ring

    exact = after(4096)
    assert (after(32) - exact) / (after(64) - exact) == pytest.approx(4.0, rel=0.15)
