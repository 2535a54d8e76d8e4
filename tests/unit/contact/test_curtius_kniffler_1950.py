"""Adhesion over the speed, and the form of the traction curve."""

from __future__ import annotations

import math

import pytest

from railgrip.contact.curtius_kniffler_1950 import WET_FLOOR, curtius_kniffler_1950, pacha


@pytest.mark.parametrize(
    ("speed_kmh", "adhesion"), [(0, 0.3315), (50, 0.2408), (100, 0.2131), (200, 0.1917)]
)
def test_the_published_table(speed_kmh: float, adhesion: float) -> None:
    assert curtius_kniffler_1950(speed_kmh / 3.6) == pytest.approx(adhesion, abs=5e-5)


def test_the_wet_variant_is_lower_by_as_much_at_any_speed() -> None:
    for speed in (0.0, 20.0, 60.0):
        less = curtius_kniffler_1950(speed) - curtius_kniffler_1950(speed, WET_FLOOR)
        assert less == pytest.approx(0.031)


def test_the_traction_curve() -> None:
    """Odd, one at its peak and nowhere more, smooth at √3, 0.4 at last."""
    assert pacha(1.0) == 1.0
    assert pacha(0.0) == 0.0
    assert pacha(0.5) == -pacha(-0.5) == 0.8
    assert max(pacha(0.01 * step) for step in range(1000)) == pacha(1.0)
    assert pacha(1e3) == pytest.approx(0.4)
    joint, little = math.sqrt(3.0), 1e-6
    for at in (joint - little, joint + little):
        slope = (pacha(at + 0.1 * little) - pacha(at - 0.1 * little)) / (0.2 * little)
        assert slope == pytest.approx(-0.25, abs=1e-4)
