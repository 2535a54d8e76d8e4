"""The legs of a journey from stop to stop: ceiling, targets and deceleration of each."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.journey.profile import ceiling
from railgrip.engine.journey.supervision import Onboard
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]


class Leg(NamedTuple):
    """What a driving law may know of the way to the next stop."""

    begin: float
    """Position of the departure, m."""
    end: float
    """Position of the next stop, m."""
    targets: tuple[tuple[float, float], ...]
    """(position [m], permitted speed [m/s]) of every lower limit ahead, the stop last."""
    deceleration: float
    """Of the braking curves, m/s²."""
    is_stop: bool = True
    """Whether the train stands at its end."""
    ceiling: tuple[Array, ...] = ()
    """Highest square of speed by pieces, as `railgrip.engine.journey.profile.ceiling` gives it."""
    authority: float = np.inf
    """Where the authority behind another train ends, m."""


def braking_of(journey: Journey) -> float:
    """Return the deceleration of a journey's braking curves, m/s²; refuse one that has none."""
    deceleration = journey.deceleration()
    if deceleration is None:
        what = "is missing, and the train names none"
        raise RailgripError(Problem("braking", what, cure="braking = '0.5 m/s^2'"))
    return deceleration


def legs(journey: Journey) -> list[Leg]:
    """Return what a driving law is told of each leg."""
    deceleration, stops = braking_of(journey), journey.stops()
    found, onboard = [], None
    if journey.supervision is not None and journey.supervision.mode == "drive":
        onboard = Onboard(journey)
    for k, (here, there) in enumerate(pairwise(stops)):
        final = journey.passing_speed if k == len(stops) - 2 else 0.0
        if onboard is None:
            lid = ceiling(journey, here.at, there.at, final, deceleration)
        else:
            way = onboard.way(np.inf, there.at, final == 0.0)
            lid = onboard.ceiling(way, here.at, there.at, final)
        found.append(leg_of(lid, deceleration, final == 0.0))
    return found


def leg_of(lid: tuple[Array, Array, Array], deceleration: float, is_stop: bool) -> Leg:
    """Return what a driving law is told of a leg under a ceiling."""
    position, square, slope = lid
    feet = np.maximum(square + slope * np.diff(position), 0.0)
    # a braking curve ends where the next piece does not go on falling from its foot
    goes_on = np.append((slope[1:] < 0.0) & (square[1:] <= feet[:-1] * (1 + 1e-9)), False)
    ends = tuple(
        (float(position[k + 1]), float(feet[k] ** 0.5))
        for k in range(slope.size)
        if slope[k] < 0.0 and not goes_on[k]
    )
    return Leg(float(position[0]), float(position[-1]), ends, deceleration, is_stop, lid)
