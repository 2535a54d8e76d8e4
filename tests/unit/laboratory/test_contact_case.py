"""What a contact is before it creeps."""

from __future__ import annotations

import math

import pytest

from railgrip.core.errors import RailgripError
from railgrip.laboratory.contact_case import contact_case
from railgrip.scenario.contact_pair import contact_pair


def test_the_base_case() -> None:
    case = contact_case("cone_on_head", 100e3)
    assert case.patch.a == pytest.approx(7.191978396e-3, rel=1e-9)
    assert case.patch.greatest_pressure == pytest.approx(1227.1523e6, rel=1e-7)
    assert case.slopes.kalker_1990 == pytest.approx(14.523733e6, rel=1e-6)
    assert (case.contact.a, case.contact.load) == (case.patch.a, 100e3)


def test_the_five_slopes_of_the_paper() -> None:
    slopes = contact_case(contact_pair("cap_2000"), 100e3).slopes
    expected = (16605e3, 16650e3, 10323.76e3, 15062.80e3, 16244.44e3, 15744.6e3)
    assert slopes[:6] == pytest.approx(expected, rel=1e-4)


def test_the_formula_for_cones_is_left_out_elsewhere() -> None:
    slopes = contact_case("s1002_new", 100e3).slopes
    assert math.isnan(slopes.cap_2000)
    assert all(math.isfinite(slope) for slope in slopes[1:])


@pytest.mark.parametrize(
    ("pair", "load", "told"),
    [
        ("cone_on_head", 0.0, "load"),
        ("cone_on_worn_rail", 100e3, "rectangle, not an ellipse"),
        ("cone_on_haed", 100e3, "did you mean 'cone_on_head'"),
    ],
)
def test_refuses_in_words(pair: str, load: float, told: str) -> None:
    with pytest.raises(RailgripError, match=told):
        contact_case(pair, load)
