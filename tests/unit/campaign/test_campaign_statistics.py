"""Statistics of runs: textbook values, and intervals that cover as often as they say."""

import numpy as np
import pytest
from scipy import stats

from railgrip.campaign import statistics as of
from railgrip.campaign.campaign_parts import Until


@pytest.mark.parametrize(("hits", "runs"), [(0, 10), (3, 20), (10, 10), (1, 100_000)])
def test_proportions_have_the_exact_interval(hits, runs) -> None:
    wanted = stats.binomtest(hits, runs).proportion_ci(0.95, "exact")
    found = of.proportion(hits, runs)
    assert found[1:] == pytest.approx((wanted.low, wanted.high), rel=1e-9)


def test_intervals_of_quantiles_and_means_cover_the_truth() -> None:
    """400 samples: with a true cover of .95 fewer than 93 % are improbable (2e-2 two-sided)."""
    generator = np.random.default_rng(11)
    samples = generator.exponential(size=(400, 300))
    for level in (0.5, 0.95):
        truth = -np.log1p(-level)
        found = [of.quantile(sample, level) for sample in samples]
        assert np.mean([one.low <= truth <= one.high for one in found]) > 0.93
    assert np.mean([one.low <= 1.0 <= one.high for one in map(of.mean, samples)]) > 0.91


def test_too_few_runs_tell_no_bound() -> None:
    assert of.quantile(np.arange(50.0), 0.999).high == np.inf
    assert of.mean(np.array([1.0])).high == np.inf


def test_exceedance_and_difference() -> None:
    values = np.arange(1.0, 101.0)
    assert [one.value for one in of.exceedance(values, np.array([0.0, 90.0, 100.0]))] == [
        1.0, 0.1, 0.0,
    ]  # fmt: skip
    shifted = of.difference(values, values + 2.0)
    assert shifted == pytest.approx((2.0, 2.0, 2.0))


def test_bootstrapped_intervals_cover_the_truth() -> None:
    """The difference of two designs' 99 % quantiles over shared draws, known exactly.

    With e exponential the designs give e and 1.5 e + 2: their quantiles differ by 2 + 0.5 ln 100.
    100 samples: with a true cover of .95 fewer than 88 have a probability of 4e-3.
    """
    generator = np.random.default_rng(7)
    truth = 2.0 + 0.5 * np.log(100.0)
    draws = generator.exponential(size=(100, 2000))
    found = [of.quantile_difference(one, 1.5 * one + 2.0, 0.99) for one in draws]
    assert sum(one.low <= truth <= one.high for one in found) >= 88
    apart = generator.exponential(size=2000)
    independent = of.quantile_difference(draws[0], apart, 0.99)
    assert found[0].width < independent.width  # sharing the draws is worth something


def test_the_bootstrap_of_a_mean_is_students_interval_nearly() -> None:
    values = np.random.default_rng(3).normal(10.0, 2.0, 400)
    mean, resampled = of.mean(values), of.bootstrap([values], np.mean)
    assert resampled == pytest.approx(mean, abs=0.03)
    assert of.bootstrap([values[:1]], np.mean).high == np.inf


def test_until_asks_for_mean_quantile_or_exceedance() -> None:
    values = np.append(np.arange(1000.0), np.nan)
    ask = {"figure": "stopping_distance", "width": 1.0}
    assert of.judged(Until(**ask), values).value == pytest.approx(499.5)
    assert of.judged(Until(statistic="quantile", level=0.9, **ask), values).value > 890
    over = Until(statistic="exceedance", threshold="899 m", **ask)
    assert of.judged(over, values).value == pytest.approx(0.1)
