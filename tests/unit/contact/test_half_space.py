"""The loaded rectangle against integration of the point load."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import dblquad

from railgrip.contact.half_space import Influence, rectangle_influence

PLACES = st.floats(-20.0, 20.0)
SIDES = st.floats(0.05, 5.0)
RATIOS = st.floats(0.0, 0.5)


def point_load(x: float, y: float, poisson: float) -> Influence:
    r = math.hypot(x, y)
    stiff = (1.0 - poisson) / r
    bend = poisson / r**3
    return Influence(stiff + bend * x * x, bend * x * y, stiff + bend * y * y, stiff)


@pytest.mark.parametrize("place", [(1.3, -0.4), (-0.8, 0.9), (3.0, 2.0)])
def test_the_rectangle_is_the_sum_of_its_points(place: tuple[float, float]) -> None:
    x, y = place
    found = rectangle_influence(x, y, 1.0, 0.7, 0.28)
    for name in Influence._fields:
        wanted, _ = dblquad(
            lambda v, u, name=name: getattr(point_load(x - u, y - v, 0.28), name),
            -0.5,
            0.5,
            -0.35,
            0.35,
            epsrel=1e-9,
        )
        assert getattr(found, name) == pytest.approx(wanted, rel=1e-6)


@given(PLACES, PLACES, SIDES, SIDES, RATIOS)
def test_symmetries(x: float, y: float, dx: float, dy: float, poisson: float) -> None:
    here = rectangle_influence(x, y, dx, dy, poisson)
    mirrored = rectangle_influence(x, -y, dx, dy, poisson)
    turned = rectangle_influence(y, x, dy, dx, poisson)
    size = here.xx
    assert mirrored.xx == pytest.approx(here.xx, abs=1e-9 * size)
    assert mirrored.xy == pytest.approx(-here.xy, abs=1e-9 * size)
    assert (turned.xx, turned.yy) == pytest.approx((here.yy, here.xx), abs=1e-9 * size)
    assert turned.xy == pytest.approx(here.xy, abs=1e-9 * size)
    assert min(here.xx, here.yy, here.zz) > 0.0


@given(st.floats(0.0, 2 * math.pi), RATIOS)
def test_from_afar_it_is_a_point(angle: float, poisson: float) -> None:
    x, y = 300.0 * math.cos(angle), 300.0 * math.sin(angle)
    found = rectangle_influence(x, y, 1.0, 2.0, poisson)
    wanted = [2.0 * each for each in point_load(x, y, poisson)]
    assert list(found) == pytest.approx(wanted, abs=1e-4 * wanted[0])


def test_over_a_corner_it_is_finite() -> None:
    assert rectangle_influence(0.5, 0.5, 1.0, 1.0, 0.3).xx == pytest.approx(
        0.25 * rectangle_influence(0.0, 0.0, 2.0, 2.0, 0.3).xx
    )
