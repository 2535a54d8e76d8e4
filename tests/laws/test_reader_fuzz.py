"""Whatever stands in a file, the reader answers with a Scenario or with a RailgripError."""

from __future__ import annotations

import copy
import math
import tomllib
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from railgrip.core.errors import Problem, RailgripError
from railgrip.io.toml_file import dump_toml, load

TEXT = """
title = "Two coaches"
load = "laden"
[train]
resistance = { constant = "3 kN", linear = 110, quadratic = "7 N/(m/s)^2" }
reservoir = { volume = "150 l" }
dump_valve = {}
dynamic_brake = { force = "30 kN", power = "500 kW" }
[train.brakes.disc]
kind = "disc"
cylinder_pressure = "3.0 bar"
cylinder_area = "324 cm^2"
rigging_ratio = 5
friction_radius = "0.27 m"
pad = { law = "piecewise", reference_friction = 0.37, speed = [[0, 1.08], ["10 m/s", 1]] }
disc = "axle_mounted"
[[train.vehicle]]
count = 2
length = "26.4 m"
tare = "44 t"
payload_max = "8 t"
pivot_distance = "19 m"
track_brake = { force = "100 kN" }
[[train.vehicle.bogie]]
count = 2
wheelbase = "2.5 m"
mass = "6 t"
[[train.vehicle.bogie.axle]]
count = 2
rotating_mass = "700 kg"
wheel_radius = "0.445 m"
brake = "disc"
motor = true
[line]
start = "1 km"
[line.use]
length = "9 km"
gradient = [{ at = 0, value = "5 ‰" }, { at = "2 km", value = "-5 ‰" }]
speed_limit = [{ at = 0, value = "160 km/h" }]
curve = [{ from = 100, to = 400, radius = 300 }]
[rail]
condition = "leaves"
random = { mean = 0.07, spread = 0.02, correlation_length = "100 m" }
patch = [{ from = 1200, to = "1.3 km", condition = "oil" }]
[run]
speed = "160 km/h"
demand = [{ at = 0, level = "service" }, { at = "2 s", level = "emergency" }]
[wsp]
parameters = { slip = "20 %" }
[limits]
stopping_distance = "2 km"
"""
TABLE = tomllib.loads(TEXT)

SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.sampled_from([0, -1, 10**30, -(10**400), 1e308, -1e-320, math.inf, -math.inf, math.nan]),
    st.floats(),
    st.text(max_size=12),
    st.sampled_from(["1e999 m", "-5 t", "3 bar", "0 km/h", "20 degC", "wet", "x.toml", "none", ""]),
    st.builds("{} {}".format, st.floats(), st.sampled_from(["m", "km/h", "‰", "bar", "m^9^9^9"])),
    st.dates(),
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=6), inner, max_size=3)
    ),
    max_leaves=6,
)
# A path into the document, as the shares of the way through each table or list on it.
STEPS = st.lists(st.integers(0, 50), min_size=1, max_size=9)
QUICK = settings(max_examples=250, deadline=None, suppress_health_check=[HealthCheck.too_slow])


def answered(source: Any) -> None:
    """Load; only these two outcomes are allowed, and both must print."""
    problems: list[Problem] = []
    scenario = None
    try:
        scenario = load(source)
    except RailgripError as error:
        problems = error.problems
    if scenario is None:
        assert problems
        assert all("\n" not in str(problem) for problem in problems)
    else:
        assert load(dump_toml(scenario)) == scenario


def spoiled(table: dict[str, Any], steps: list[int], action: str, value: Any) -> dict[str, Any]:
    """Return a copy with one node replaced, deleted, renamed, doubled or nested."""
    table = copy.deepcopy(table)
    node: Any = table
    for step in steps[:-1]:
        keys = list(node) if isinstance(node, dict) else range(len(node))
        below = [key for key in keys if isinstance(node[key], (dict, list)) and node[key]]
        if not below:
            break
        node = node[below[step % len(below)]]
    keys = list(node) if isinstance(node, dict) else list(range(len(node)))
    key = keys[steps[-1] % len(keys)]
    if action == "replace":
        node[key] = value
    elif action == "delete":
        del node[key]
    elif action == "nest":
        node[key] = {"x": [node[key]]}
    elif isinstance(node, dict):
        node[f"{key}{value!s:.5}"] = node.pop(key)
    else:
        node.append(copy.deepcopy(node[key]))
    return table


def test_the_document_itself_is_valid() -> None:
    assert load(TEXT).train.n_axles == 8


@QUICK
@given(STEPS, st.sampled_from(["replace", "replace", "delete", "nest", "rename"]), VALUES)
def test_one_thing_spoiled(steps: list[int], action: str, value: Any) -> None:
    answered(spoiled(TABLE, steps, action, value))


@QUICK
@given(st.lists(st.tuples(STEPS, VALUES), min_size=2, max_size=6))
def test_several_things_spoiled(changes: list[tuple[list[int], Any]]) -> None:
    table: dict[str, Any] = TABLE
    for steps, value in changes:
        table = spoiled(table, steps, "replace", value) or TABLE
    answered(table)


@QUICK
@given(st.integers(0, len(TEXT)), st.integers(0, 12), st.text(max_size=8))
def test_characters_spoiled(at: int, length: int, insert: str) -> None:
    answered(TEXT[:at] + insert + TEXT[at + length :])


@QUICK
@given(st.lists(st.sampled_from([*"[]{}=.,\"'\n#\\ ", "train", "run", "1", "inf", '"""'])))
def test_anything_that_looks_like_toml(parts: list[str]) -> None:
    answered("\n" + "".join(parts))


@QUICK
@given(st.binary(max_size=200))
def test_any_bytes(tmp_path_factory: pytest.TempPathFactory, raw: bytes) -> None:
    path = tmp_path_factory.getbasetemp() / "fuzz.toml"
    path.write_bytes(raw)
    answered(path)


@pytest.mark.parametrize("depth", [30, 60, 2000, 200_000])
def test_deep_nesting(depth: int) -> None:
    answered("\na = " + "[" * depth + "]" * depth)
    answered("\n" + "a." * depth + "a = 1")
    answered("\n" + '"a".' * depth + "a = 1")
    answered("\n" + "".join(f"[{'.'.join('a' * (i + 1))}]\n" for i in range(min(depth, 59))))
