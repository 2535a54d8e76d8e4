"""From a test of the profile to a scenario, and to what differs from repetition to repetition."""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np

from railgrip.campaign.programme.profile import Alternating, Profile, ProgrammeTest, Tolerance
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine import layout as at
from railgrip.engine.simulate import Variations, prepare
from railgrip.scenario import Scenario
from railgrip.scenario.merge import merged

TRACE = 0.05
"""Time between two points of the curves that runs are judged by, s."""
HAULED = 1.0e4
"""Mass of the train with a locomotive that holds its speed, over its own: it brakes by so much
less, while every axle carries and every wheel turns as before."""


def scenario_of(profile: Profile, name: str, base: dict[str, Any], seed: int) -> Scenario:
    """Return the scenario of a test.

    Parameters
    ----------
    profile : Profile
        The programme.
    name : str
        Of the test.
    base : dict
        The tables that do not depend on the test: train and protection.
    seed : int
        Of this batch of repetitions.

    Raises
    ------
    RailgripError
        ``test.W3: run.speed: …``: every problem under the test's name.
    """
    test = profile.test[name]
    table = merged(merged(profile.scenario, test.scenario), base)
    run = dict(table.get("run", {}))
    try:
        if run.get("speed") == "v_max":
            run["speed"] = _greatest_speed(base)
        step = float(run.get("step", 0.01))
        run |= {"seed": seed, "trace": max(TRACE, step)}
        table["run"] = run
        if test.alternating is not None:
            rail = dict(table.get("rail", {}))
            rail["patch"] = patches(test.alternating, seed)
            table["rail"] = rail
        return Scenario.model_validate({"title": test.title, **table})
    except RailgripError as error:
        raise RailgripError(
            [Problem(f"test.{name}.scenario.{p.where}".rstrip("."), p.what, p.got, p.allowed,
                     p.cure) for p in error.problems]
        ) from None  # fmt: skip


def _greatest_speed(base: dict[str, Any]) -> float:
    scenario = Scenario.model_validate(base)
    if scenario.train.max_speed is None:
        raise RailgripError(
            Problem("run.speed", "is v_max, and the train has no max_speed", cure="set it in train")
        )
    return scenario.train.max_speed


def patches(rail: Alternating, seed: int) -> list[dict[str, Any]]:
    """Return stretches of two conditions in turn, their lengths drawn evenly.

    Examples
    --------
    >>> rail = Alternating(conditions=("wet", "low"), shortest=50.0, longest=50.0, end=120.0)
    >>> [(p["from"], p["to"], p["condition"]) for p in patches(rail, 1)]
    [(0.0, 50.0, 'wet'), (50.0, 100.0, 'low'), (100.0, 120.0, 'wet')]
    """
    drawn = np.random.default_rng(seed)
    found: list[dict[str, Any]] = []
    place = rail.begin
    while place < rail.end:
        until = min(rail.end, place + float(drawn.uniform(rail.shortest, rail.longest)))
        found.append({"from": place, "to": until, "condition": rail.conditions[len(found) % 2]})
        place = until
    return found


def seed_of(profile: Profile, name: str, batch: int) -> int:
    """Return the seed of a batch of repetitions: another for each test and each batch."""
    return (profile.seed * 1_000_003 + zlib.crc32(name.encode()) + 7_919 * batch) % 2**31


def variations(
    scenario: Scenario, tolerance: Tolerance, test: ProgrammeTest, runs: int, controller: Any
) -> Variations:
    """Return what differs from run to run; run i draws the same however many there are."""
    parameters = prepare(scenario, controller).plan.parameters
    found: dict[Any, Any] = {}
    n_axles = scenario.train.n_axles
    drawn = np.stack(
        [np.random.default_rng([scenario.run.seed, i]).standard_normal(1 + 3 * n_axles)
         for i in range(runs)]
    )  # fmt: skip
    if tolerance.initial_speed and scenario.run.speed > 0.0:
        found["INITIAL_SPEED"] = scenario.run.speed * (1.0 + tolerance.initial_speed * drawn[:, 0])
    if test.hold_speed:
        mass = parameters[0, at.TRAIN_MASS - at.FIRST_PARAMETER]
        found["TRAIN_MASS"] = np.full(runs, HAULED * mass)
    spreads = (
        (("TREAD_PER_CLAMP",), tolerance.pad_friction, 0),
        (("VALVE_FILL", "VALVE_VENT"), tolerance.valve_time, 1),
        (("BELIEVED_RATIO",), tolerance.wheel_diameter, 2),
    )
    for names, spread, block in spreads:
        for axle in range(n_axles) if spread else ():
            factor = 1.0 + spread * drawn[:, 1 + block * n_axles + axle]
            for name in names:
                value = parameters[1 + axle, getattr(at, name) - at.FIRST_PARAMETER]
                found[(name, axle)] = value * np.maximum(factor, 0.1)
    return found


def applies(test: ProgrammeTest, scenario: Scenario) -> str:
    """Return the equipment that the train lacks for a test; empty where it has all of it."""
    lacking = [name for name in test.needs if getattr(scenario.train, name) is None]
    return ", ".join(lacking)
