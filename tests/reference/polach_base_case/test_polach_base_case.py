"""Polach's force on dry and wet rail."""

from __future__ import annotations

import math

import pytest

from railgrip.contact.kalker_1990 import kalker_slope
from railgrip.contact.polach_2005 import polach_2005, polach_rolling
from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005, RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact

FORCES = [(DRY_POLACH_2005, 35940.38), (WET_POLACH_2005, 16138.10)]


@pytest.mark.parametrize(("rail", "force"), FORCES)
def test_the_force_at_one_per_cent(rail: RailFriction, force: float) -> None:
    slope = kalker_slope(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    assert polach_2005(rail, 100e3, slope, 0.2, 0.01) == pytest.approx(force, rel=1e-6)


@pytest.mark.parametrize(("rail", "force"), FORCES)
def test_the_same_through_the_contract_of_rolling_contact(rail: RailFriction, force: float) -> None:
    contact = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    braked = polach_rolling(contact, rail, 20.0, Creepage(-0.01, 0.0, 0.0))
    assert braked.longitudinal == pytest.approx(-force, rel=1e-6)
    assert braked.lateral == 0.0


@pytest.mark.parametrize("rail", [DRY_POLACH_2005, WET_POLACH_2005])
def test_the_parameters_lie_on_the_published_fits(rail: RailFriction) -> None:
    friction = rail.static_friction
    assert rail.friction_decay == pytest.approx(1.6 * friction - 0.28)
    assert rail.adhesion_reduction == pytest.approx(2.8 * friction - 0.54)
    assert rail.slip_reduction == pytest.approx(1.2 * friction - 0.26)
