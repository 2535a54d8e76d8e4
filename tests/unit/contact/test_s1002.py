"""The profile S1002: its zones meet, its derivatives are derivatives, its ends are ends."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from railgrip.contact.s1002 import s1002, zone_limits
from railgrip.core.errors import RailgripError

LIMITS = [inner for _, _, inner in zone_limits()[:-1]]
# Steps of the published pieces where they meet: height [m], slope [-]. From the field side: A|B …
STEPS = [
    (3e-13, 4e-9),
    (3.7e-8, 3.3e-6),
    (1.19e-7, 7.8e-6),
    (3e-12, 2e-9),
    (3e-11, 6e-9),
    (7e-11, 3e-11),
    (5e-13, 3e-11),
]


def test_the_zones_cover_the_profile_without_a_gap() -> None:
    limits = zone_limits()
    assert [name for name, _, _ in limits] == list("ABCDEFGH")
    assert (limits[0][1], limits[-1][2]) == (0.060, -0.070)
    for (_, _, inner), (_, outer, _) in pairwise(limits):
        assert inner == outer


@pytest.mark.parametrize(("limit", "steps"), list(zip(LIMITS, STEPS, strict=True)))
def test_the_pieces_meet_as_exactly_as_they_are_published(
    limit: float, steps: tuple[float, float]
) -> None:
    reach = 1e-12
    outside, inside = s1002(limit + reach), s1002(limit - reach)
    assert outside.zone != inside.zone
    bend = abs(outside.second_derivative) + abs(inside.second_derivative)
    height, slope = steps
    assert outside.height == pytest.approx(
        inside.height, rel=0, abs=height + 3.0 * reach * abs(outside.slope)
    )
    assert outside.slope == pytest.approx(inside.slope, rel=0, abs=slope + 2.0 * reach * bend)


@given(st.floats(-0.0699, 0.0599))
def test_slope_and_second_derivative_are_those_of_the_height(position: float) -> None:
    reach = 1e-7
    assume(all(abs(position - limit) > 2.0 * reach for limit in LIMITS))
    before, here, after = (s1002(position + step) for step in (-reach, 0.0, reach))
    slope = (after.height - before.height) / (2.0 * reach)
    bend = (after.slope - before.slope) / (2.0 * reach)
    assert here.slope == pytest.approx(slope, rel=1e-4, abs=1e-7)
    assert here.second_derivative == pytest.approx(bend, rel=1e-3, abs=1e-5)


@given(st.floats(-0.0699, 0.06))
def test_the_radius_is_that_of_the_curvature(position: float) -> None:
    point = s1002(position)
    curvature = -point.second_derivative / (1.0 + point.slope**2) ** 1.5
    assert 1.0 / point.transverse_radius == pytest.approx(curvature, rel=1e-9, abs=1e-12)
    assert point.conicity == -point.slope


@pytest.mark.parametrize(
    ("position", "zone", "radius"),
    [
        (0.05, "A", math.inf),
        (-0.0365, "D", -0.013),
        (-0.039, "E", math.inf),
        (-0.045, "F", 0.020),
        (-0.055, "G", 0.012),
        (-0.065, "H", 0.0205),
    ],
)
def test_straight_pieces_and_arcs(position: float, zone: str, radius: float) -> None:
    point = s1002(position)
    assert point.zone == zone
    assert point.transverse_radius == pytest.approx(radius)


def test_what_the_drawing_says() -> None:
    """1:15 at the field side, flange at 70° and 28 mm high, vertical at its back."""
    assert s1002(0.05).conicity == pytest.approx(1.0 / 15.0, rel=1e-7)
    assert math.degrees(math.atan(s1002(-0.039).conicity)) == pytest.approx(70.0, abs=1e-4)
    assert s1002(-0.055).height == pytest.approx(0.028, abs=1e-12)
    back = s1002(-0.070)
    assert back.slope == math.inf
    assert back.height == pytest.approx(9.519259302e-3)
    assert back.transverse_radius == pytest.approx(0.0205)


def test_the_tread_is_concave_to_14_1_mm_and_convex_beyond() -> None:
    assert s1002(14.0e-3).transverse_radius < 0.0 < s1002(14.2e-3).transverse_radius


@pytest.mark.parametrize("position", [0.0601, -0.0701, math.nan, math.inf])
def test_a_place_off_the_profile_gets_a_sentence(position: float) -> None:
    with pytest.raises(RailgripError, match=r"off the profile S1002; got y = .*-70 … 60 mm"):
        s1002(position)
