"""What the exact solution must obey in every cell and as a whole, whatever the case."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.laboratory.exact import ExactSolution, solve_exact
from railgrip.laboratory.exact_friction import FrictionMemory, steady_friction
from railgrip.laboratory.exact_solution import SPIN_SHIFT

COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
FALLING = RailFriction(0.5, 0.4, 0.8, 1.0, 1.0)
A, LOAD, SHEAR, SPEED = 6e-3, 80e3, 80e9, 20.0
GRID = (18, 16)
few = settings(max_examples=30, deadline=None)

contacts = st.builds(
    lambda ratio, poisson: RollingContact(
        LOAD, A, A * 10.0**ratio, SHEAR, poisson, 0.0, 0.0, 0.0, 0.0
    ),
    st.sampled_from([-1.0, -0.5, -0.1, 0.0, 0.3, 1.0]),
    st.sampled_from([0.0, 0.28, 0.5]),
)
shares = st.floats(-1.0, 1.0).map(lambda share: share if abs(share) > 1e-6 else 0.0)
creepages = st.builds(
    lambda size, x, y, spin: Creepage(10.0**size * x, 10.0**size * y, 10.0**size * spin / A),
    st.floats(-6.0, 0.0),
    shares,
    shares,
    shares,
)
rails = st.sampled_from([COULOMB, FALLING])


def solved(contact: RollingContact, rail: RailFriction, creepage: Creepage) -> ExactSolution:
    solution = solve_exact(contact, rail, SPEED, creepage, grid=GRID)
    assert solution.is_converged
    return solution


def mirrored(force: Creepage | CreepForce) -> list[float]:
    return [force[0], -force[1], -force[2]]


def close(found: Any, wanted: Any, limit: float = 0.3 * LOAD) -> None:
    np.testing.assert_allclose(found[:2], wanted[:2], atol=1e-5 * limit, rtol=1e-5)
    np.testing.assert_allclose(found[2], wanted[2], atol=1e-5 * limit * 0.06, rtol=1e-5)


@few
@given(contacts, rails, creepages)
def test_every_cell_sticks_or_slips_against_full_friction(
    contact: RollingContact, rail: RailFriction, creepage: Creepage
) -> None:
    solution = solved(contact, rail, creepage)
    bound = solution.friction * solution.pressure
    size = max(float(bound.max()), 1.0)
    traction = np.stack([solution.traction_x, solution.traction_y])
    slip = np.stack([solution.slip_x, solution.slip_y])
    length, slid = np.hypot(*traction), np.hypot(*slip)
    greatest = max(map(abs, (creepage[0], creepage[1], creepage[2] * 10 * A)))
    stick, slips = solution.is_sticking, solution.is_slipping
    assert np.all(length <= bound + 1e-5 * size)
    assert np.all(slid[stick] <= 1e-4 * greatest)
    assert np.all(np.abs(length - bound)[slips] <= 1e-5 * size)
    along = (traction * slip).sum(axis=0)
    assert np.all(along[slips] >= (length * slid)[slips] - 1e-4 * size * greatest)
    assert not np.any(length[~solution.is_inside])


@few
@given(contacts, rails, creepages)
def test_it_takes_energy(contact: RollingContact, rail: RailFriction, creepage: Creepage) -> None:
    force = solved(contact, rail, creepage).force
    ahead = SPIN_SHIFT * 2 * A / (GRID[0] - 4)
    power = (
        force.longitudinal * creepage.longitudinal
        + force.lateral * creepage.lateral
        + (force.spin_moment + ahead * force.lateral) * creepage.spin
    )
    assert power >= 0.0
    assert math.hypot(force.longitudinal, force.lateral) <= rail.static_friction * LOAD * (1 + 1e-6)


@few
@given(contacts, creepages)
def test_odd_and_mirrored(contact: RollingContact, creepage: Creepage) -> None:
    force = solved(contact, COULOMB, creepage).force
    against = solved(contact, COULOMB, Creepage(*(-each for each in creepage))).force
    close([-each for each in against], force)
    close(solved(contact, COULOMB, Creepage(*mirrored(creepage))).force, mirrored(force))


@few
@given(contacts, creepages)
def test_continuous(contact: RollingContact, creepage: Creepage) -> None:
    here = solved(contact, COULOMB, creepage).force
    near = solved(contact, COULOMB, Creepage(*(each * (1 + 1e-6) for each in creepage))).force
    np.testing.assert_allclose(near[:2], here[:2], atol=1e-4 * 0.3 * LOAD)


@few
@given(contacts, creepages)
def test_it_knows_creepage_over_friction_only(contact: RollingContact, creepage: Creepage) -> None:
    halved = Creepage(*(0.5 * each for each in creepage))
    slippery = COULOMB._replace(static_friction=0.15)
    force = solved(contact, COULOMB, creepage).force
    close([2.0 * each for each in solved(contact, slippery, halved).force], force)


@few
@given(contacts, creepages)
def test_no_fall_is_coulomb(contact: RollingContact, creepage: Creepage) -> None:
    force = solved(contact, COULOMB, creepage).force
    for rail in (COULOMB._replace(friction_decay=3.0), COULOMB._replace(friction_ratio=0.2)):
        assert solved(contact, rail, creepage).force == force


@few
@given(contacts, creepages)
def test_friction_falls_within_its_bounds(contact: RollingContact, creepage: Creepage) -> None:
    solution = solved(contact, FALLING, creepage)
    friction = solution.friction[solution.is_inside]
    slip_speed = SPEED * np.hypot(solution.slip_x, solution.slip_y)[solution.is_inside]
    assert friction.max() <= 0.5 * (1 + 1e-9)
    assert friction.min() >= steady_friction(FALLING, slip_speed.max()) - 1e-6


@pytest.mark.parametrize("creepage", [Creepage(0.5, 0.0, 0.0), Creepage(-0.3, 0.4, 0.0)])
def test_full_slip(creepage: Creepage) -> None:
    contact = RollingContact(LOAD, A, 4e-3, SHEAR, 0.28, 0.0, 0.0, 0.0, 0.0)
    force = solved(contact, COULOMB, creepage).force
    wanted = [0.3 * LOAD * each / 0.5 for each in creepage[:2]]
    assert list(force[:2]) == pytest.approx(wanted, abs=1e-4 * LOAD)


def test_full_spin_about_the_centre_is_the_moment_of_the_pressure() -> None:
    """∫ μ p r dA = (3π/16) μ Q a on a circle."""
    contact = RollingContact(LOAD, A, A, SHEAR, 0.28, 0.0, 0.0, 0.0, 0.0)
    solution = solve_exact(contact, COULOMB, SPEED, Creepage(0.0, 0.0, 1e5), grid=(64, 64))
    assert solution.force.spin_moment == pytest.approx(
        3.0 * math.pi / 16.0 * 0.3 * LOAD * A, rel=3e-3
    )


@pytest.mark.parametrize("distance", [0.0, 1e-6, 1e-5])
def test_the_longer_the_memory_the_more_friction_is_left(distance: float) -> None:
    contact = RollingContact(LOAD, A, 4e-3, SHEAR, 0.28, 0.0, 0.0, 0.0, 0.0)
    forces = [
        solve_exact(
            contact, FALLING, SPEED, Creepage(0.01, 0.0, 0.0), grid=GRID, memory=FrictionMemory(far)
        ).force.longitudinal
        for far in (distance, distance + 2e-6)
    ]
    assert forces[0] < forces[1]
