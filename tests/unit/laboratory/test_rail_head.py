"""The head of 60E1: arcs without a corner, as wide as the drawing says, at the gauge."""

from __future__ import annotations

import math

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.laboratory.rail_head import head_60e1

UPRIGHT = 0.5 * 1.435 + 0.036 - 0.0003 / 20.0
"""Middle of an upright head: its face, 36 mm away 14.3 mm down, leans by 1:20 up to 14 mm."""


def test_the_last_arc_ends_at_the_face_of_a_head_of_72_mm() -> None:
    edge = UPRIGHT + 0.036 + np.array([-1e-6, 1e-6])
    depth = head_60e1(edge, inclination=0.0)
    assert depth[0] == pytest.approx(14.3e-3, abs=3e-5)
    assert math.isnan(depth[1])


@pytest.mark.parametrize("inclination", [0.0, 1.0 / 40.0, 1.0 / 20.0])
def test_no_corner_between_the_arcs(inclination: float) -> None:
    step = 1e-6
    position = UPRIGHT + np.arange(-0.030, 0.030, step)
    slope = np.diff(head_60e1(position, inclination=inclination)) / step
    radius = (1.0 + slope[1:] ** 2) ** 1.5 * step / np.diff(slope)
    assert np.isfinite(slope).all()
    assert radius.min() > 0.9 * 0.013
    assert np.diff(slope).max() < 2.0 * step * (1.0 + slope.max() ** 2) ** 1.5 / 0.013


@pytest.mark.parametrize("inclination", [0.0, 1.0 / 40.0, 1.0 / 20.0])
def test_depth_counts_from_the_highest_point(inclination: float) -> None:
    position = UPRIGHT + np.arange(-0.030, 0.030, 1e-5)
    depth = head_60e1(position, inclination=inclination)
    assert depth.min() == pytest.approx(0.0, abs=1e-9)


def test_a_rail_at_1_40_has_its_highest_point_7_5_mm_outside_its_middle() -> None:
    position = UPRIGHT + np.arange(-0.030, 0.030, 1e-5)
    highest = position[int(np.argmin(head_60e1(position)))]
    middle = 0.5 * 1.435 + 0.036 - 14.3e-3 / 40.0  # to first order in the lean
    assert highest - middle == pytest.approx(0.3 / 40.0, abs=5e-5)


def test_a_wider_gauge_moves_the_rail() -> None:
    position = np.linspace(0.745, 0.765, 21)
    moved = head_60e1(position + 0.005, gauge=1.445)
    assert moved == pytest.approx(head_60e1(position), abs=1e-15)


@pytest.mark.parametrize(
    ("gauge", "inclination", "sentence"),
    [
        (1.0, 0.025, "gauge is out of range; got 1; allowed: 1.4 … 1.5"),
        (1.435, 0.1, "inclination of the rail is out of range; got 0.1"),
        (math.nan, 0.025, "gauge is out of range"),
    ],
)
def test_an_impossible_track_gets_a_sentence(
    gauge: float, inclination: float, sentence: str
) -> None:
    with pytest.raises(RailgripError, match=sentence):
        head_60e1(np.array([0.75]), gauge, inclination)
