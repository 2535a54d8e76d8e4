"""Sampling: the same numbers in any chunking, evenly spread, strictly inside (0, 1)."""

from itertools import pairwise

import numpy as np
import pytest
from scipy import stats

from railgrip.campaign.sampling import permuted, uniform_numbers

NAMES = ["mass", "speed", "friction"]


@pytest.mark.parametrize("method", ["random", "sobol", "latin"])
def test_a_run_gets_the_same_in_any_chunk(method) -> None:
    whole = uniform_numbers(method, 7, NAMES, 0, 1000, 1000)
    edges = [0, 1, 130, 131, 777, 1000]
    parts = [uniform_numbers(method, 7, NAMES, a, b, 1000) for a, b in pairwise(edges)]
    np.testing.assert_array_equal(np.vstack(parts), whole)
    assert whole.min() > 0.0
    assert whole.max() < 1.0
    for column in whole.T:
        assert stats.kstest(column, "uniform").pvalue > 1e-4
    assert np.abs(np.corrcoef(whole.T) - np.eye(3)).max() < 0.12


def test_a_column_keeps_its_numbers_when_others_come() -> None:
    alone = uniform_numbers("random", 7, ["speed"], 0, 50, 50)
    np.testing.assert_array_equal(uniform_numbers("random", 7, NAMES, 0, 50, 50)[:, 1:2], alone)
    assert (uniform_numbers("random", 8, ["speed"], 0, 50, 50) != alone).all()


def test_a_latin_hypercube_has_one_run_in_each_stratum() -> None:
    numbers = uniform_numbers("latin", 3, NAMES, 0, 501, 501)
    np.testing.assert_array_equal(np.sort((numbers * 501).astype(int), axis=0)[:, 1], range(501))


@pytest.mark.parametrize("n", [1, 2, 3, 16, 17, 1000])
def test_permutations_lose_nothing(n) -> None:
    np.testing.assert_array_equal(
        np.sort(permuted(np.arange(n, dtype=np.uint64), n, 5)), np.arange(n)
    )
