"""The random rail as the wheels meet it: mean, spread, correlation, and its seed.

A field over N cells of length d with correlation length c has about N d/(2 c) independent values.
The bounds are four standard errors of that many: a right field fails one run in 16 000, and the
seed is fixed.
"""

from __future__ import annotations

import numpy as np
import pytest
from tests.conftest import Coach

import railgrip as rg

MEAN, SPREAD, CORRELATION = 0.08, 0.024, 10.0
SPEED, TIME = 40.0, 1000.0


def long_way(coach: Coach, **field: float) -> rg.Scenario:
    """Forty kilometres of rail under a train that coasts."""
    given = {"mean": MEAN, "spread": SPREAD, "correlation_length": CORRELATION, **field}
    scenario = coach(0.3, speed=SPEED, demand="none", time_limit=TIME, trace=10.0)
    return scenario.with_(rail={"random": given})


def friction(scenario: rg.Scenario) -> tuple[np.ndarray, float]:
    """Return the friction of every cell before the train, and the cells' length."""
    result = rg.simulate(scenario)
    cells = result.data["cell"].values
    return result["rail_friction_before"].values[0][:-4], float(cells[1] - cells[0])


def test_mean_spread_and_correlation(coach: Coach) -> None:
    rail, cell = friction(long_way(coach))
    assert len(rail) * cell > 0.9 * SPEED * TIME
    independent = len(rail) * cell / (2 * CORRELATION)
    assert rail.mean() == pytest.approx(MEAN, abs=4 * SPREAD / independent**0.5)
    # the logarithm is normal: its variance is known to sqrt(2/independent)
    logs = np.log(rail)
    variance = np.log(1 + (SPREAD / MEAN) ** 2)
    assert logs.var() == pytest.approx(variance, rel=4 * (2 / independent) ** 0.5)
    skewness = float(((logs - logs.mean()) ** 3).mean() / logs.std() ** 3)
    assert abs(skewness) < 4 * (6 / independent) ** 0.5
    centred = (logs - logs.mean()) / logs.std()
    for distance in (CORRELATION / 2, CORRELATION, 2 * CORRELATION):
        lag = round(distance / cell)
        found = float((centred[lag:] * centred[:-lag]).mean())
        expected = np.exp(-lag * cell / CORRELATION)
        assert found == pytest.approx(expected, abs=4 / independent**0.5)


def test_friction_stays_positive_however_wide_the_spread(coach: Coach) -> None:
    rail, _ = friction(long_way(coach, spread=0.24))
    assert rail.min() > 0.0


def test_no_spread_is_an_even_rail(coach: Coach) -> None:
    rail, _ = friction(long_way(coach, spread=0.0))
    np.testing.assert_allclose(rail, MEAN, rtol=1e-12)


def test_the_same_seed_is_the_same_rail(coach: Coach) -> None:
    one, again, other = (friction(long_way(coach, seed=seed))[0] for seed in (5, 5, 6))
    assert one.tobytes() == again.tobytes()
    assert abs(np.corrcoef(one, other)[0, 1]) < 0.1


def test_the_field_seed_may_be_the_runs_seed(coach: Coach) -> None:
    scenario = long_way(coach)
    by_run = friction(scenario.with_({"run.seed": 9}))[0]
    by_field = friction(long_way(coach, seed=9))[0]
    assert by_run.tobytes() == by_field.tobytes()


def test_every_run_of_a_batch_has_its_own_rail(coach: Coach) -> None:
    """And run 0 of a batch has the rail of the run alone."""
    scenario = long_way(coach).with_({"run.time_limit": 60.0, "run.trace": 0.02})
    batch = rg.simulate(scenario, runs=5, traces=True)["rail_friction"].values[:, 0, 1:-1]
    alone = rg.simulate(scenario)["rail_friction"].values[0, 0, 1:-1]
    assert batch[0].tobytes() == alone.tobytes()
    between = np.corrcoef(batch)[np.triu_indices(5, 1)]
    assert np.abs(between).max() < 0.4


def test_another_start_is_a_rail_of_the_same_kind(coach: Coach) -> None:
    """Mean within 5 %, spread within 10 %."""
    near, far = (
        friction(long_way(coach).with_({"line.start": start}))[0] for start in (2000.0, 2500.5)
    )
    assert near.mean() == pytest.approx(far.mean(), rel=0.05)
    assert near.std() == pytest.approx(far.std(), rel=0.1)


def test_the_rail_belongs_to_the_line_not_to_the_train(coach: Coach) -> None:
    """Another step, speed, start or train finds the same friction at the same place, to 1 %.

    Where the field begins it is drawn anew: compared is what lies 20 correlation lengths on. A
    coarser cell takes its value from one end, so places may differ by a cell: 0.5 m of 10 m.
    """
    usual = long_way(coach).with_({"run.time_limit": 50.0})
    longer = usual.train.model_dump()["vehicle"] * 2
    others = [
        usual.with_({"run.step": 0.005}),
        usual.with_({"run.speed": 60.0}),
        usual.with_({"line.start": 2100.0}),
        usual.with_({"train.vehicle": longer}),
    ]

    def along(scenario: rg.Scenario) -> np.ndarray:
        result = rg.simulate(scenario)
        places = result.data["cell"].values
        return np.interp(np.arange(2400.0, 3500.0), places, np.log(
            result["rail_friction_before"].values[0]))  # fmt: skip

    expected = along(usual)
    for scenario in others:
        found = along(scenario)
        assert np.corrcoef(found, expected)[0, 1] > 0.95
        assert found.mean() == pytest.approx(expected.mean(), rel=0.01)


def test_patches_keep_their_own_level(coach: Coach) -> None:
    """The field multiplies a patch's friction; it does not replace it."""
    patch = {"from": 5000.0, "to": 15000.0, "condition": "leaves"}
    scenario = long_way(coach).with_(rail={
        "random": {"mean": MEAN, "spread": SPREAD, "correlation_length": CORRELATION},
        "patch": [patch],
    })  # fmt: skip
    result = rg.simulate(scenario)
    place = result.data["cell"].values
    rail = result["rail_friction_before"].values[0]
    inside = (place > 5000.0) & (place < 15000.0)
    beyond = (place > 16000.0) & (place < 40000.0)
    assert rail[inside].mean() == pytest.approx(0.05, rel=0.06)
    assert rail[beyond].mean() == pytest.approx(MEAN, rel=0.06)


def test_every_controller_runs_on_the_same_random_rail() -> None:
    """Bit for bit, wherever two trains have been: what is compared is the protection."""
    scenario = rg.load("random_rail").with_({"run.speed": "60 km/h", "rail.random.seed": 11})
    rails = {}
    for controller in ("conventional", "adaptive", "temperature_controlled", "none"):
        result = rg.simulate(scenario.with_({"wsp.controller": controller}))
        rails[controller] = result["rail_friction_before"].values[0]
        assert result["rail_friction_before"].values[0].std() > 0.005
    shared = min(map(len, rails.values()))
    assert shared > 100
    first = rails["conventional"][:shared]
    for rail in rails.values():
        assert np.array_equal(rail[:shared], first)
    other = rg.simulate(scenario.with_({"rail.random.seed": 12}))["rail_friction_before"].values[0]
    assert not np.array_equal(other[:shared], first[: len(other)])
