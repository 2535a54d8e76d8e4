"""Polach's force on dry and wet rail."""

from __future__ import annotations

import math

import pytest

from railgrip.contact.kalker_1990 import kalker_slope
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005, RailFriction


@pytest.mark.parametrize(
    ("rail", "force"), [(DRY_POLACH_2005, 35940.38), (WET_POLACH_2005, 16138.10)]
)
def test_the_force_at_one_per_cent(rail: RailFriction, force: float) -> None:
    slope = kalker_slope(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    assert polach_2005(rail, 100e3, slope, 0.2, 0.01) == pytest.approx(force, rel=1e-6)


@pytest.mark.parametrize("rail", [DRY_POLACH_2005, WET_POLACH_2005])
def test_the_parameters_lie_on_the_published_fits(rail: RailFriction) -> None:
    friction = rail.static_friction
    assert rail.friction_decay == pytest.approx(1.6 * friction - 0.28)
    assert rail.adhesion_reduction == pytest.approx(2.8 * friction - 0.54)
    assert rail.slip_reduction == pytest.approx(1.2 * friction - 0.26)
