"""Pilot runs: what a surrogate learns of a model before the sample is drawn."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.rare.faces import Plane, explained, fit_planes, share_out
from railgrip.campaign.rare.failures import FailureStates
from railgrip.campaign.rare.proposal import components, draw
from railgrip.campaign.rare.surrogate import (
    LEAST_SLOPE,
    Bend,
    Surrogate,
    fit_bend,
    fit_direction,
    surrogate_of,
)
from railgrip.core.errors import Problem, RailgripError

FloatArray = NDArray[np.float64]
Model = Callable[[FloatArray, NDArray[np.bool_]], FloatArray]
"""normals (runs, variables), failed (runs, units) → result (runs,); larger is better."""

PILOT_ROUNDS = 2
STRAIGHT = 0.98
"""One direction that explains this share of the variance is enough: its bend does the rest."""
MOSTLY_STRAIGHT = 0.5
"""Above this share one direction gives way only to several that leave a quarter of its error."""
MORE_ROUNDS = 3
"""Further ones where the result falls in several directions."""
MOST_CENTRES = 5000
"""States beyond take their centre from those of the units that failed."""


class Counted:
    """The model, counting its runs and refusing results that are no numbers."""

    def __init__(self, model: Model) -> None:
        self.model, self.runs = model, 0

    def __call__(self, normals: FloatArray, failed: NDArray[np.bool_]) -> FloatArray:
        """Return the results of many runs; refuse what is no finite number."""
        result = np.asarray(self.model(normals, failed), dtype=float)
        if result.shape != (len(normals),) or not np.isfinite(result).all():
            bad = np.count_nonzero(~np.isfinite(result))
            raise RailgripError(
                Problem("model", "must give one finite result for each run",
                        got=f"shape {result.shape}, {bad} of them not finite",
                        allowed=f"({len(normals)},)")
            )  # fmt: skip
        self.runs += len(normals)
        return result


class Learnt(NamedTuple):
    """What pilots tell of one direction, for one number of failed units."""

    plane: Plane
    bend: Bend


def pilot(
    model: Counted,
    states: FailureStates,
    owners: NDArray[np.intp],
    ladder: FloatArray,
    runs: int,
    generator: np.random.Generator,
) -> tuple[list[Surrogate], dict[int, float]]:
    """Learn centres from medians, then directions and bends from rounds of pilots.

    Returns
    -------
    faces : list of Surrogate
        Where the rare runs lie.
    explained : dict
        For each number of failed units the share of the pilots' variance that its several
        directions explain; 1 where there is one, whose bend does the rest.
    """
    centre = _centres(model, states, len(owners))
    works = np.ones((len(states.weight), len(owners)))
    owned = owners >= 0
    works[:, owned] = ~states.failed[:, owners[owned]]
    per_count = max(3 * len(owners) + 20, runs // (2 * (states.n_failed.max() + 1)))
    rows = []
    for count in np.unique(states.n_failed):
        members = np.flatnonzero(states.n_failed == count)
        weight = states.weight[members]
        rows.append(members[generator.choice(len(members), per_count, p=weight / weight.sum())])
    row = np.concatenate(rows)
    normals = generator.standard_normal((len(row), len(owners)))
    memory = Memory({}, {}, {})
    faces: list[Surrogate] = []
    for turn in range(1 + PILOT_ROUNDS + MORE_ROUNDS):
        if turn > PILOT_ROUNDS and len(faces) == 1:
            break
        if turn > 0:
            sample = draw(components(faces, states, ladder, runs), faces, states, generator)
            row, normals = sample.state, sample.normals
        drop = centre[row] - model(normals, states.failed[row])
        for count in np.unique(states.n_failed):
            here = states.n_failed[row] == count
            _learn(memory, int(count), normals[here] * works[row[here]], drop[here])
        faces = _faces(memory.learnt, states, centre, works)
    return faces, memory.explained


class Memory(NamedTuple):
    """For each number of failed units all its pilots, and what was learnt from them."""

    pilots: dict[int, tuple[FloatArray, FloatArray]]
    learnt: dict[int, list[Learnt]]
    explained: dict[int, float]


def _learn(memory: Memory, count: int, normals: FloatArray, drop: FloatArray) -> None:
    """Learn directions and bends of one number of failed units; with too few runs, nothing new."""
    before = memory.pilots.get(count, (normals[:0], drop[:0]))
    all_normals, all_drop = np.vstack([before[0], normals]), np.append(before[1], drop)
    memory.pilots[count] = all_normals, all_drop
    enough = len(drop) >= 2 * normals.shape[1] + 10
    single = [Plane(*fit_direction(normals, drop))]
    if enough and explained(single, normals, drop) >= STRAIGHT:
        planes = single
    elif len(all_drop) >= 2 * normals.shape[1] + 10:
        known = [[one.plane for one in learnt] for learnt in memory.learnt.values()]
        planes = fit_planes(all_normals, all_drop, known)
        if enough and _is_no_better(planes, all_normals, all_drop, single, normals, drop):
            planes = single
        if len(planes) > 1 or not enough:
            normals, drop = all_normals, all_drop
        else:  # one direction, much bent: the latest pilots know its tail best
            planes = single
    else:
        return
    is_split = len(planes) > 1
    memory.explained[count] = explained(planes, normals, drop) if is_split else 1.0
    owner = share_out(planes, normals)
    found = []
    for number, plane in enumerate(planes):
        own = owner == number
        slope = max(float(np.linalg.norm(plane.gradient)), LEAST_SLOPE)
        z = (drop[own] - plane.constant) / slope
        found.append(Learnt(plane, fit_bend(z, normals[own] @ plane.gradient / slope)))
    memory.learnt[count] = found


def _is_no_better(
    planes: list[Plane],
    all_normals: FloatArray,
    all_drop: FloatArray,
    single: list[Plane],
    normals: FloatArray,
    drop: FloatArray,
) -> bool:
    """Return whether several directions are only the scatter of one that explains a lot."""
    seen = explained(single, normals, drop)
    left = 1.0 - explained(planes, all_normals, all_drop)
    return seen > MOSTLY_STRAIGHT and left > 0.25 * (1.0 - seen)


def _faces(
    learnt: dict[int, list[Learnt]], states: FailureStates, centre: FloatArray, works: FloatArray
) -> list[Surrogate]:
    """Return the faces of all states, as many as the count with most directions has."""
    faces = []
    for number in range(max(len(one) for one in learnt.values())):
        gradients, bends = np.zeros_like(works), []
        middle, is_there = centre.copy(), np.zeros(len(centre), dtype=bool)
        for count in range(int(states.n_failed.max()) + 1):
            members = states.n_failed == count
            if number < len(learnt.get(count, [])):
                plane, bend = learnt[count][number]
                gradients[members] = -plane.gradient * works[members]
                middle[members] -= plane.constant
                is_there[members] = True
                bends.append(bend)
            else:
                bends.append(Bend())
        faces.append(surrogate_of(middle, gradients, bends, is_there))
    return faces


def _centres(model: Counted, states: FailureStates, n_variables: int) -> FloatArray:
    if len(states.weight) <= MOST_CENTRES:
        given: FloatArray = model(np.zeros((len(states.weight), n_variables)), states.failed)
        return given
    units = states.failed.shape[1]
    single = np.vstack([np.zeros((1, units), bool), np.eye(units, dtype=bool)])
    given = model(np.zeros((units + 1, n_variables)), single)
    added: FloatArray = given[0] + states.failed @ (given[1:] - given[0])
    return added
