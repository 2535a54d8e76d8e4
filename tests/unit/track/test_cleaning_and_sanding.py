"""Cleaning and sanding: limits, monotony, and the same bits plain or compiled."""

from __future__ import annotations

from collections.abc import Callable

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.compiler import inlined
from railgrip.track.cleaning import blended, left_contaminant
from railgrip.track.random_field import lognormal_factor, next_field_value, standard_normal
from railgrip.track.sanding import sanded_friction

FRICTION = st.floats(0.0, 1.0)


@given(energy=st.floats(0.0, 1e6), more=st.floats(0.0, 1e5), rate=st.floats(0.0, 1e-3))
def test_cleaning_only_cleans(energy: float, more: float, rate: float) -> None:
    left = left_contaminant(energy, rate)
    assert 0.0 <= left_contaminant(energy + more, rate) <= left <= 1.0


def test_cleaning_as_published() -> None:
    """λ = 1 − exp(−τ W): 8 kN at 20 % slip are 1 600 J/m, λ = 0.262 (Florence model)."""
    assert 1 - left_contaminant(8e3 * 0.2, 1.9e-4) == pytest.approx(0.262, abs=5e-4)
    assert left_contaminant(1e9, 0.0) == 1.0


@given(clean=FRICTION, contaminated=FRICTION, left=st.floats(0.0, 1.0))
def test_a_blend_lies_between(clean: float, contaminated: float, left: float) -> None:
    found = blended(clean, contaminated, left)
    low, high = sorted((clean, contaminated))
    assert low - 1e-12 <= found <= high + 1e-12


@given(friction=FRICTION, sand=st.floats(0.0, 1.0), most=FRICTION, effective=st.floats(1e-4, 1.0))
def test_sand_never_makes_slippery(
    friction: float, sand: float, most: float, effective: float
) -> None:
    found = sanded_friction(friction, sand, most, effective)
    assert friction <= found <= max(friction, most) + 1e-12
    assert sanded_friction(friction, 0.0, most, effective) == friction


LAWS: list[tuple[Callable[..., float], tuple[float, ...]]] = [
    (left_contaminant, (1e5, 1e-3)),
    (blended, (1.0, 1.0, 1.0)),
    (sanded_friction, (1.0, 0.02, 0.3, 0.01)),
    (next_field_value, (3.0, 1.0, 3.0)),
    (lognormal_factor, (3.0, 1.0)),
]


@pytest.mark.parametrize(("law", "highs"), LAWS, ids=lambda value: getattr(value, "__name__", ""))
def test_plain_and_compiled_agree(law: Callable[..., float], highs: tuple[float, ...]) -> None:
    compiled = inlined(law)
    driver = numba.njit(error_model="numpy")(lambda *inputs: compiled(*inputs))
    generator = np.random.default_rng(7)
    points = generator.uniform(1e-6, highs, (300, len(highs))).tolist()
    found = np.array([driver(*point) for point in points])
    assert found.tobytes() == np.array([law(*point) for point in points]).tobytes()


def test_plain_and_compiled_normals_agree() -> None:
    compiled = inlined(standard_normal)
    driver = numba.njit(error_model="numpy")(lambda *inputs: compiled(*inputs))
    for cell in range(200):
        for seed in (1, 2**33 + 1, 2**62 + 5):
            assert driver(cell, 3, 1, seed) == standard_normal(cell, 3, 1, seed)
