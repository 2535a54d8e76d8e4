"""Two like spheres pressed together and shifted: Cattaneo and Mindlin."""

from __future__ import annotations

import math

import numpy as np
import pytest

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, RollingContact
from railgrip.laboratory.exact import ExactSolution
from railgrip.laboratory.exact_march import march_exact

LOAD, A, SHEAR, FRICTION = 100e3, 6e-3, 80e9, 0.3
RAIL = RailFriction(FRICTION, 1.0, 0.0, 1.0, 1.0)
CELLS = 64
CELL = 2 * A / (CELLS - 4)


def shifted(shift: float, poisson: float) -> ExactSolution:
    contact = RollingContact(LOAD, A, A, SHEAR, poisson, 0.0, 0.0, 0.0, 0.0)
    creepage = Creepage(shift / CELL, 0.0, 0.0)
    return march_exact(contact, RAIL, 20.0, [creepage], grid=(CELLS, CELLS)).last


@pytest.mark.parametrize("poisson", [0.0, 0.28, 0.5])
def test_stiffness_without_slip(poisson: float) -> None:
    shift = 1e-12
    force = shifted(shift, poisson).force.longitudinal
    assert force / shift == pytest.approx(4.0 * SHEAR * A / (2.0 - poisson), rel=0.02)


@pytest.mark.parametrize("share", [0.2, 0.5, 0.8, 0.95])
def test_force_and_stick_circle(share: float) -> None:
    limit = FRICTION * LOAD
    shift = 3.0 * limit * 2.0 / (8.0 * SHEAR * A) * (1.0 - (1.0 - share) ** (2.0 / 3.0))
    solution = shifted(shift, 0.0)
    assert solution.is_converged
    assert solution.force.longitudinal == pytest.approx(share * limit, abs=0.015 * limit)
    area = float(np.sum(solution.is_sticking)) * solution.cell_area
    assert math.sqrt(area / math.pi) == pytest.approx(A * math.cbrt(1.0 - share), abs=CELL)
