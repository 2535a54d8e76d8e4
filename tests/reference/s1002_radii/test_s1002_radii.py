"""Radii of the profile S1002 against figures evaluated elsewhere."""

from __future__ import annotations

import pytest

from railgrip.contact.s1002 import s1002

RADII = {-8: 214.216, 0: 319.890, 8: 601.525}
PRINTED = {-8: 192.6, 0: 303.4, 8: 588.6}
PRINTED_SLOPES = {-8: -6.448e-2, 0: -3.358e-2, 8: -1.414e-2}
PRINTED_HEIGHTS = {-8: 0.384, 0: 0.0, 8: -0.183}


@pytest.mark.parametrize("y", RADII)
def test_the_true_radii(y: int) -> None:
    assert 1e3 * s1002(1e-3 * y).transverse_radius == pytest.approx(-RADII[y], abs=5.1e-4)


@pytest.mark.parametrize("y", RADII)
def test_height_and_slope_of_the_paper_but_for_its_misprints(y: int) -> None:
    point = s1002(1e-3 * y)
    assert 1e3 * point.height == pytest.approx(PRINTED_HEIGHTS[y], abs=5e-4)
    assert point.slope == pytest.approx(PRINTED_SLOPES[y], abs=1e-5)


@pytest.mark.parametrize("y", PRINTED)
def test_the_radii_of_the_paper_come_from_a_square_left_out(y: int) -> None:
    point = s1002(1e-3 * y)
    mistaken = (1.0 + point.slope) ** 1.5 / point.second_derivative
    assert 1e3 * mistaken == pytest.approx(PRINTED[y], rel=1e-3)


def test_where_a_head_of_300_mm_is_as_round_as_the_tread() -> None:
    assert -s1002(-1.235e-3).transverse_radius < 0.3 < -s1002(-1.225e-3).transverse_radius
