"""Cylinder, rigging and friction radius of the standard's example."""

from __future__ import annotations

import pytest

from railgrip.brake.rigging import Rigging, clamp_force

TREAD = Rigging(346e-4, 0.95, -300.0, 5.0, 0.95, -500.0, 1.0)
DISC = Rigging(324e-4, 0.98, -500.0, 5.0, 0.95, 0.0, 1.0)


@pytest.mark.parametrize(
    ("rigging", "pressure", "friction", "lever", "force"),
    [(TREAD, 3.8e5, 0.28, 2 * 0.5 / 1.0, 16073.5), (DISC, 3.0e5, 0.35, 2 * 0.27 / 0.89, 9104.2)],
)
def test_the_retarding_force_at_the_tread(
    rigging: Rigging, pressure: float, friction: float, lever: float, force: float
) -> None:
    found = clamp_force(rigging, pressure) * friction * lever
    assert found == pytest.approx(force, abs=0.05)
