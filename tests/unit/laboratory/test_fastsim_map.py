"""What the map of a patch shows, and that it sums up to the law's forces."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from railgrip.contact.fastsim_1982 import fastsim_1982, fastsim_elliptic_1982
from railgrip.contact.fastsim_grid import flexibilities
from railgrip.contact.modified_fastsim_2013 import EUROSPRINTER_2013, modified_fastsim_2013
from railgrip.contact.rail_friction import WET_POLACH_2005, RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.core.errors import RailgripError
from railgrip.laboratory.fastsim_map import fastsim_map

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
RAIL = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
COMBINED = Creepage(0.002, -0.001, 0.4)


def test_the_forces_are_those_of_the_laws_bit_for_bit() -> None:
    for rail in (RAIL, WET_POLACH_2005):
        parabolic = fastsim_map(BASE, rail, 20.0, COMBINED)
        assert parabolic.forces == fastsim_1982(BASE, rail, 20.0, COMBINED)
        elliptic = fastsim_map(BASE, rail, 20.0, COMBINED, bound="elliptic")
        assert elliptic.forces == fastsim_elliptic_1982(BASE, rail, 20.0, COMBINED)
        soft = fastsim_map(BASE, rail, 20.0, COMBINED, reduction=EUROSPRINTER_2013)
        assert soft.forces == modified_fastsim_2013(BASE, rail, 20.0, COMBINED)


@pytest.mark.parametrize("bound", ["parabolic", "elliptic"])
def test_stick_and_slip(bound: str) -> None:
    patch = fastsim_map(BASE, RAIL, 20.0, COMBINED, cells=60, bound=bound)
    traction = np.hypot(patch.traction_x, patch.traction_y)
    slips = patch.is_slipping
    assert 0.1 < slips.mean() < 0.9
    assert traction[slips] == pytest.approx(patch.bound[slips], rel=1e-12)
    assert (traction[~slips] < patch.bound[~slips]).all()
    assert (patch.slip_x[~slips] == 0.0).all()
    assert (patch.slip_y[~slips] == 0.0).all()
    # friction opposes slip: power is spent in every cell that slips
    power = patch.traction_x * patch.slip_x + patch.traction_y * patch.slip_y
    assert (power[slips] > 0.0).all()
    inside = (patch.x / BASE.a) ** 2 + (patch.y / BASE.b) ** 2
    assert (inside < 1.0).all()


def test_where_longitudinal_creepage_lets_the_patch_stick() -> None:
    """Sticking from the leading edge, as far as the traction stays below the paraboloid.

    s (x_l − x)/L1 = μ p0 (x_l² − x²)/a² at x = s a²/(L1 μ p0) − x_l.
    """
    creepage = 0.002
    patch = fastsim_map(BASE, RAIL, 20.0, Creepage(creepage, 0.0, 0.0), cells=400)
    greatest = 0.3 * 2.0 * BASE.load / (math.pi * BASE.a * BASE.b)
    reach = creepage * BASE.a**2 / (flexibilities(BASE).longitudinal * greatest)
    edge = BASE.a * np.sqrt(1.0 - (patch.y / BASE.b) ** 2)
    expected = patch.x < reach - edge
    assert (patch.is_slipping != expected).mean() < 0.01


def test_when_all_slides_slip_is_the_rigid_one_in_the_middle() -> None:
    patch = fastsim_map(BASE, RAIL, 20.0, Creepage(0.1, 0.0, 0.0), cells=51)
    assert patch.is_slipping.all()
    # half a cell in front of the middle the traction still rises a little
    assert patch.slip_x[25, 25] == pytest.approx(0.1, rel=5e-3)
    assert patch.forces.longitudinal == pytest.approx(30e3, rel=1e-6)


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"contact": BASE._replace(load=-1.0)}, "the load must be positive and finite; got -1 N"),
        ({"speed": 0.0}, "the speed must be positive and finite; got 0 m/s"),
        ({"creepage": Creepage(math.nan, 0.0, 0.0)}, "the longitudinal creepage must be finite"),
        ({"bound": "elliptical"}, "bound 'elliptical' unknown; .*did you mean 'elliptic'"),
        ({"cells": 1}, "number of cells is out of range; got 1; allowed: 2 … 2000"),
    ],
)
def test_bad_input_gets_a_sentence(changed: dict[str, Any], words: str) -> None:
    given: dict[str, Any] = {
        "contact": BASE,
        "rail": RAIL,
        "speed": 20.0,
        "creepage": COMBINED,
    }
    with pytest.raises(RailgripError, match=words):
        fastsim_map(**{**given, **changed})
