"""Slope over the place of contact: the scalar contact at each place, NaN where there is none."""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.contact.s1002_contact import s1002_contact
from railgrip.contact.surface_stiffness import SURFACE_STIFFNESS, stiffness_slope
from railgrip.core.errors import RailgripError
from railgrip.laboratory.slope_over_shift import slope_over_shift


def test_each_place_is_the_contact_there() -> None:
    places = np.array([-1e-3, 0.0, 3e-3, 8e-3, 20e-3, 50e-3, -0.045])
    found = slope_over_shift(places, 100e3, 0.46, 0.3)
    for index, place in enumerate(places):
        contact = s1002_contact(100e3, 0.46, float(place), 0.3, 210e9, 0.28)
        assert (found.a[index], found.b[index]) == (contact.a, contact.b)
        assert found.slope_by_kalker[index] == pytest.approx(
            contact.shear_modulus * contact.a * contact.b * contact.c11
        )
        assert found.slope_by_stiffness[index] == pytest.approx(
            stiffness_slope(contact.a, contact.b, SURFACE_STIFFNESS)
        )


def test_no_solution_is_no_number_but_the_profile_is_known() -> None:
    places = np.linspace(-0.070, 0.060, 1301)
    found = slope_over_shift(places, 100e3, 0.46, 0.3)
    hollow = np.isnan(found.a)
    tread = places > -0.03842
    assert hollow[tread].sum() == 372  # -38.4 <= y <= -1.3 mm in steps of 0.1 mm
    assert hollow[0]  # the back of the flange is vertical
    assert not hollow[~tread][1:].any()
    assert np.isfinite(found.conicity[1:]).all()
    assert not np.isnan(found.transverse_radius).any()
    for values in (found.b, found.slope_by_stiffness, found.slope_by_kalker):
        assert (np.isnan(values) == hollow).all()


def test_towards_the_hollow_the_ellipse_widens_and_the_slope_rises() -> None:
    places = np.linspace(-1.2e-3, 13e-3, 50)
    found = slope_over_shift(places, 100e3, 0.46, 0.3)
    assert (np.diff(found.b) < 0.0).all()
    assert (np.diff(found.slope_by_kalker) < 0.0).all()


@pytest.mark.parametrize(
    ("places", "load", "wheel", "head", "sentence"),
    [
        ([0.07], 1e5, 0.46, 0.3, "off the profile"),
        ([float("nan")], 1e5, 0.46, 0.3, "off the profile"),
        ([-0.02], -1e5, 0.46, 0.3, "load must be positive"),
        ([0.0], 1e5, 0.0, 0.3, "wheel radius"),
        ([0.0], 1e5, 0.46, -0.3, "radius of the rail head"),
    ],
)
def test_impossible_input_gets_a_sentence(
    places: list[float], load: float, wheel: float, head: float, sentence: str
) -> None:
    with pytest.raises(RailgripError, match=sentence):
        slope_over_shift(places, load, wheel, head)
