"""Distributions: ppf inverts cdf, moments are as asked, impossible ones are refused."""

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError
from scipy import stats

from railgrip.campaign.distributions import Distribution

U = (np.arange(20000) + 0.5) / 20000
ADAPTER = TypeAdapter(Distribution)
BELL = {"kind": "normal", "mean": 0.25, "deviation": 0.06}


def made(**table):
    return ADAPTER.validate_python(table)


@pytest.mark.parametrize(
    ("table", "reference"),
    [
        (BELL, stats.norm(0.25, 0.06)),
        ({"kind": "uniform", "low": 2, "high": 5}, stats.uniform(2, 3)),
        ({"kind": "triangular", "low": 1, "mode": 2, "high": 5}, stats.triang(0.25, 1, 4)),
        (
            {"kind": "lognormal", "mean": 2.0, "deviation": 0.5},
            stats.lognorm(np.sqrt(np.log(1.0625)), scale=2 / np.sqrt(1.0625)),
        ),
        (
            {"kind": "truncated", "of": BELL, "low": 0.2, "high": 0.4},
            stats.truncnorm((0.2 - 0.25) / 0.06, (0.4 - 0.25) / 0.06, 0.25, 0.06),
        ),
    ],
)
def test_quantiles_are_those_of_scipy(table, reference) -> None:
    np.testing.assert_allclose(made(**table).ppf(U), reference.ppf(U), rtol=1e-9)
    np.testing.assert_allclose(made(**table).cdf(reference.ppf(U)), U, rtol=1e-8)


def test_a_mixture_is_between_its_parts_in_the_right_shares() -> None:
    parts = [
        {"weight": 3, "of": {"kind": "uniform", "low": 0, "high": 1}},
        {"weight": 1, "of": {"kind": "uniform", "low": 10, "high": 11}},
    ]
    drawn = made(kind="mixture", parts=parts).ppf(U)
    assert (drawn < 5).mean() == pytest.approx(0.75, abs=1e-4)
    assert drawn.mean() == pytest.approx(0.75 * 0.5 + 0.25 * 10.5, rel=1e-3)


def test_events_and_discrete_values_come_as_often_as_asked() -> None:
    assert made(kind="event", probability="1 %").ppf(U).mean() == pytest.approx(0.01)
    drawn = made(kind="discrete", values=["dry", "wet"], weights=[3, 1]).ppf(U)
    assert (drawn == "wet").mean() == pytest.approx(0.25)


def test_units_come_in_at_the_door() -> None:
    assert made(kind="normal", mean="3.8 bar", deviation="0.05 bar").mean == 3.8e5


@pytest.mark.parametrize(
    "table",
    [
        {"kind": "normal", "mean": 1, "deviation": 0},
        {"kind": "normal", "mean": 1, "deviation": float("nan")},
        {"kind": "lognormal", "mean": -1, "deviation": 1},
        {"kind": "uniform", "low": 2, "high": 2},
        {"kind": "triangular", "low": 0, "mode": 2, "high": 1},
        {"kind": "event", "probability": 1.1},
        {"kind": "discrete", "values": [1, 2], "weights": [1]},
        {"kind": "discrete", "values": [1, 2], "weights": [0, 0]},
        {"kind": "empirical", "values": [1]},
        {"kind": "empirical"},
        {"kind": "truncated", "of": {"kind": "uniform", "low": 0, "high": 1}, "low": 2, "high": 3},
        {"kind": "normel", "mean": 1, "deviation": 1},
    ],
)
def test_impossible_distributions_are_refused(table) -> None:
    with pytest.raises(ValidationError):
        made(**table)
