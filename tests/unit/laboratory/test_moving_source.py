"""The exact moving source: at rest, fast, and what the joint of the two leaves open between."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ellipk

from railgrip.core.errors import RailgripError
from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002, effusivity, flash_conductance
from railgrip.laboratory.heat_profiles import semi_elliptic_profile
from railgrip.laboratory.moving_source import peclet, semi_elliptic_rise

STEEL = STEEL_ERTZ_2002
FLUX = 1e7


def speed_of(rate: float, a: float) -> float:
    return rate / peclet(STEEL, a, 1.0)


@pytest.mark.parametrize(("a", "b"), [(6e-3, 6e-3), (4e-3, 10e-3), (10e-3, 4e-3)])
def test_at_rest_the_centre_rises_as_hertz_sinks(a: float, b: float) -> None:
    """ΔT = q0 · short · K(e)/(2λ): Johnson 1985, eq 4.26 with the heat in place of the pressure."""
    short, long = min(a, b), max(a, b)
    expected = FLUX * short * ellipk(1.0 - (short / long) ** 2) / (2.0 * STEEL.conductivity)
    assert float(semi_elliptic_rise(STEEL, a, b, 0.0, FLUX, 0.0)) == pytest.approx(
        expected, rel=1e-4
    )  # fmt: skip


def test_at_rest_it_is_the_same_before_and_behind() -> None:
    x = np.array([-2.0, -0.5, 0.5, 2.0]) * 6e-3
    rise = semi_elliptic_rise(STEEL, 6e-3, 6e-3, 0.0, FLUX, x)
    assert rise[::-1] == pytest.approx(rise, rel=1e-6)


def test_fast_it_is_the_strip() -> None:
    """At a Peclet number of 800 heat along the track changes the strip's profile by under 1 %."""
    a, b = 6e-3, 12e-3
    speed = speed_of(800.0, a)
    x = np.array([-0.5, 0.0, 0.65, 0.95]) * a
    strip = FLUX * np.sqrt(a / (np.pi * speed)) / effusivity(STEEL) * semi_elliptic_profile(x / a)
    assert semi_elliptic_rise(STEEL, a, b, speed, FLUX, x) == pytest.approx(strip, rel=0.01)


@pytest.mark.parametrize("rate", [0.1, 1.0, 3.0, 10.0, 100.0])
def test_greenwoods_joint_is_within_one_per_cent_for_a_circle(rate: float) -> None:
    a = 6e-3
    speed = speed_of(rate, a)
    x = np.linspace(-0.5, 1.0, 61) * a
    greatest = semi_elliptic_rise(STEEL, a, a, speed, FLUX, x).max()
    power = FLUX * 2.0 * np.pi * a * a / 3.0
    assert power / flash_conductance(STEEL, a, a, speed) == pytest.approx(greatest, rel=0.01)


def test_too_fast_is_refused_with_what_to_take_instead() -> None:
    with pytest.raises(RailgripError, match=r"too fast for the exact solution.*contact_temp"):
        semi_elliptic_rise(STEEL, 6e-3, 6e-3, 30.0, FLUX, 0.0)
