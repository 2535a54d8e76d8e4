"""The band of figure 2.2: proportional to K at first, crossing over later."""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.laboratory.slope_band import slope_band


def test_at_the_origin_the_slope_goes_with_the_stiffness() -> None:
    band = slope_band([0.0], 100e3, 7.2e-3, 5.4e-3, 0.3)
    assert band.stiffness == pytest.approx([15e12, 20e12, 25e12])
    assert band.slope[:, 0] * 100e3 == pytest.approx(8 / 3 * 7.2e-3**2 * 5.4e-3 * band.stiffness)
    assert (band.adhesion == 0.0).all()


def test_further_on_the_stiff_surface_is_the_flatter() -> None:
    band = slope_band(np.linspace(0.0, 0.01, 200), 100e3, 7.2e-3, 5.4e-3, 0.3)
    order = np.argsort(band.slope, axis=0)
    assert (order[:, 0] == [0, 1, 2]).all()
    assert (order[:, -1] == [2, 1, 0]).all()
    assert (np.diff(band.adhesion, axis=0)[:, 1:] > 0.0).all()
    assert (band.adhesion < 0.3).all()


def test_the_adhesion_is_the_integral_of_the_slope() -> None:
    creepage = np.linspace(0.0, 0.01, 2001)
    band = slope_band(creepage, 100e3, 7.2e-3, 5.4e-3, 0.3)
    steps = 0.5 * (band.slope[:, 1:] + band.slope[:, :-1]) * np.diff(creepage)
    assert steps.sum(axis=1) == pytest.approx(band.adhesion[:, -1], rel=1e-5)


@pytest.mark.parametrize(
    ("creepage", "load", "friction", "sentence"),
    [
        ([np.nan], 1e5, 0.3, "creepage must be finite"),
        ([0.0], 0.0, 0.3, "load must be positive"),
        ([0.0], 1e5, 0.0, "friction must be positive"),
    ],
)
def test_impossible_input_gets_a_sentence(
    creepage: list[float], load: float, friction: float, sentence: str
) -> None:
    with pytest.raises(RailgripError, match=sentence):
        slope_band(creepage, load, 7.2e-3, 5.4e-3, friction)
