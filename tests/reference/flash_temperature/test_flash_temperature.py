"""Flash temperature of a fast strip: profile, constants, and Ertz's case."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from railgrip.core.formulas.flash_temperature import (
    FASTEST_RISE,
    STEEL_ERTZ_2002,
    effusivity,
    fast_rise,
)
from railgrip.laboratory.contact_temperature import surface_temperatures
from railgrip.laboratory.heat_profiles import (
    parabolic_profile,
    semi_elliptic_profile,
    uniform_profile,
)
from railgrip.laboratory.sliding_contact import SlidingContact

HERE = Path(__file__).parent
ROWS = [
    (float(row["x_over_a"]), float(row["integral"]))
    for row in csv.DictReader(
        line
        for line in (HERE / "profile.csv").read_text("utf-8").splitlines()
        if not line.startswith("#")
    )
]
ERTZ = {"load": 100e3, "a": 5.88e-3, "b": 10.54e-3, "friction": 0.3}
RISE, PLACE = 150.297, 0.6522


@pytest.mark.parametrize(("place", "integral"), ROWS)
def test_the_profile_in_and_behind_the_patch(place: float, integral: float) -> None:
    assert float(semi_elliptic_profile(place)) == pytest.approx(integral, rel=1e-7, abs=1e-8)


@pytest.mark.parametrize(
    ("profile", "place", "greatest"),
    [
        (uniform_profile, 1.0, 2.0 * math.sqrt(2.0)),
        (parabolic_profile, 0.5, 1.959592),
        (semi_elliptic_profile, 0.65223, 2.188307),
    ],
)
def test_where_and_how_hot_it_gets(profile: object, place: float, greatest: float) -> None:
    found = minimize_scalar(
        lambda x: -float(profile(x)), bounds=(-1.0, 1.0 + 1e-9), method="bounded",
        options={"xatol": 1e-9},
    )  # fmt: skip
    assert -found.fun == pytest.approx(greatest, rel=1e-5)
    assert found.x == pytest.approx(place, abs=1e-4)


def test_the_exit_of_a_semi_elliptic_source() -> None:
    assert float(semi_elliptic_profile(1.0)) == pytest.approx(1.885618, abs=1e-6)
    assert pytest.approx(2.188307 / math.sqrt(math.pi), rel=1e-6) == FASTEST_RISE


def test_ertz_case_by_formula_and_by_profile() -> None:
    contact = SlidingContact(**ERTZ, wheel_speed=30.0, train_speed=30.0)
    flux = 0.3 * 1.5 * 100e3 / (math.pi * 5.88e-3 * 10.54e-3)  # slip 1 m/s
    beta = effusivity(STEEL_ERTZ_2002)
    assert fast_rise(0.5, flux, 5.88e-3, 30.0, beta) == pytest.approx(RISE, rel=1e-5)
    # half a metre per second faster and slower: the slip is 1 m/s, the mean speed 30 m/s
    sliding = SlidingContact(**ERTZ, wheel_speed=30.5, train_speed=29.5)
    assert sliding.flash().rise == pytest.approx(RISE, rel=1e-4)
    places = np.linspace(0.6, 0.7, 1001)
    hot = surface_temperatures(sliding, places * contact.a).rail - 20.0
    assert hot.max() == pytest.approx(RISE, rel=1e-4)
    assert places[hot.argmax()] == pytest.approx(PLACE, abs=2e-4)
