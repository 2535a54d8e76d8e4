"""Lateral creepage and spin together, against the printed totals of CONTACT's own example."""

from __future__ import annotations

import pytest

from railgrip.contact.kalker_1990 import kalker_coefficients
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, RollingContact
from railgrip.laboratory.exact import solve_exact

A, B, LOAD, SHEAR, POISSON, FRICTION = 8e-3, 4e-3, 82e3, 82e9, 0.28, 0.3
PRINTED_LATERAL, PRINTED_MOMENT = -1.494e4, -48.21  # FY in N, MZ in N m
PRINTED_SHARE = -0.6074  # FY/(friction · FN)


def test_lateral_force_and_moment_are_those_printed() -> None:
    """Kalker's creepages are the negatives of ours; 44 cells with two spare on each side are 40."""
    contact = RollingContact(LOAD, A, B, SHEAR, POISSON, *kalker_coefficients(A, B, POISSON))
    creepage = Creepage(longitudinal=0.0, lateral=6.25e-4, spin=-0.625)
    rail = RailFriction(FRICTION, 1.0, 0.0, 1.0, 1.0)
    solution = solve_exact(contact, rail, 30.0, creepage, grid=(44, 44))
    assert solution.is_converged
    assert solution.force.longitudinal == pytest.approx(0.0, abs=1e-3)
    assert solution.force.lateral == pytest.approx(PRINTED_LATERAL, abs=5.0)
    assert solution.force.lateral / (FRICTION * LOAD) == pytest.approx(PRINTED_SHARE, abs=5e-5)
    assert solution.force.spin_moment == pytest.approx(PRINTED_MOMENT, abs=5e-3)
