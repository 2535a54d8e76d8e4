"""Slopes by stiffness: integrals over a brush that sticks to the rail."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.rolling_contact import Creepage
from railgrip.contact.surface_stiffness import (
    rectangular_stiffness_slope,
    stiffness_force,
    stiffness_slopes,
)

A, B, K = 7.2e-3, 5.4e-3, 20e12


def of_brush(creepage: Creepage) -> tuple[float, float, float]:
    """Bristles that enter unstressed at the leading edge: stress = K ∫ slip dx'."""
    cells = 400
    v = (np.arange(cells) + 0.5) / cells * 2.0 - 1.0
    y = (B * v)[:, None]
    lead = A * np.sqrt(1.0 - v**2)[:, None]
    x = lead * v[None, :]
    area = (2.0 * lead / cells) * (2.0 * B / cells)
    along = K * (creepage.longitudinal - creepage.spin * y) * (lead - x)
    across = K * (creepage.lateral * (lead - x) + 0.5 * creepage.spin * (lead**2 - x**2))
    moment = (x * across - y * along) * area
    return float((along * area).sum()), float((across * area).sum()), float(moment.sum())


def test_forces_and_moment_are_those_of_the_sticking_brush() -> None:
    slopes = stiffness_slopes(A, B, K)
    along, _, _ = of_brush(Creepage(1e-4, 0.0, 0.0))
    _, across, moment = of_brush(Creepage(0.0, 1e-4, 0.0))
    assert along == pytest.approx(slopes.c11 * 1e-4, rel=1e-3)
    assert across == pytest.approx(slopes.c22 * 1e-4, rel=1e-3)
    assert moment == pytest.approx(-slopes.c23 * 1e-4, rel=1e-3)
    spin_along, spin_across, spin_moment = of_brush(Creepage(0.0, 0.0, 0.1))
    assert spin_along == pytest.approx(0.0, abs=1e-6)
    assert spin_across == pytest.approx(slopes.c23 * 0.1, rel=1e-3)
    assert spin_moment == pytest.approx(slopes.c33 * 0.1, rel=1e-3)


SMALL = st.floats(-1e-2, 1e-2)


@given(SMALL, SMALL, st.floats(-1.0, 1.0))
def test_the_coupled_form_is_odd_and_takes_energy(x: float, y: float, spin: float) -> None:
    slopes = stiffness_slopes(A, B, K)
    force = stiffness_force(slopes, Creepage(x, y, spin))
    back = stiffness_force(slopes, Creepage(-x, -y, -spin))
    assert tuple(force) == tuple(-part for part in back)
    assert force.longitudinal * x + force.lateral * y + force.spin_moment * spin >= 0.0


def test_the_rectangle_is_the_brush_of_a_strip() -> None:
    """∫ K (a − x) dx over −a … a is 2 a² K per width."""
    x = (np.arange(1000) + 0.5) / 1000 * 2.0 * A - A
    per_width = float((K * (A - x)).sum() * 2.0 * A / 1000)
    assert rectangular_stiffness_slope(A, 0.02, K) == pytest.approx(0.02 * per_width)
