"""Several laws on the same points."""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.contact.polach_2005 import polach_rolling
from railgrip.contact.rail_friction import DRY_POLACH_2005, RailFriction
from railgrip.contact.rolling_contact import Creepage
from railgrip.core import registry
from railgrip.core.errors import RailgripError
from railgrip.laboratory.exact import exact_law
from railgrip.laboratory.law_comparison import compare_laws, law_names
from railgrip.laboratory.laws_over_arrays import rescaled
from railgrip.scenario.contact_pair import contact_of_pair

BASE = contact_of_pair("cone_on_head", 100e3)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)


def test_each_law_says_what_it_says_alone() -> None:
    loads = np.array([50e3, 100e3])
    found = compare_laws(
        ["exact", "polach_2005"], BASE, COULOMB, 20.0, [0.001, 0.002], 0.001, 0.1, load=loads
    )
    assert found.laws == ["exact", "polach_2005"]
    for k, load in enumerate(loads.tolist()):
        here, creepage = rescaled(BASE, load), Creepage(0.001 * (k + 1), 0.001, 0.1)
        for law, alone in (("exact", exact_law), ("polach_2005", polach_rolling)):
            force = alone(here, COULOMB, 20.0, creepage)
            forces = found.forces[law]
            assert (forces.longitudinal[k], forces.lateral[k]) == (force[0], force[1])


def test_differences_are_over_the_friction_limit() -> None:
    found = compare_laws(["exact", "kalker_linear"], BASE, COULOMB, 20.0, [0.02, -0.02])
    linear = 14.523733e6 * 0.02
    assert found.friction_limit.tolist() == pytest.approx([30e3, 30e3])
    assert found.difference("kalker_linear", "exact") == pytest.approx(
        [linear / 30e3 - 1.0] * 2, rel=1e-3
    )
    assert found.difference("exact", "exact").tolist() == [0.0, 0.0]
    assert not found.forces["kalker_linear"].is_valid.any()
    assert found.forces["exact"].is_valid.all()


def test_without_friction_there_is_no_difference_to_speak_of() -> None:
    slippery = COULOMB._replace(static_friction=0.0)
    found = compare_laws(["polach_2005", "fastsim_1982"], BASE, slippery, 20.0, 0.01)
    assert np.isnan(found.difference("fastsim_1982", "polach_2005")).all()


def test_all_of_the_power_becomes_heat() -> None:
    # Full sliding at 5 %: force times slip speed, and the closed formula of the flash temperature.
    found = compare_laws(["exact"], BASE, COULOMB, 20.0, 0.05)
    assert found.friction_power("exact").item() == pytest.approx(30e3, rel=1e-3)
    assert found.slip_speed.item() == pytest.approx(1.0)
    beta, flux = 13290.03, 0.3 * 1227.1523e6 * 1.0
    share = np.sqrt(20.0) / (np.sqrt(20.0) + np.sqrt(21.0))
    formula = 1.23463 * share * flux * np.sqrt(7.191978e-3 / 20.0) / beta
    assert found.flash_rise("exact").item() == pytest.approx(formula, rel=1e-2)


def test_every_registered_law_takes_part() -> None:
    names = law_names()
    assert set(registry.names("railgrip.rolling_laws")) | {"exact"} == set(names)
    found = compare_laws(names, BASE, DRY_POLACH_2005, 20.0, 0.0005)
    for law in names:
        assert 0.0 < found.adhesion(law).item() < 0.1, law


@pytest.mark.parametrize(
    ("laws", "given", "told"),
    [
        ([], {}, "no law is given"),
        (["polach"], {}, "did you mean 'polach_2005'?"),
        (["exact"], {"speed": 0.0}, "the speed must be positive and finite; got 0 m/s"),
        (["exact"], {"load": -1.0}, "the load must be positive and finite"),
        (["exact"], {"spin": np.nan}, "the spin must be finite"),
        (["exact"], {"lateral": [[1.0, 2.0]]}, "must lie in one row"),
        (["exact"], {"lateral": [1.0, 2.0], "spin": [1.0, 2.0, 3.0]}, "do not fit together"),
    ],
)
def test_refuses_in_words(laws: list[str], given: dict[str, object], told: str) -> None:
    with pytest.raises(RailgripError, match=told.replace("?", r"\?")):
        compare_laws(laws, BASE, COULOMB, **{"speed": 20.0, **given})  # type: ignore[arg-type]
