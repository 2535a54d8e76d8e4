"""Slopes of the exact solver at small creepage against Kalker's table."""

from __future__ import annotations

import math

import pytest

from railgrip.contact.kalker_1990 import kalker_coefficients
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.laboratory.exact import refine_exact

RAIL = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
A, SHEAR = 5e-3, 80e9
SMALL = 1e-9
SHAPES = [0.1, 0.24, 0.55, 1.0, 1.3294, 2.35, 5.0, 10.0]


def slopes(ratio: float, poisson: float) -> tuple[float, float, float, float, float]:
    """C11, C22, C23 from the lateral force, C23 from the spin moment, C33."""
    b = A / ratio
    contact = RollingContact(100e3, A, b, SHEAR, poisson, 0.0, 0.0, 0.0, 0.0)

    def force(*creepage: float) -> CreepForce:
        return refine_exact(contact, RAIL, 20.0, Creepage(*creepage))[0]

    unit, mean = SHEAR * A * b * SMALL, math.sqrt(A * b)
    along, across, spin = force(SMALL, 0, 0), force(0, SMALL, 0), force(0, 0, SMALL / mean)
    return (
        along.longitudinal / unit,
        across.lateral / unit,
        spin.lateral / unit,
        -across.spin_moment / (unit * mean),
        spin.spin_moment / (unit * mean),
    )


@pytest.mark.parametrize("poisson", [0.0, 0.1, 0.28, 0.5])
@pytest.mark.parametrize("ratio", SHAPES)
def test_slopes_are_kalkers(ratio: float, poisson: float) -> None:
    table = kalker_coefficients(ratio, 1.0, poisson)
    c11, c22, c23, c32, c33 = slopes(ratio, poisson)
    assert c11 == pytest.approx(table.c11, rel=0.02)
    assert c22 == pytest.approx(table.c22, rel=0.02)
    assert c23 == pytest.approx(table.c23, rel=0.02)
    assert c33 == pytest.approx(table.c33, rel=0.03)
    assert c32 == pytest.approx(c23, rel=2e-3)
