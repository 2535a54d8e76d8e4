"""Fields over the patch, by FASTSIM and by the exact theory."""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.contact.fastsim_1982 import fastsim_1982
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage
from railgrip.core.errors import RailgripError
from railgrip.laboratory.exact import exact_law
from railgrip.laboratory.patch_map import MAPPED_LAWS, patch_map
from railgrip.scenario.contact_pair import contact_of_pair

BASE = contact_of_pair("cone_on_head", 100e3)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
MIXED = Creepage(0.002, 0.001, 0.3)


@pytest.mark.parametrize("law", MAPPED_LAWS)
def test_what_holds_in_every_patch(law: str) -> None:
    found = patch_map(law, BASE, COULOMB, 20.0, MIXED)
    traction = np.hypot(found.traction_x, found.traction_y)
    # FASTSIM's paraboloid reaches beyond friction times Hertz's pressure, by 4/3 at the centre, and
    # its bound is scaled so that the cells add up to μQ, by 2e-4 on this grid
    most = 4.0 / 3.0 if law in ("fastsim_1982", "modified_fastsim_2013") else 1.0
    assert (traction <= most * 0.3 * found.pressure * (1 + 1e-3) + 1.0)[found.is_inside].all()
    assert (found.heat_flux >= 0.0).all()
    assert (found.heat_flux[~found.is_slipping] == 0.0).all()
    assert 0 < found.is_slipping.sum() < found.is_inside.sum()
    assert found.pressure.max() == pytest.approx(1227e6, rel=2e-3)


def test_the_forces_are_those_of_the_law() -> None:
    found = patch_map("fastsim_1982", BASE, COULOMB, 20.0, MIXED, cells=50)
    assert found.forces == pytest.approx(fastsim_1982(BASE, COULOMB, 20.0, MIXED), rel=1e-9)
    exact = patch_map("exact", BASE, COULOMB, 20.0, MIXED, cells=48)
    assert exact.forces == exact_law(BASE, COULOMB, 20.0, MIXED)


def test_heat_adds_up_to_the_power_of_the_forces() -> None:
    # The exact grid loses at first order in its cells: 5 % at 48, half at twice as many.
    off = []
    for cells in (48, 92):
        found = patch_map("exact", BASE, COULOMB, 20.0, MIXED, cells=cells)
        area = (found.x[0, 1] - found.x[0, 0]) * (found.y[1, 0] - found.y[0, 0])
        force = found.forces
        power = 20.0 * (
            force.longitudinal * MIXED.longitudinal
            + force.lateral * MIXED.lateral
            + force.spin_moment * MIXED.spin
        )
        off.append(1.0 - found.heat_flux.sum() * area / power)
    assert 0.0 < off[0] < 0.06
    assert off[1] == pytest.approx(0.5 * off[0], rel=0.15)


def test_a_law_without_a_map_is_refused_with_those_that_have_one() -> None:
    with pytest.raises(RailgripError, match="known: exact, fastsim_1982"):
        patch_map("polach_2005", BASE, COULOMB, 20.0, MIXED)
