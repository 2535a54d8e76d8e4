"""The contact ellipse against the figures of another program."""

from __future__ import annotations

import math

import pytest

from railgrip.core.formulas.patch import hertz_1882


def test_the_ellipse_is_that_of_the_half_space_program() -> None:
    patch = hertz_1882(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    assert patch.a == pytest.approx(7.191978396e-3, rel=1e-8)
    assert patch.b == pytest.approx(5.409966176e-3, rel=1e-8)
    assert patch.greatest_pressure == pytest.approx(1227.1523e6, rel=5e-8)
