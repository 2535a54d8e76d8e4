"""GMRES of our own against a direct solution."""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.laboratory.krylov import gmres, length


@pytest.mark.parametrize("seed", range(5))
def test_it_solves_what_a_direct_solver_solves(seed: int) -> None:
    chance = np.random.default_rng(seed)
    matrix = np.eye(40) + 0.3 * chance.normal(size=(40, 40)) / np.sqrt(40)
    wanted = chance.normal(size=(8, 5))
    found = gmres(
        lambda x: (matrix @ x.ravel()).reshape(8, 5), lambda x: 0.7 * x, wanted, 1e-12, 40
    )
    np.testing.assert_allclose(found.ravel(), np.linalg.solve(matrix, wanted.ravel()), rtol=1e-9)


def test_it_stops_where_it_is_told() -> None:
    weights = np.linspace(1.0, 100.0, 50)
    calls: list[int] = []

    def product(x: np.ndarray) -> np.ndarray:
        calls.append(1)
        return weights * x

    rough = gmres(product, lambda x: x, np.ones(50), 1e-2, 50)
    assert 5 < len(calls) < 50
    assert length(weights * rough - 1.0) <= 1.01e-2 * length(np.ones(50))
    gmres(product, lambda x: x, np.ones(50), 1e-12, 3)


def test_nothing_wanted_is_nothing() -> None:
    assert not gmres(lambda x: x, lambda x: x, np.zeros((2, 3)), 1e-9, 5).any()


@pytest.mark.parametrize("size", [1e-300, 1e-12, 1.0, 1e300])
def test_length_of_any_size(size: float) -> None:
    assert length(np.full((2, 2), size)) == pytest.approx(2.0 * size, rel=1e-12)
