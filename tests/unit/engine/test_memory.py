"""A batch needs the same memory however many runs it has, and outcomes a kilobyte or two each."""

from __future__ import annotations

from typing import Any

import pytest

import railgrip as rg
from railgrip.engine import simulate as engine


@pytest.fixture
def recorded(monkeypatch: pytest.MonkeyPatch) -> dict[str, list[int]]:
    """Bytes of every working memory and of the outcome tables that runs ask for."""
    sizes: dict[str, list[int]] = {"memory": [], "outcome": []}

    def watched(name: str) -> Any:
        original = getattr(engine, name)

        def call(*given: Any) -> Any:
            made = original(*given)
            sizes[name].append(sum(array.nbytes for array in made))
            return made

        return call

    for name in sizes:
        monkeypatch.setattr(engine, name, watched(name))
    return sizes


def test_working_memory_does_not_grow(recorded: dict[str, list[int]]) -> None:
    scenario = rg.load("detergent_160").with_({"run.speed": "30 km/h"})
    for runs in (16, 160):
        rg.simulate(scenario, runs=runs)
    assert len(recorded["memory"]) >= 2
    assert len(set(recorded["memory"])) == 1
    assert recorded["memory"][0] < 4e6


def test_working_memory_does_not_grow_with_the_way(recorded: dict[str, list[int]]) -> None:
    scenario = rg.load("detergent_160").with_({"run.speed": "30 km/h"})
    rg.simulate(scenario, runs=16)
    rg.simulate(scenario.with_(line={"use": {"length": 1e6}}), runs=16)
    short, long = recorded["memory"]
    assert short == long


def test_each_thread_has_its_own(recorded: dict[str, list[int]]) -> None:
    scenario = rg.load("detergent_160").with_({"run.speed": "30 km/h"})
    rg.simulate(scenario, runs=64, threads=2)
    assert len(set(recorded["memory"])) == 1


def test_outcomes_are_small_and_traces_are_asked_for(recorded: dict[str, list[int]]) -> None:
    """Without traces under 2 kB a run of sixteen axles; with them what they need."""
    scenario = rg.load("detergent_160").with_(
        {"run.speed": "30 km/h", "run.time_limit": "20 s", "run.trace": "0.1 s"}
    )
    bare = rg.simulate(scenario, runs=16)
    traced = rg.simulate(scenario, runs=16, traces=True)
    small, large = recorded["outcome"]
    assert small < 16 * 2000
    assert large > 20 * small
    assert "time" not in bare.data.dims
    assert traced.data.sizes["time"] > 50
    one = rg.simulate(scenario)
    assert "rail_energy" in one.data
    assert "rail_energy" not in traced.data
