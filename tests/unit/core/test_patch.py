"""The contact ellipse: limits, symmetry, and the equations it must satisfy."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import elliprd, elliprf

from railgrip.core.errors import RailgripError
from railgrip.core.formulas.patch import hertz_1882

STEEL = (210e9, 0.28)
RADII = st.floats(0.05, 20.0)


def test_a_ball_on_a_plane_has_a_circle() -> None:
    patch = hertz_1882(1e3, 0.5, 0.5, math.inf, *STEEL)
    modulus = 210e9 / (2.0 * (1.0 - 0.28**2))
    radius = (0.75 * 1e3 * 0.5 / modulus) ** (1.0 / 3.0)
    assert patch.a == pytest.approx(radius, rel=1e-12)
    assert patch.b == pytest.approx(radius, rel=1e-12)
    assert patch.approach == pytest.approx(radius**2 / 0.5, rel=1e-12)


@given(RADII, RADII)
def test_the_ellipse_satisfies_its_equations(wheel: float, rail: float) -> None:
    """Curvatures and approach recovered from a, b, p0 by Carlson's integrals."""
    patch = hertz_1882(1e5, wheel, math.inf, rail, *STEEL)
    modulus = 210e9 / (2.0 * (1.0 - 0.28**2))
    a2, b2 = patch.a**2, patch.b**2
    scale = 0.5 * patch.a * patch.b * patch.greatest_pressure / modulus
    along = scale * elliprd(0.0, b2, a2) / 3.0
    across = scale * elliprd(0.0, a2, b2) / 3.0
    assert along == pytest.approx(0.25 / wheel, rel=1e-10)
    assert across == pytest.approx(0.25 / rail, rel=1e-10)
    assert patch.approach == pytest.approx(2.0 * scale * elliprf(0.0, a2, b2), rel=1e-10)


@given(RADII, RADII)
def test_wheel_and_rail_change_places(wheel: float, rail: float) -> None:
    here = hertz_1882(1e5, wheel, math.inf, rail, *STEEL)
    there = hertz_1882(1e5, rail, math.inf, wheel, *STEEL)
    assert (here.a, here.b) == pytest.approx((there.b, there.a), rel=1e-10)


@given(st.floats(1.0, 1e6))
def test_the_size_grows_with_the_cube_root_of_the_load(load: float) -> None:
    one = hertz_1882(1.0, 0.46, math.inf, 0.3, *STEEL)
    many = hertz_1882(load, 0.46, math.inf, 0.3, *STEEL)
    assert many.a == pytest.approx(one.a * math.cbrt(load), rel=1e-12)
    assert many.b == pytest.approx(one.b * math.cbrt(load), rel=1e-12)


def test_a_hollow_tread_widens_the_patch() -> None:
    cone = hertz_1882(1e5, 0.46, math.inf, 0.3, *STEEL)
    hollow = hertz_1882(1e5, 0.46, -0.32, 0.3, *STEEL)
    assert hollow.b > 3.0 * cone.b


@pytest.mark.parametrize(
    ("radii", "sentence"),
    [
        ((0.46, -0.2142, 0.3), "do not touch in one point"),
        ((0.46, math.inf, math.inf), "do not touch in one point"),
        ((0.46, 0.0, 0.3), "transverse radius of the wheel"),
        ((0.46, 0.3, math.nan), "transverse radius of the rail"),
        ((-0.46, math.inf, 0.3), "wheel radius must be positive"),
    ],
)
def test_impossible_profiles_get_a_sentence(
    radii: tuple[float, float, float], sentence: str
) -> None:
    with pytest.raises(RailgripError, match=sentence):
        hertz_1882(1e5, *radii, *STEEL)


@pytest.mark.parametrize(
    ("load", "young", "poisson", "sentence"),
    [
        (0.0, 210e9, 0.28, "load must be positive"),
        (math.nan, 210e9, 0.28, "load must be positive"),
        (1e5, -1.0, 0.28, "Young's modulus"),
        (1e5, 210e9, 0.6, "Poisson's ratio"),
    ],
)
def test_impossible_loads_and_materials_get_a_sentence(
    load: float, young: float, poisson: float, sentence: str
) -> None:
    with pytest.raises(RailgripError, match=sentence):
        hertz_1882(load, 0.46, math.inf, 0.3, young, poisson)
