"""Creepage coefficients between the nodes of Kalker's table."""

from __future__ import annotations

import math

import pytest

from railgrip.contact.kalker_1990 import kalker_coefficients
from railgrip.core.formulas.patch import hertz_1882


def test_the_coefficients_of_the_base_case() -> None:
    patch = hertz_1882(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    found = kalker_coefficients(patch.a, patch.b, 0.28)
    assert found.c11 == pytest.approx(4.550468, abs=1e-6)
    assert found.c22 == pytest.approx(4.142824, abs=1e-6)
    assert found.c23 == pytest.approx(1.868973, abs=1e-6)
    assert found.c33 == pytest.approx(0.9937, abs=1e-4)
    assert found.c11 == pytest.approx(4.554, abs=0.01)


def test_a_node_of_the_table_is_met_exactly() -> None:
    assert kalker_coefficients(1.0, 1.0, 0.25) == pytest.approx((4.12, 3.67, 1.47, 1.19))
    assert kalker_coefficients(0.5, 1.0, 0.0) == pytest.approx((2.88, 2.88, 0.827, 1.74))
    assert kalker_coefficients(5.0, 1.0, 0.5) == pytest.approx((8.82, 9.79, 7.89, 0.341))
