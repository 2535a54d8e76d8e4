"""Energy over running time: the optimum, and the simplest way of being slower."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.optimum.timetable import optimum
from railgrip.engine.journey.drive import drive
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

SUPPLEMENTS = (0.0, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2)


def optimal_curve(
    journey: Journey, supplements: Sequence[float] = SUPPLEMENTS
) -> tuple[Array, Array]:
    """Return running times, s, and least energies, J, for supplements over the least time."""
    least = float(optimum(journey.model_copy(update={"time": None, "supplement": 0.0}))
                  .least_times.sum())  # fmt: skip
    runs = [optimum(journey, least * (1.0 + share)) for share in supplements]
    return np.array([run.running_time for run in runs]), np.array([run.energy for run in runs])


def capped_curve(journey: Journey, longest: float, points: int = 6) -> tuple[Array, Array]:
    """Return times and energies of full power up to lower and lower top speeds.

    Parameters
    ----------
    journey : Journey
        What is driven.
    longest : float
        Where the curve ends, [s].
    points : int
        How many runs.
    """
    top = min(journey.train.max_speed, max(point.value for point in journey.line.speed_limit))

    def run_at(share: float) -> tuple[float, float]:
        train = journey.train.model_copy(update={"max_speed": share * top})
        run = drive(journey.model_copy(update={"train": train}))
        return run.running_time, run.energy["pantograph"]

    low, high = 0.2, 1.0
    for _ in range(20):
        share = 0.5 * (low + high)
        low, high = (share, high) if run_at(share)[0] > longest else (low, share)
    found = [run_at(float(share)) for share in np.linspace(1.0, high, points)]
    return np.array([time for time, _ in found]), np.array([energy for _, energy in found])
