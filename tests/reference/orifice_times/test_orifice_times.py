"""Filling and venting times by closed integrals, and by stepping the rate."""

from __future__ import annotations

import math

import pytest

from railgrip.brake.filling import distributor, distributor_rate
from railgrip.brake.orifice import orifice_flow, rate_constant_fill, rate_constant_vent

VENT = math.log(4.8 / 2.0) + 1.0 - math.sqrt(0.4)
FILL = (4.0 - 1.4) / 8.0 + 0.5 * math.asin((2.0 * 4.6 - 8.0) / 8.0)


def stepped(rate, start: float, time: float, steps: int = 4000) -> float:
    """Pressure after a time, by the classical Runge-Kutta method."""
    pressure, h = start, time / steps
    for _ in range(steps):
        k1 = rate(pressure)
        k2 = rate(pressure + 0.5 * h * k1)
        k3 = rate(pressure + 0.5 * h * k2)
        k4 = rate(pressure + h * k3)
        pressure += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
    return pressure


def test_venting_time() -> None:
    constant = rate_constant_vent(3.8e5, 0.4e5, 0.7)
    assert constant == pytest.approx(VENT / 0.7, rel=1e-8)
    end = stepped(lambda p: -constant * orifice_flow(p, 0.0), 3.8e5, 0.7)
    assert end == pytest.approx(0.4e5, rel=1e-6)


def test_filling_time() -> None:
    constant = rate_constant_fill(0.4e5, 3.6e5, 7.0e5, 1.0)
    assert constant == pytest.approx(FILL, rel=1e-8)
    end = stepped(lambda p: constant * orifice_flow(7.0e5, p), 0.4e5, 1.0)
    assert end == pytest.approx(3.6e5, rel=1e-6)


@pytest.mark.parametrize(
    ("fill_time", "release_time", "inshot"), [(4.0, 15.0, 0.0), (24.0, 45.0, 0.1), (2.0, 4.0, 0.3)]
)
def test_a_distributor_keeps_its_times(
    fill_time: float, release_time: float, inshot: float
) -> None:
    made = distributor(3.8e5, fill_time, release_time, inshot=inshot)
    filled = stepped(lambda p: distributor_rate(made, p, 3.8e5), 0.0, fill_time)
    assert filled == pytest.approx(0.95 * 3.8e5, rel=1e-4)
    released = stepped(lambda p: distributor_rate(made, p, 0.0), 3.8e5, release_time)
    assert released == pytest.approx(0.4e5, rel=1e-6)


def test_the_inshot_comes_first() -> None:
    made = distributor(3.8e5, 24.0, 45.0, inshot=0.1, inshot_time=0.5)
    first = stepped(lambda p: distributor_rate(made, p, 3.8e5), 0.0, 0.5)
    assert first == pytest.approx(0.1 * 3.8e5, rel=1e-3)
