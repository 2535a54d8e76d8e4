"""Temperature control under the adaptive supervisor: what it gives back on leaves."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from tests.agreement.test_adaptive_states import way
from tests.agreement.test_plain_and_compiled import OnlyPlain, assert_same

import railgrip as rg
from railgrip.control.contract import MACRO, MICRO
from railgrip.control.temperature_adaptive import TemperatureAdaptive
from railgrip.core.errors import RailgripError


@cache
def stop(train: str, condition: str, controller: str) -> rg.Result:
    changes: dict[str, Any] = {
        "train": train, "rail": {"condition": condition}, "run.speed": "140 km/h",
        "wsp": {"controller": controller},
    }  # fmt: skip
    return rg.simulate(rg.load("leaves_160").with_(changes))


def distance(result: rg.Result) -> float:
    return float(result["stopping_distance"].values[0])


@pytest.mark.parametrize("train", ["emu_four_car_emb", "emu_four_car"])
def test_on_leaves_it_gives_back_most_of_what_heat_costs(train: str) -> None:
    alone, combined, best = (
        distance(stop(train, "leaves", name))
        for name in ("temperature_controlled", "temperature_adaptive", "micro_slip")
    )
    assert alone > 1.3 * best
    assert alone - combined > 0.75 * (alone - best)
    ranges = stop(train, "leaves", "temperature_adaptive")["slip_range"].values[0]
    assert ranges[:, -1].tolist() == [MACRO] * 2 + [MICRO] * 14
    numbers = way(stop(train, "leaves", "temperature_adaptive"))
    begin = numbers.index(307)
    assert numbers[begin - 3 : begin + 4] == [304, 305, 306, 307, 308, 309, 310]


@pytest.mark.parametrize("train", ["emu_four_car_emb", "emu_four_car"])
def test_on_rail_that_is_cleaned_it_loses_little(train: str) -> None:
    combined = stop(train, "water_detergent", "temperature_adaptive")
    alone = distance(stop(train, "water_detergent", "temperature_controlled"))
    assert distance(combined) < 1.025 * alone
    assert 307 not in way(combined)
    fast = combined["train_speed"].values[0] > 3.0
    # the limit is 200 K, and 0.95 of it is aimed at; the sanders help
    assert combined["flash_temperature"].values[0][:, fast].max() < 250.0


def test_it_drives_too() -> None:
    start = rg.load("start_leaves").with_({"run.demand": "none"})
    result = rg.simulate(start, controller=TemperatureAdaptive())
    alone = rg.simulate(start.with_({"wsp.controller": "temperature_controlled"}))
    assert float(result["covered_distance"][0]) > 0.95 * float(alone["covered_distance"][0])
    assert np.isfinite(result["wheel_speed"].values).all()
    assert float((result["wheel_speed"] - result["train_speed"]).max()) < 3.0


def test_plain_and_compiled() -> None:
    described = rg.load("coach_leaves").with_({"run.speed": "80 km/h"})
    controller = TemperatureAdaptive()
    compiled = rg.simulate(described, controller=controller)
    assert compiled["wsp_state"].values.max() >= 306
    assert_same(rg.simulate(described, controller=OnlyPlain(controller)), compiled)


def test_slip_limits_that_contradict_each_other_are_refused() -> None:
    with pytest.raises(RailgripError, match="micro_slip"):
        TemperatureAdaptive(TemperatureAdaptive().parameters._replace(micro_slip=0.1))
