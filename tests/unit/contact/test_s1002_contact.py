"""S1002 on a rail head: radii, and the sentence where Hertz has no solution."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.rolling_contact import rolling_contact
from railgrip.contact.s1002 import s1002
from railgrip.contact.s1002_contact import s1002_contact, s1002_radii
from railgrip.core.errors import RailgripError


@given(st.floats(-1.2e-3, 0.06))
def test_from_minus_1_2_mm_outwards_there_is_a_contact(position: float) -> None:
    contact = s1002_contact(100e3, 0.46, position, 0.3, 210e9, 0.28)
    assert 0.0 < contact.a < 0.02
    assert contact.b > 0.0


@given(st.floats(-0.0384, -1.24e-3))
def test_from_minus_1_23_mm_to_the_flange_there_is_none(position: float) -> None:
    with pytest.raises(RailgripError, match="Hertz has no solution"):
        s1002_contact(100e3, 0.46, position, 0.3, 210e9, 0.28)


def test_the_sentence_names_place_radii_and_cure() -> None:
    with pytest.raises(RailgripError) as caught:
        s1002_contact(100e3, 0.46, -8e-3, 0.3, 210e9, 0.28)
    assert str(caught.value) == (
        "S1002 at y = -8 mm is concave with 214.2 mm, Hertz has no solution on a rail; "
        "got rail head of radius 300 mm; allowed: a rail head of radius 0 … 214.2 mm; "
        "try: a place further towards the field side, where the tread is flatter, "
        "or a rounder rail head"
    )


def test_straight_and_convex_places_are_named_so() -> None:
    with pytest.raises(RailgripError, match="is straight, Hertz has no solution"):
        s1002_contact(100e3, 0.46, 0.05, -0.3, 210e9, 0.28)
    with pytest.raises(RailgripError, match=r"is convex with 20\.0 mm"):
        s1002_contact(100e3, 0.46, -0.045, -0.01, 210e9, 0.28)


def test_the_radius_along_is_the_distance_to_the_axis_along_the_normal() -> None:
    position = -0.039
    point, radii = s1002(position), s1002_radii(0.46, position)
    angle = math.atan(point.slope)
    assert radii.along == pytest.approx((0.46 + point.height) / math.cos(angle))
    assert radii.across == math.inf


def test_it_is_the_rolling_contact_of_its_radii() -> None:
    radii = s1002_radii(0.46, 0.008)
    assert s1002_contact(100e3, 0.46, 0.008, 0.3, 210e9, 0.28) == rolling_contact(
        100e3, *radii, 0.3, 210e9, 0.28
    )
    assert radii.along == pytest.approx(0.46, rel=5e-4)


@pytest.mark.parametrize(
    ("load", "wheel", "position", "head", "sentence"),
    [
        (-1e3, 0.46, 0.0, 0.3, "load must be positive"),
        (0.0, 0.46, 0.0, 0.3, "load must be positive"),
        (1e5, -0.46, 0.0, 0.3, "wheel radius must be positive"),
        (1e5, 0.46, 0.07, 0.3, "off the profile S1002"),
        (1e5, 0.46, 0.0, 0.0, "transverse radius of the rail must not be zero"),
        (1e5, 0.46, 0.0, math.nan, "transverse radius of the rail must not be zero or NaN"),
    ],
)
def test_impossible_contacts_get_a_sentence(
    load: float, wheel: float, position: float, head: float, sentence: str
) -> None:
    with pytest.raises(RailgripError, match=sentence):
        s1002_contact(load, wheel, position, head, 210e9, 0.28)
