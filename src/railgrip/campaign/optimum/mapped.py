"""The run for a train with an efficiency map: the optimum of its mean efficiencies."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from railgrip.engine.journey.forces import efficiency, effort_at, piece_at, train_arrays
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

ROUNDS = 2
"""How often the mean efficiencies are taken anew from the run that they gave."""


def with_means(journey: Journey, means: tuple[float, float]) -> Journey:
    """Return a journey whose train has two constant efficiencies instead of its map."""
    traction, regeneration = means
    chain = journey.train.efficiency.model_copy(
        update={"map": None, "traction": traction, "regeneration": regeneration}
    )
    train = journey.train.model_copy(update={"efficiency": chain})
    return journey.model_copy(update={"train": train})


def by_the_map(journey: Journey, run: Any) -> tuple[tuple[float, float], float]:
    """Return a run's mean efficiencies of traction and braking, and its energy, by the map.

    Parameters
    ----------
    journey : Journey
        With the map.
    run : OptimalRun
        Speeds and forces.

    Returns
    -------
    means : (float, float)
        Work at the wheel over that at the DC link, and the reverse for braking.
    energy : float
        Net at the pantograph, with the auxiliaries, J.
    """
    train, chain = train_arrays(journey.train), journey.train.efficiency
    width = np.diff(run.position)
    speed = np.sqrt(0.5 * (run.speed[1:] ** 2 + run.speed[:-1] ** 2))
    drawn = sum(
        force * way / _efficiency(train, train.effort, v, force)
        for force, way, v in zip(run.traction, width, speed, strict=True)
        if force > 0.0
    )
    returned = sum(
        force * way * _efficiency(train, train.brake, v, force)
        for force, way, v in zip(run.motor_brake, width, speed, strict=True)
        if force > 0.0
    )
    pulled, braked = float(run.traction @ width), float(run.motor_brake @ width)
    means = (
        pulled / drawn if drawn > 0.0 else chain.traction,
        returned / braked if braked > 0.0 else chain.regeneration,
    )
    drawn += journey.train.auxiliaries * float(run.time[-1])
    net = journey.train.regeneration.receptivity
    return means, float(drawn / chain.converter - returned * net * chain.converter)


def _efficiency(train: Any, pieces: Array, speed: float, force: float) -> float:
    full = effort_at(pieces, piece_at(pieces, speed), speed)
    return efficiency(train, speed, force / full if full > 0.0 else 0.0, 1.0)
