"""Friction memory along a row of cells."""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import DRY_POLACH_2005
from railgrip.laboratory.exact_friction import (
    FrictionMemory,
    remembered_friction,
    steady_friction,
)

SLIP = np.array([[0.3, 0.2, 0.1, 0.0, 0.0]])


def test_the_law_is_polachs() -> None:
    for speed in (0.0, 0.2, 5.0):
        assert steady_friction(DRY_POLACH_2005, speed) == pytest.approx(
            falling_friction(DRY_POLACH_2005, speed), rel=1e-14
        )


def test_without_memory_friction_follows_at_once() -> None:
    friction = remembered_friction(DRY_POLACH_2005, FrictionMemory(0.0, 0.0), SLIP, 1e-5)
    np.testing.assert_allclose(friction[:, :3], steady_friction(DRY_POLACH_2005, SLIP)[:, :3])


def test_with_memory_it_falls_from_the_static_value_behind_the_leading_edge() -> None:
    friction = remembered_friction(DRY_POLACH_2005, FrictionMemory(1e-6, 1e-2), SLIP, 1e-5)[0]
    wanted = steady_friction(DRY_POLACH_2005, SLIP)[0]
    assert friction[4] == friction[3] == pytest.approx(0.55)
    assert np.all(friction[:3] > wanted[:3])
    kept = 1e-6 / (1e-6 + 1e-5 * 0.1)
    assert friction[2] == pytest.approx(kept * 0.55 + (1.0 - kept) * wanted[2])


def test_in_a_march_the_particle_brings_its_own() -> None:
    before = np.array([[0.5, 0.4, 0.3, 0.2, 0.1]])
    long = FrictionMemory(1.0, 0.0)
    friction = remembered_friction(DRY_POLACH_2005, long, SLIP, 1e-5, before)[0]
    np.testing.assert_allclose(friction, [0.4, 0.3, 0.2, 0.1, 0.55], atol=1e-5)
