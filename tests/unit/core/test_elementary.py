"""The polynomials against the C library."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.core.formulas.elementary import arctangent, exp_decay, power_0_8, power_2_3


@given(st.floats(0.0, 64.0))
def test_exp_decay_within_its_bound(x: float) -> None:
    assert exp_decay(x) == pytest.approx(math.exp(-x), rel=1e-13)


@given(st.floats(64.0, math.inf))
def test_exp_decay_ends_at_64(x: float) -> None:
    assert exp_decay(x) == exp_decay(64.0)


def test_exp_decay_starts_at_one() -> None:
    assert exp_decay(0.0) == 1.0


@given(st.floats(allow_nan=False))
def test_arctangent_within_its_bound_and_odd(x: float) -> None:
    assert arctangent(x) == pytest.approx(math.atan(x), abs=5e-16)
    assert arctangent(-x) == -arctangent(x)


@given(st.floats(-5.0, 5.0))
def test_arctangent_over_its_joints(x: float) -> None:
    assert arctangent(x) == pytest.approx(math.atan(x), abs=5e-16)


@given(st.floats(-1e-3, 1e-3))
def test_arctangent_keeps_small_arguments(x: float) -> None:
    assert arctangent(x) == pytest.approx(math.atan(x), rel=1e-15, abs=0.0)


@given(st.floats(1e-4, 125.0))
def test_power_within_its_bound(x: float) -> None:
    assert power_0_8(x) == pytest.approx(x**0.8, rel=5e-7)


@given(st.floats(0.0, 1e-4))
def test_power_near_zero_is_small_and_harmless(x: float) -> None:
    assert 0.0 <= power_0_8(x) < 1e-3


def test_power_of_nothing() -> None:
    assert power_0_8(0.0) == power_0_8(-1.0) == 0.0


@given(st.floats(1 / 16, 4.0))
def test_power_2_3_within_its_bound(x: float) -> None:
    assert power_2_3(x) == pytest.approx(x ** (2 / 3), rel=2e-6)


@given(st.floats(0.0, 1 / 16))
def test_power_2_3_below_its_interval_is_harmless(x: float) -> None:
    assert 0.0 <= power_2_3(x) < (1 / 16) ** (2 / 3) + 1e-3
