"""Importance sampling along a direction, for all levels at once.

For each level and each number of failed units there is one component: it draws a failure state as
probable as the surrogate holds it at that level, and a position t beyond where the surrogate sees
the rare runs begin. Across the direction everything stays standard normal. A sample counts with the
balance heuristic, whatever component drew it: its true density over the density of all of them
together.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import log_ndtr, ndtr, ndtri_exp

from railgrip.campaign.rare.failures import FailureStates
from railgrip.campaign.rare.surrogate import Surrogate

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

WHOLE_SHARE = 0.1
"""Share of the runs that are drawn as they come: they bound every weight."""
LEAST_RUNS = 8
"""Runs of a component; fewer would not tell its variance."""
LEAST_POSTERIOR = 1e-5
"""A component whose state is less probable at its level is left to the other levels."""


class Component(NamedTuple):
    """One source of samples.

    Attributes
    ----------
    n_failed : int
        Number of failed units.
    begins : (members,)
        t beyond which it draws, for each state with so many failed units; −inf: everywhere.
    probability : float
        Probability of what it may draw, by the surrogate's geometry; exact.
    runs : int
        How many samples it gives.
    """

    n_failed: int
    begins: FloatArray
    probability: float
    runs: int


class Sample(NamedTuple):
    """Samples with their weights.

    Attributes
    ----------
    normals : (runs, variables)
        Standard normal coordinates.
    state : (runs,) int
        Row of the failure state.
    position : (runs,)
        Position t along the direction of the state.
    weight : (runs,)
        So that the sum of weights over an event estimates its probability.
    component : (runs,) int
        Which component drew it.
    """

    normals: FloatArray
    state: IntArray
    position: FloatArray
    weight: FloatArray
    component: IntArray


def components(
    surrogate: Surrogate, states: FailureStates, probabilities: FloatArray, runs: int
) -> list[Component]:
    """Return the components that serve all the given probabilities with about so many runs.

    Parameters
    ----------
    surrogate : Surrogate
        Where the rare runs lie.
    states : FailureStates
        What may have failed.
    probabilities : (levels,)
        Probabilities of the levels, between 0 and 1.
    runs : int
        Runs to share out; small components are rounded up.
    """
    begins = surrogate.beginnings(states, surrogate.bounds(states, probabilities))
    counts = np.unique(states.n_failed)
    found = []
    for level in [-1, *range(len(probabilities))]:
        from_here = np.full(len(states.weight), -np.inf) if level < 0 else begins[level]
        tails = states.weight * ndtr(-from_here)
        parts = np.array([tails[states.n_failed == count].sum() for count in counts])
        # the root gives the states that matter little their say: they may matter more than the
        # surrogate knows
        posterior = parts / parts.sum()
        said = np.sqrt(posterior) * (posterior > LEAST_POSTERIOR if level >= 0 else 1.0)
        share = WHOLE_SHARE if level < 0 else (1.0 - WHOLE_SHARE) / len(probabilities)
        for count, part, own in zip(counts, parts, said / said.sum(), strict=True):
            if own > 0.0 or level < 0:
                size = max(LEAST_RUNS, round(runs * share * own))
                found.append(Component(int(count), from_here[states.n_failed == count], part, size))
    return found


def draw(
    chosen: list[Component],
    surrogate: Surrogate,
    states: FailureStates,
    generator: np.random.Generator,
) -> Sample:
    """Return the samples of all components."""
    state, position, origin = [], [], []
    for number, component in enumerate(chosen):
        members = np.flatnonzero(states.n_failed == component.n_failed)
        tails = states.weight[members] * ndtr(-component.begins)
        picked = generator.choice(len(members), component.runs, p=tails / tails.sum())
        # one uniform number in each of so many equal parts: the intervals do not count on it
        parts = generator.permutation(component.runs)
        uniform = (parts + generator.random(component.runs)) / component.runs
        beyond = log_ndtr(-component.begins[picked])
        position.append(-ndtri_exp(np.log(uniform) + beyond))
        state.append(members[picked])
        origin.append(np.full(component.runs, number))
    t, row = np.concatenate(position), np.concatenate(state)
    normals = generator.standard_normal((len(t), surrogate.direction.shape[1]))
    along = surrogate.direction[row]
    normals += (t - np.einsum("ij,ij->i", normals, along))[:, None] * along
    weight = _balance(chosen, states, row, t)
    return Sample(normals, row, t, weight, np.concatenate(origin))


def _balance(
    chosen: list[Component], states: FailureStates, row: IntArray, t: FloatArray
) -> FloatArray:
    """Return one over the density of all components together, relative to the true density."""
    density = np.zeros(len(t))
    place = np.zeros(len(states.weight), dtype=np.intp)
    for count in np.unique(states.n_failed):
        members = np.flatnonzero(states.n_failed == count)
        place[members] = np.arange(len(members))
    for component in chosen:
        here = np.flatnonzero(states.n_failed[row] == component.n_failed)
        reached = t[here] > component.begins[place[row[here]]]
        density[here] += reached * (component.runs / component.probability)
    return 1.0 / density
