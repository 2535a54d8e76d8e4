"""Flash temperature over a patch: as the formula where all slides, late where some sticks."""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage
from railgrip.core.errors import RailgripError
from railgrip.laboratory.contact_temperature import surface_temperatures
from railgrip.laboratory.patch_map import patch_map
from railgrip.laboratory.patch_temperature import patch_rises
from railgrip.laboratory.sliding_contact import SlidingContact
from railgrip.scenario.contact_pair import contact_of_pair

BASE = contact_of_pair("cone_on_head", 100e3)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)


@pytest.mark.parametrize(("law", "tolerance"), [("exact", 0.02), ("fastsim_elliptic_1982", 0.02)])
def test_all_of_the_patch_slides(law: str, tolerance: float) -> None:
    # At 5 % nothing sticks, but the elastic slip at the edges remains: 2 %.
    sliding = Creepage(0.05, 0.0, 0.0)
    wheel, rail = patch_rises(patch_map(law, BASE, COULOMB, 20.0, sliding), BASE, 20.0, sliding)
    surfaces = SlidingContact(100e3, BASE.a, BASE.b, 0.3, 21.0, 20.0)
    behind = np.linspace(-1.0, 1.0, 401) * BASE.a
    formula = surface_temperatures(surfaces, behind)
    assert wheel.max() == pytest.approx(formula.wheel.max() - 20.0, rel=tolerance)
    assert rail.max() == pytest.approx(formula.rail.max() - 20.0, rel=tolerance)


def test_where_some_sticks_the_front_stays_cold() -> None:
    rolling = Creepage(0.002, 0.0, 0.0)
    found = patch_map("exact", BASE, COULOMB, 20.0, rolling)
    wheel, _ = patch_rises(found, BASE, 20.0, rolling)
    middle = found.x.shape[0] // 2
    assert wheel[middle, -8:].max() < 0.05 * wheel.max()
    hottest = found.x.ravel()[np.argmax(wheel)]
    assert hottest < -0.65 * BASE.a


def test_both_grids_agree() -> None:
    rolling = Creepage(0.003, 0.001, 0.0)
    most = [
        patch_rises(patch_map(law, BASE, COULOMB, 20.0, rolling), BASE, 20.0, rolling)[0].max()
        for law in ("exact", "fastsim_elliptic_1982")
    ]
    assert most[0] == pytest.approx(most[1], rel=0.1)


def test_a_locked_wheel_is_refused_with_what_knows_it() -> None:
    locked = Creepage(-1.0, 0.0, 0.0)
    found = patch_map("fastsim_1982", BASE, COULOMB, 20.0, locked)
    with pytest.raises(RailgripError, match="surface_temperatures, which knows slow bodies"):
        patch_rises(found, BASE, 20.0, locked)
