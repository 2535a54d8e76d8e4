from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from railgrip.campaign.rare.estimate import rare_quantiles
from railgrip.campaign.rare.failures import failure_states
from railgrip.core.errors import RailgripError

chances = st.lists(st.floats(0.0, 1.0), max_size=7)


@given(chances)
def test_all_states_together_are_certain(q: list[float]) -> None:
    states = failure_states(q)
    assert states.weight.sum() + states.left_out == pytest.approx(1.0, abs=1e-12)
    assert np.all(states.failed.sum(axis=1) == states.n_failed)


@given(st.integers(0, 6), st.integers(0, 6), st.floats(0.0, 0.9), st.floats(0.0, 0.9))
def test_kinds_sum_what_is_alike(a: int, b: int, p: float, q: float) -> None:
    """The probability of each number of failed units is that of the single states."""
    one_by_one = failure_states([p] * a + [q] * b, negligible=0.0)
    by_kind = failure_states([p] * a + [q] * b, ["a"] * a + ["b"] * b, negligible=0.0)
    for n in range(a + b + 1):
        single = one_by_one.weight[one_by_one.n_failed == n].sum()
        assert by_kind.weight[by_kind.n_failed == n].sum() == pytest.approx(single, abs=1e-12)
    assert len(by_kind.weight) <= (a + 1) * (b + 1)


@settings(max_examples=8, deadline=None)
@given(st.floats(0.1, 10.0), st.floats(-5.0, 5.0))
def test_quantiles_follow_a_change_of_scale(scale: float, shift: float) -> None:
    states = failure_states([1e-3] * 4, [0] * 4)

    def model(normals, failed):  # type: ignore[no-untyped-def]
        return ((1.0 + 0.05 * normals) * ~failed).mean(axis=1)

    plain = rare_quantiles(model, 4, states, runs=1000)
    moved = rare_quantiles(lambda u, f: shift + scale * model(u, f), 4, states, runs=1000)
    for a, b in zip(plain.quantile, moved.quantile, strict=True):
        assert abs(b.value - (shift + scale * a.value)) < 0.02 * scale


def test_same_seed_same_bits() -> None:
    states = failure_states([1e-3] * 4, [0] * 4)
    one, two = (
        rare_quantiles(lambda u, f: ((1 + 0.05 * u) * ~f).mean(axis=1), 4, states, runs=500, seed=3)
        for _ in range(2)
    )
    assert one.quantile == two.quantile


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: failure_states([0.1, 1.2]), "must lie between 0 and 1; got 1.2"),
        (lambda: failure_states([0.1, float("nan")]), "must lie between 0 and 1; got nan"),
        (lambda: failure_states([0.1, 0.2], ["a", "a"]), "must fail with one probability"),
        (lambda: failure_states([0.1], ["a", "b"]), "needs one label for each unit"),
        (lambda: failure_states([0.3] * 40), "give units that are alike the same kind"),
        (lambda: rare_quantiles(len, 0, failure_states([])), "must be at least 1; got 0"),
        (lambda: rare_quantiles(len, 1, failure_states([]), runs=3), "runs: must be at least 500"),
        (lambda: rare_quantiles(len, 1, failure_states([]), probabilities=[0.0]), "must lie"),
        (lambda: rare_quantiles(lambda u, f: u[:, 0] / 0.0, 1, failure_states([])), "not finite"),
    ],
)  # fmt: skip
def test_bad_input_is_answered_in_a_sentence(call, sentence: str) -> None:  # type: ignore[no-untyped-def]
    with np.errstate(all="ignore"), pytest.raises(RailgripError) as error:
        call()
    assert sentence in str(error.value)
