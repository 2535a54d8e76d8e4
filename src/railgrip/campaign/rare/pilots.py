"""Pilot runs: what a surrogate learns of a model before the sample is drawn."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.rare.failures import FailureStates
from railgrip.campaign.rare.proposal import components, draw
from railgrip.campaign.rare.surrogate import (
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


def pilot(
    model: Counted,
    states: FailureStates,
    owners: NDArray[np.intp],
    ladder: FloatArray,
    runs: int,
    generator: np.random.Generator,
) -> Surrogate:
    """Learn centres from medians, then directions and bends from rounds of pilots."""
    centre = _centres(model, states, len(owners))
    per_count = max(3 * len(owners) + 20, runs // (2 * (states.n_failed.max() + 1)))
    rows = []
    for count in np.unique(states.n_failed):
        members = np.flatnonzero(states.n_failed == count)
        weight = states.weight[members]
        rows.append(members[generator.choice(len(members), per_count, p=weight / weight.sum())])
    row = np.concatenate(rows)
    normals = generator.standard_normal((len(row), len(owners)))
    surrogate = _fitted(model, states, owners, centre, row, normals, None)
    for _ in range(PILOT_ROUNDS):
        sample = draw(components(surrogate, states, ladder, runs), surrogate, states, generator)
        surrogate = _fitted(
            model, states, owners, centre, sample.state, sample.normals, surrogate
        )  # fmt: skip
    return surrogate


def _centres(model: Counted, states: FailureStates, n_variables: int) -> FloatArray:
    if len(states.weight) <= MOST_CENTRES:
        given: FloatArray = model(np.zeros((len(states.weight), n_variables)), states.failed)
        return given
    units = states.failed.shape[1]
    single = np.vstack([np.zeros((1, units), bool), np.eye(units, dtype=bool)])
    given = model(np.zeros((units + 1, n_variables)), single)
    added: FloatArray = given[0] + states.failed @ (given[1:] - given[0])
    return added


def _fitted(
    model: Counted,
    states: FailureStates,
    owners: NDArray[np.intp],
    centre: FloatArray,
    row: NDArray[np.intp],
    normals: FloatArray,
    before: Surrogate | None,
) -> Surrogate:
    """Return a surrogate fitted to runs; with too few of them for a count, as it was before."""
    fall = model(normals, states.failed[row]) - centre[row]
    works = np.ones((len(states.weight), len(owners)))
    owned = owners >= 0
    works[:, owned] = ~states.failed[:, owners[owned]]
    gradients = np.zeros((len(states.weight), len(owners)))
    bends = []
    for count in range(int(states.n_failed.max()) + 1):
        members = states.n_failed == count
        here = members[row]
        acting = works[row[here]]
        if here.sum() < 2 * len(owners) + 10:
            if before is not None:
                gradients[members] = -(before.direction * before.slope[:, None])[members]
            bends.append(before.bend[count] if before is not None else Bend())
            continue
        _, gradient = fit_direction(normals[here] * acting, fall[here])
        gradients[members] = gradient * works[members]
        own = surrogate_of(states, centre, gradients, [])
        z = -fall[here] / own.slope[row[here]]
        t = np.einsum("ij,ij->i", normals[here], own.direction[row[here]])
        bends.append(fit_bend(z, t))
    return surrogate_of(states, centre, gradients, bends)
