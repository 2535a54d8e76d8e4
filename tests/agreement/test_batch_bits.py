"""A run gives the same bits alone, among 16 or 40, traced or not, on one thread or two.

Wheels slide under protection on bad rail, where the smallest difference would grow: equal bits are
asked for, no tolerance.
"""

from __future__ import annotations

import threading
import time
from typing import Any

import numpy as np
import pytest

import railgrip as rg
from railgrip.core.status import RunStatus

RUNS = 40


def variations(runs: int) -> dict[Any, np.ndarray]:
    """Speed, mass, one wheel load, one wheel and all pads' force differ from run to run."""
    generator = np.random.default_rng(40)
    return {
        "INITIAL_SPEED": generator.uniform(20.0, 30.0, runs),
        "TRAIN_MASS": generator.uniform(2.1e5, 2.3e5, runs),
        ("STATIC_LOAD", 3): generator.uniform(1.2e5, 1.4e5, runs),
        ("BELIEVED_RATIO", 5): generator.uniform(0.99, 1.01, runs),
        "CLAMP_PER_PRESSURE": generator.uniform(0.25, 0.33, runs),
    }


def first(changes: dict[Any, np.ndarray], *which: int) -> dict[Any, np.ndarray]:
    return {key: values[list(which)] for key, values in changes.items()}


def outcomes(result: rg.Result) -> dict[str, np.ndarray]:
    """Everything that is not a trace and not the rail of a single run."""
    dims = {"time", "cell"}
    return {
        str(name): variable.values
        for name, variable in result.data.items()
        if not dims & set(variable.dims) and name != "adhesion_utilisation"
    }


def assert_same(one: rg.Result, other: rg.Result, runs: list[int]) -> None:
    """The first result's runs are those of the other, bit for bit."""
    expected = outcomes(other)
    found = outcomes(one)
    assert found.keys() == expected.keys()
    for name, values in found.items():
        assert np.array_equal(values, expected[name][runs], equal_nan=True), name


@pytest.fixture(scope="module")
def scenario() -> rg.Scenario:
    """The four-car unit on detergent, then leaves, with sand, dynamic brake and protection."""
    patch = [{"from": 200.0, "to": 50e3, "condition": "leaves"}]
    return rg.load("detergent_160").with_(rail={"patch": patch})


@pytest.fixture(scope="module")
def batch(scenario: rg.Scenario) -> rg.Result:
    result = rg.simulate(scenario, runs=RUNS, variations=variations(RUNS))
    assert (result["status"].values == RunStatus.STOPPED).all()
    assert result["axle_valve_cycles"].values.sum(axis=1).min() >= 1
    assert len(np.unique(result["stopping_distance"].values)) == RUNS
    return result


@pytest.mark.parametrize("run", [0, 7, 39])
def test_alone(scenario: rg.Scenario, batch: rg.Result, run: int) -> None:
    alone = rg.simulate(scenario, variations=first(variations(RUNS), run))
    assert_same(alone, batch, [run])


@pytest.mark.parametrize("runs", [2, 5, 16])
def test_among_others(scenario: rg.Scenario, batch: rg.Result, runs: int) -> None:
    which = list(range(7, 7 + runs))
    fewer = rg.simulate(scenario, runs=runs, variations=first(variations(RUNS), *which))
    assert_same(fewer, batch, which)


def test_in_another_order(scenario: rg.Scenario, batch: rg.Result) -> None:
    """Other lanes, other neighbours, other runs before."""
    which = list(range(RUNS))[::-1]
    turned = rg.simulate(scenario, runs=RUNS, variations=first(variations(RUNS), *which))
    assert_same(turned, batch, which)


@pytest.mark.parametrize("threads", [2, 3])
def test_on_threads(scenario: rg.Scenario, batch: rg.Result, threads: int) -> None:
    shared = rg.simulate(scenario, runs=RUNS, variations=variations(RUNS), threads=threads)
    assert_same(shared, batch, list(range(RUNS)))


def test_with_traces(scenario: rg.Scenario, batch: rg.Result) -> None:
    traced = rg.simulate(
        scenario, runs=5, variations=first(variations(RUNS), *range(5)), traces=True
    )
    assert_same(traced, batch, list(range(5)))


def test_on_random_rail() -> None:
    """Run i of a batch has the i-th rail, however the batch is cut."""
    scenario = rg.load("random_rail").with_({"run.speed": "90 km/h"})
    batch = rg.simulate(scenario, runs=33)
    assert len(np.unique(batch["stopping_distance"].values)) == 33
    for runs in (1, 3, 16):
        assert_same(rg.simulate(scenario, runs=runs), batch, list(range(runs)))
    assert_same(rg.simulate(scenario, runs=33, threads=2), batch, list(range(33)))


def test_twice_is_the_same(scenario: rg.Scenario, batch: rg.Result) -> None:
    again = rg.simulate(scenario, runs=RUNS, variations=variations(RUNS))
    assert_same(again, batch, list(range(RUNS)))


def test_the_interpreter_is_free_while_the_kernel_runs(scenario: rg.Scenario) -> None:
    """A Python thread goes on counting while another computes a batch (no lock is held).

    It sleeps 1 ms between counts; held off for the whole batch it would reach 0.
    """
    rg.simulate(scenario, runs=16)  # compiled by now
    counted, done = 0, threading.Event()

    def compute() -> None:
        rg.simulate(scenario, runs=160)
        done.set()

    worker = threading.Thread(target=compute)
    begin = time.perf_counter()
    worker.start()
    while not done.is_set():
        time.sleep(1e-3)
        counted += 1
    worker.join()
    taken = time.perf_counter() - begin
    assert counted > 20 * taken
