"""Factors of the ellipse against the classic table, and against SciPy's elliptic integrals."""

from __future__ import annotations

import math

import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from railgrip.contact.hertz_factors import HertzFactors, hertz_factors

TABLE = [
    (30, 2.731, 0.493),
    (35, 2.397, 0.530),
    (40, 2.136, 0.567),
    (45, 1.926, 0.604),
    (50, 1.754, 0.641),
    (55, 1.611, 0.678),
    (60, 1.486, 0.717),
    (65, 1.378, 0.759),
    (70, 1.284, 0.802),
    (75, 1.202, 0.846),
    (80, 1.128, 0.893),
    (85, 1.061, 0.944),
    (90, 1.000, 1.000),
]


def factors_at(degrees: float) -> HertzFactors:
    cosine = math.cos(math.radians(degrees))
    return hertz_factors(1.0 - cosine, 1.0 + cosine)


@pytest.mark.parametrize(("degrees", "long", "short"), TABLE)
def test_the_classic_table(degrees: float, long: float, short: float) -> None:
    found = factors_at(degrees)
    assert math.degrees(found.angle) == pytest.approx(degrees, abs=1e-6)
    assert found.long == pytest.approx(long, abs=0.0023)
    assert found.short == pytest.approx(short, abs=0.0023)


@pytest.mark.parametrize("degrees", [5.0, 20.0, 45.0, 75.5, 89.0])
def test_the_transcendental_equation(degrees: float) -> None:
    cosine = math.cos(math.radians(degrees))

    def excess(square: float) -> float:
        k, e = ellipk(1.0 - square), ellipe(1.0 - square)
        return float(square * (k - e) / (e - square * k) - (1.0 - cosine) / (1.0 + cosine))

    square = brentq(excess, 1e-12, 1.0 - 1e-9, xtol=1e-15, rtol=1e-14)
    long = float(2.0 * ellipe(1.0 - square) / (math.pi * square)) ** (1.0 / 3.0)
    found = factors_at(degrees)
    assert found.long == pytest.approx(long, rel=1e-10)
    assert found.short == pytest.approx(long * math.sqrt(square), rel=1e-10)
