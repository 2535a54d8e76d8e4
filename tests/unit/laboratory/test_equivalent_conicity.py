"""Equivalent conicity against what can be derived by hand: cones and arcs on round rails."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from railgrip.core.errors import RailgripError
from railgrip.laboratory.equivalent_conicity import (
    equivalent_conicity,
    rolling_radius_difference,
    s1002_heights,
)
from railgrip.laboratory.rail_head import head_60e1

Array = NDArray[np.float64]
SLOPE, HALF, RAIL = 0.025, 0.75, 0.3


def round_rail(position: Array) -> Array:
    """A rail of one radius whose surface has the slope of the wheels at their running circles."""
    centre = HALF + RAIL * np.sin(np.arctan(SLOPE))
    depth: Array = -np.sqrt(RAIL**2 - (position - centre) ** 2)
    return depth


def test_a_cone_has_its_slope_and_what_the_roll_adds() -> None:
    """The wheelset rolls by −λu/b, so the contact runs ahead on the rail by its radius times it."""
    found = equivalent_conicity(0.003, lambda y: -SLOPE * y, round_rail)
    assert found == pytest.approx(SLOPE * (1.0 + SLOPE * RAIL / HALF), rel=1e-3)


@pytest.mark.parametrize("radius", [0.4, 0.6, 2.0])
def test_a_hollow_tread_on_a_round_rail(radius: float) -> None:
    """y/R_w + roll = (y + u)/R_r at the contact, and roll = −γu/b; Δr = −2γy."""
    found = equivalent_conicity(1e-3, lambda y: -SLOPE * y + 0.5 * y * y / radius, round_rail)
    expected = SLOPE * (1.0 + SLOPE * RAIL / HALF) * radius / (radius - RAIL)
    assert found == pytest.approx(expected, rel=0.01)


def test_the_difference_is_odd() -> None:
    shifts = np.array([-0.006, -0.003, -0.001, 0.0, 0.001, 0.003, 0.006])
    found = rolling_radius_difference(shifts)
    assert found == pytest.approx(-found[::-1], abs=1e-6)
    assert (np.diff(found) > 0.0).all()


def test_s1002_on_60e1_falls_with_the_amplitude_until_the_shoulder() -> None:
    found = [equivalent_conicity(amplitude) for amplitude in (0.001, 0.002, 0.003, 0.004)]
    assert found == sorted(found, reverse=True)
    assert found[2] == pytest.approx(0.175, abs=0.005)


def test_a_steeper_rail_and_a_wider_gauge_lower_it() -> None:
    usual = equivalent_conicity(0.003)
    steep = equivalent_conicity(0.003, rail=lambda y: head_60e1(y, inclination=1.0 / 20.0))
    wide = equivalent_conicity(0.003, rail=lambda y: head_60e1(y, gauge=1.440))
    assert steep < wide < usual


def test_the_profile_as_an_array() -> None:
    assert s1002_heights(np.array([0.0, 0.008])) == pytest.approx([0.0, -0.183149e-3], abs=1e-9)


@pytest.mark.parametrize(
    ("amplitude", "sentence"),
    [
        (0.0, "the amplitude must be positive; got 0 mm"),
        (float("nan"), "the amplitude must be positive"),
        (0.02, "the shift of the wheelset is out of range; got 20 mm|got 19"),
    ],
)
def test_an_impossible_swing_gets_a_sentence(amplitude: float, sentence: str) -> None:
    with pytest.raises(RailgripError, match=sentence):
        equivalent_conicity(amplitude)
