"""The exact moving source: at rest, fast, and what the joint of the two leaves open between."""

from __future__ import annotations

from typing import Any

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


@pytest.mark.parametrize(("a", "b"), [(6e-3, 6e-3), (4e-3, 10e-3)])
def test_slower_and_slower_it_becomes_the_source_at_rest(a: float, b: float) -> None:
    """The rise parts from the one at rest in proportion to the Peclet number."""
    x = np.array([-0.8, 0.0, 0.6, 1.5]) * a
    rest = semi_elliptic_rise(STEEL, a, b, 0.0, FLUX, x)
    parting = [
        np.abs(semi_elliptic_rise(STEEL, a, b, speed_of(rate, a), FLUX, x) - rest).max()
        for rate in (1e-2, 1e-3)
    ]
    assert parting[0] < 0.02 * rest.max()
    assert parting[0] / parting[1] == pytest.approx(10.0, rel=0.05)


@pytest.mark.parametrize(
    ("ratio", "least", "most"),
    [(0.2, 0.0, 0.23), (0.5, 0.0, 0.075), (1.0, -0.012, 0.003), (2.0, -0.05, 0.0)],
)
def test_greenwoods_joint_misses_what_is_stated(ratio: float, least: float, most: float) -> None:
    """At every speed, of which these are nine; above Peclet 100 1 % for b ≥ a/2."""
    a, b = 6e-3, ratio * 6e-3
    x = np.linspace(-0.1, 1.0, 56) * a
    for rate in (0.1, 1.0, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0, 900.0):
        speed = speed_of(rate, a)
        greatest = semi_elliptic_rise(STEEL, a, b, speed, FLUX, x).max()
        joint = FLUX * 2.0 * np.pi * a * b / 3.0 / flash_conductance(STEEL, a, b, speed)
        error = joint / greatest - 1.0
        assert least - 2e-3 < error < most + 2e-3
        assert rate < 100.0 or ratio < 0.5 or abs(error) < 0.01


def test_too_fast_is_refused_with_what_to_take_instead() -> None:
    with pytest.raises(RailgripError, match=r"too fast for the exact solution.*contact_temp"):
        semi_elliptic_rise(STEEL, 6e-3, 6e-3, 30.0, FLUX, 0.0)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"a": 0.0}, "a: must be positive and finite; got 0 m"),
        ({"b": -5e-3}, "b: must be positive and finite; got -0.005 m"),
        ({"speed": -0.01}, "speed: must be zero or more, and finite"),
        ({"heat_flux": np.nan}, "heat_flux: must be a finite number"),
        ({"x": [0.0, 1.0], "y": [0.0, 1.0, 2.0]}, "the arrays do not fit together"),
        ({"x": [np.inf]}, "the places along must be finite; got inf m"),
        ({"material": STEEL._replace(density=0.0)}, "the density must be positive and finite"),
    ],
)
def test_what_cannot_be_gets_a_sentence(changes: dict[str, Any], says: str) -> None:
    given = {"material": STEEL, "a": 6e-3, "b": 6e-3, "speed": 0.01, "heat_flux": FLUX, "x": 0.0}
    with pytest.raises(RailgripError) as caught:
        semi_elliptic_rise(**(given | changes))
    assert says in str(caught.value)
