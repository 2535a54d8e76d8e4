"""Coasting parameters for a line, a train and a time, and how near the rule then comes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import differential_evolution

from railgrip.campaign.optimum.timetable import OptimalRun, optimum
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.journey.coasting import coasting_of
from railgrip.engine.journey.drive import FLAT_OUT, JourneyRun
from railgrip.engine.journey.following import authority_of, driven_run
from railgrip.engine.journey.marching import Authority
from railgrip.scenario.coasting import Coasting
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

LATE = 50.0
"""What being late by the whole running time costs, in energies of the fastest run."""
ON_TIME = 1e-4
"""Share of the time by which a run may be late."""
CURVES = (0.3, 0.2, 0.14, 0.1, 0.07, 0.05, 0.035, 0.025)
"""Shares of the braking deceleration for a curve of energy over time."""


class TunedCoasting(NamedTuple):
    """What the search found.

    Attributes
    ----------
    journey : Journey
        With the coasting found.
    run, flat_out : JourneyRun
        The run under it, and the fastest one.
    best : OptimalRun
        The optimum for the time of `run`.
    share : float
        Of the saving that is possible in this time, how much the rule makes.
    """

    journey: Journey
    run: JourneyRun
    flat_out: JourneyRun
    best: OptimalRun
    share: float


def tune_coasting(
    journey: Journey, time: float, *, seed: int = 1, rounds: int = 60
) -> TunedCoasting:
    """Return the coasting parameters of least energy that keep a running time.

    Parameters
    ----------
    journey : Journey
        Its table ``coasting`` says shape and action; absent: the defaults.
    time : float
        Running time without dwells, at least that of the fastest run, [s].
    seed : int
        Of the search (differential evolution); the same seed finds the same.
    rounds : int
        Generations, ≥ 1; about 60 journeys each.

    Returns
    -------
    found : TunedCoasting

    Raises
    ------
    RailgripError
        ``time: is impossible on this line with this train; got 900.0 s; allowed: from 996.6 s``

    Notes
    -----
    Searched are the curve (b_ALK, or k1 and k2), the hysteresis, the distance from a station within
    which the law is off, and what the action has to set. The search is no proof: the best of some
    thousand journeys.

    Examples
    --------
    >>> journey = Journey(train="local", line="const")
    >>> found = tune_coasting(journey, 420.0, rounds=3)
    >>> found.run.running_time <= 420.1, 0.5 < found.share <= 1.001
    (True, True)
    """
    if journey.leader is not None and journey.leader.renewal == 0.0:
        what = "is steady, and each of some thousand journeys behind it takes a second"
        raise RailgripError(Problem("leader.renewal", what, cure="renewal = '5 s' while tuning"))
    # the leading train is driven once
    authority = authority_of(journey) if journey.leader is not None else None
    flat_out = driven_run(journey, FLAT_OUT, authority)
    if time < flat_out.running_time * (1.0 - 1e-6):
        raise RailgripError(
            Problem("time", "is impossible on this line with this train", got=f"{time:.1f} s",
                    allowed=f"from {flat_out.running_time:.1f} s")
        )  # fmt: skip
    start = journey.coasting or Coasting()
    bounds = _bounds(start, journey.deceleration() or math.inf)
    whole = flat_out.energy["pantograph"]

    def cost(numbers: Array) -> float:
        run = _driven(journey, _with(start, bounds, numbers), authority)
        if run is None:
            return LATE
        late = max(0.0, run.running_time / time - 1.0)
        return run.energy["pantograph"] / whole + LATE * late

    found = differential_evolution(
        cost, [(low, high) for _, low, high in bounds], rng=seed, maxiter=rounds, popsize=12,
        tol=1e-5, polish=False, init="sobol",
    )  # fmt: skip
    tuned = journey.model_copy(update={"coasting": _with(start, bounds, found.x)})
    run = _driven(journey, tuned.coasting, authority)
    if run is None or run.running_time > time * (1.0 + ON_TIME):
        late = "it stalls" if run is None else f"{run.running_time:.1f} s"
        raise RailgripError(
            Problem("time", "no coasting was found that keeps it", got=f"{time:.1f} s",
                    allowed=f"the nearest found: {late}", cure="more rounds")
        )  # fmt: skip
    best = optimum(journey, max(run.running_time, flat_out.running_time))
    return TunedCoasting(tuned, run, flat_out, best, share_of_saving(run, flat_out, best))


def share_of_saving(run: JourneyRun, flat_out: JourneyRun, best: OptimalRun) -> float:
    """Return how much of the saving possible in a run's time it makes."""
    whole = flat_out.energy["pantograph"]
    possible = whole - best.energy
    made: float = (whole - run.energy["pantograph"]) / possible if possible > 0.0 else 1.0
    return made


def coasting_trade_off(journey: Journey, shares: Sequence[float] = CURVES) -> tuple[Array, Array]:
    """Return times, s, and energies, J, of flatter and flatter coasting curves."""
    start, braking = journey.coasting or Coasting(), journey.deceleration() or math.inf
    found = []
    for share in shares:
        changes = (
            {"coasting_deceleration": share * braking}
            if start.shape == "parabolic"
            else {"distance_gain": 0.1 * share}
        )
        run = _driven(journey, start.model_copy(update=changes))
        if run is not None:
            found.append((run.running_time, run.energy["pantograph"]))
    rows = np.array(sorted(found)).reshape(-1, 2)
    return rows[:, 0], rows[:, 1]


def _bounds(start: Coasting, braking: float) -> list[tuple[str, float, float]]:
    """Return (name, least, greatest) of what is searched; curves by their logarithm."""
    bounds = [("hysteresis", 0.5, 15.0), ("station_distance", 0.0, 8000.0)]
    if start.shape == "parabolic":
        bounds.append(("coasting_deceleration", math.log(0.01 * braking), math.log(0.9 * braking)))
    else:
        bounds += [("distance_gain", math.log(5e-4), math.log(0.1)), ("speed_gain", 1.0, 1.5)]
    if start.action == "reduced":
        bounds.append(("reduced_share", 0.0, 0.5))
    if start.action == "light braking":
        bounds.append(("light_deceleration", 0.005, 0.5 * braking))
    return bounds


def _with(start: Coasting, bounds: list[tuple[str, float, float]], numbers: Array) -> Coasting:
    changes = {
        name: math.exp(number) if name in ("coasting_deceleration", "distance_gain") else number
        for (name, _, _), number in zip(bounds, numbers.tolist(), strict=True)
    }
    return start.model_copy(update=changes)


def _driven(
    journey: Journey, coasting: Coasting | None, authority: Authority | None = None
) -> JourneyRun | None:
    """Return the run, or None where the train is left standing."""
    own = journey.model_copy(update={"coasting": coasting})
    try:
        return driven_run(own, coasting_of(own), authority)
    except RailgripError:
        return None
