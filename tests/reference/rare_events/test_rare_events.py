"""Rare quantiles against closed distributions; source and tolerance in the README beside."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from railgrip.campaign.rare import cross_checks
from railgrip.campaign.rare.estimate import rare_quantiles
from railgrip.campaign.rare.failures import failure_states

PUBLISHED = (
    .99975, .98289, .94141, .91825, .88657, .85856, .84376, .80208, .78800, .75146,
)  # fmt: skip
SEEDS = range(1, 7)


def _exact() -> ModuleType:
    spec = importlib.util.spec_from_file_location("exact", Path(__file__).parent / "exact.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


EXACT = _exact()


def force(share: Any, spread: float) -> Any:
    return lambda normals, failed: (share * (1.0 + spread * normals) * ~failed).sum(axis=1)


def coverage(found: list[Any], exact: list[float]) -> tuple[float, int]:
    """Share of the 95 % intervals that hold, and seeds in which all simultaneous ones do."""
    each = [[q.low <= k <= q.high for q, k in zip(one.quantile, exact, strict=True)]
            for one in found]  # fmt: skip
    every = [all(q.low_all <= k <= q.high_all for q, k in zip(one.quantile, exact, strict=True))
             for one in found]  # fmt: skip
    return float(np.mean(each)), sum(every)


def test_the_closed_form_is_the_published_one() -> None:
    assert EXACT.quantiles([1 / 16] * 16, [1e-3] * 16, 0.05) == pytest.approx(PUBLISHED, abs=5e-6)


@pytest.mark.parametrize(
    ("n", "q", "c"),
    [(16, 1e-3, 0.05), (8, 1e-2, 0.08), (12, 1.1e-3, 0.03), (4, 1e-4, 0.1), (16, 0.2, 0.05)],
)
def test_equal_units(n: int, q: float, c: float) -> None:
    exact = EXACT.quantiles([1 / n] * n, [q] * n, c)
    states = failure_states([q] * n, ["brake"] * n)
    found = [rare_quantiles(force(1 / n, c), n, states, owner=range(n), runs=6000, seed=seed)
             for seed in SEEDS]  # fmt: skip
    pooled, held = coverage(found, exact)
    assert pooled >= 0.92
    assert held >= len(SEEDS) - 1
    assert all(not one.warnings for one in found)
    widths = [0.5 * (q.high - q.low) for q in found[0].quantile]
    assert max(widths) < 0.01


def test_units_that_all_differ() -> None:
    share = np.linspace(0.5, 1.5, 8) / 8.0
    q = np.geomspace(1e-4, 1e-2, 8)
    exact = EXACT.quantiles(share, q, 0.05)
    states = failure_states(q)
    found = [rare_quantiles(force(share, 0.05), 8, states, seed=seed, owner=range(8))
             for seed in SEEDS]  # fmt: skip
    pooled, held = coverage(found, exact)
    assert pooled >= 0.92
    assert held >= len(SEEDS) - 1


def test_a_gap_between_modes_gets_a_wide_interval() -> None:
    """With a spread of 0.5 % and q so that just 1e-4 have two failed, EBCL 4 lies in the gap."""
    q = 9.1917e-4
    exact = EXACT.quantiles([1 / 16] * 16, [q] * 16, 0.005)
    states = failure_states([q] * 16, ["brake"] * 16)
    found = [rare_quantiles(force(1 / 16, 0.005), 16, states, owner=range(16), seed=seed)
             for seed in SEEDS]  # fmt: skip
    assert coverage(found, exact)[0] >= 0.92
    in_gap = found[0].quantile[4]
    beside = found[0].quantile[3]
    assert in_gap.high - in_gap.low > 4.0 * (beside.high - beside.low)


def test_a_lognormal_factor_bends_the_tail() -> None:
    exact = EXACT.lognormal_quantiles(12, 2e-3, 0.08)
    states = failure_states([2e-3] * 12, [0] * 12)
    found = [
        rare_quantiles(
            lambda u, failed: np.exp(0.08 * u[:, 0]) * (~failed).mean(axis=1), 3, states, seed=seed
        )
        for seed in SEEDS
    ]
    assert coverage(found, exact)[0] >= 0.92


def less_failed(result: Any) -> Any:
    return lambda normals, failed: result(normals) - failed.mean(axis=1)


@pytest.mark.parametrize("spreads", [(0.03, 0.04, 0.06), (0.05,) * 4])
def test_the_least_of_several_quantities(spreads: tuple[float, ...]) -> None:
    """Falls in as many directions as there are quantities; every level is resolved."""
    n = len(spreads)
    exact = EXACT.of_units(8, 1e-3, EXACT.least_of([1.0] * n, spreads))
    model = less_failed(lambda u: np.min(1.0 + np.array(spreads) * u, axis=1))
    states = failure_states([1e-3] * 8, [0] * 8)
    found = [rare_quantiles(model, n, states, seed=seed, runs=9000) for seed in SEEDS]
    pooled, held = coverage(found, exact)
    assert pooled >= 0.92
    assert held >= len(SEEDS) - 1
    assert all(not one.warnings for one in found)
    assert max(q.high - q.low for one in found for q in one.quantile) < 0.03


def test_too_much_is_as_bad_as_too_little() -> None:
    exact = EXACT.of_units(4, 1e-3, EXACT.two_sided(0.1 / 8**0.5))
    model = less_failed(lambda u: 1.0 - 0.1 * np.abs(u.mean(axis=1)))
    states = failure_states([1e-3] * 4, [0] * 4)
    found = [rare_quantiles(model, 8, states, seed=seed) for seed in SEEDS]
    pooled, held = coverage(found, exact)
    assert pooled >= 0.92
    assert held >= len(SEEDS) - 1
    assert all(not one.warnings for one in found)


def test_weights_of_several_directions_are_exact() -> None:
    """Whatever the directions, weights add up to that of half-spaces and their union."""
    from scipy.stats import norm

    states = failure_states([0.0])
    found = rare_quantiles(
        less_failed(lambda u: np.min(1.0 + 0.05 * u, axis=1)), 3, states, runs=50_000
    )
    sample = found.sample
    p = float(norm.sf(5.0))
    below = sample.normals < -5.0
    assert sample.weight[below.any(axis=1)].sum() == pytest.approx(1.0 - (1.0 - p) ** 3, rel=0.05)
    assert sample.weight[below[:, 0]].sum() == pytest.approx(p, rel=0.05)


def test_several_directions_are_not_passed_over_in_silence() -> None:
    states = failure_states([1e-3] * 4, [0] * 4)
    found = rare_quantiles(
        lambda u, failed: 1.0 - 0.01 * (u**2).sum(axis=1) - failed.mean(axis=1), 3, states
    )
    assert any("not resolved" in one for one in found.warnings)
    assert any(not np.isfinite(q.low) for q in found.quantile)


def test_other_methods_agree_at_a_millionth() -> None:
    """Cross-entropy 15 %, subset simulation 35 %: their errors as they truly are.

    The stated ones are 2 and 5 %; they do not hold.
    """
    n, c = 8, 0.05
    states = failure_states([1e-3] * n, [0] * n)
    bound = EXACT.quantiles([1 / n] * n, [1e-3] * n, c)[6]
    entropy = cross_checks.cross_entropy(force(1 / n, c), n, states, bound)
    subset = cross_checks.subset_simulation(force(1 / n, c), n, states, bound)
    assert entropy.probability == pytest.approx(1e-6, rel=0.15)
    assert subset.probability == pytest.approx(1e-6, rel=0.35)


def test_brute_force_agrees_at_a_thousandth() -> None:
    n, c = 16, 0.05
    states = failure_states([1e-3] * n, [0] * n)
    plain = cross_checks.brute_force(force(1 / n, c), n, states, PUBLISHED[3], runs=200_000)
    assert abs(plain.probability - 1e-3) < 4.0 * plain.error
