"""The exact step of the relaxation, against fifty digits."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.relaxation import relaxation_length, relaxation_step

ROLLED = st.floats(1e-9, 200.0)


@given(ROLLED)
def test_the_weights_are_the_exact_ones(rolled: float) -> None:
    with localcontext() as digits:
        digits.prec = 50
        h = Decimal(rolled)
        kept = (-h).exp()
        mean = (1 - kept) / h
        exact = [float(kept), float(mean - kept), float(1 - mean)]
    assert list(relaxation_step(rolled)) == pytest.approx(exact, rel=2e-12)


@given(st.just(0.0) | ROLLED)
def test_the_weights_add_up_to_one(rolled: float) -> None:
    step = relaxation_step(rolled)
    assert sum(step) == pytest.approx(1.0, rel=1e-14)
    assert min(step) >= 0.0


def test_nothing_rolled_keeps_the_force_and_an_endless_way_forgets_it() -> None:
    assert relaxation_step(0.0) == (1.0, 0.0, 0.0)
    assert relaxation_step(math.inf) == (0.0, 0.0, 1.0)


def test_two_half_steps_on_a_straight_line_are_one_step() -> None:
    half, whole = relaxation_step(0.35), relaxation_step(0.7)
    first, last, start = 2.0, 5.0, -1.0
    middle = half.kept * start + half.before * first + half.after * 3.5
    twice = half.kept * middle + half.before * 3.5 + half.after * last
    once = whole.kept * start + whole.before * first + whole.after * last
    assert twice == pytest.approx(once, rel=1e-14)


def test_the_length_of_the_base_case() -> None:
    assert relaxation_length(7.191978396e-3) == pytest.approx(6.1048e-3, rel=1e-4)
