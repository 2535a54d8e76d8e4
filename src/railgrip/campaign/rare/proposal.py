"""Importance sampling along directions, for all levels at once.

For each level, each number of failed units and each direction there is one component: it draws a
failure state as probable as the surrogate holds it at that level, and a position t beyond where
the surrogate sees the rare runs begin. Across the direction everything stays standard normal. Where
there are few variables a shell joins in: it draws everywhere beyond a distance from the centre, and
so finds directions that no pilot saw. A sample counts with the balance heuristic, whatever
component drew it: its true density over the density of all of them together.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtrc, chdtri, log_ndtr, ndtr, ndtri_exp

from railgrip.campaign.rare.failures import FailureStates
from railgrip.campaign.rare.surrogate import UNREACHABLE, Surrogate, bounds_of

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

WHOLE_SHARE = 0.1
"""Share of the runs that are drawn as they come: they bound every weight."""
LEAST_RUNS = 8
"""Runs of a component; fewer would not tell its variance."""
LEAST_POSTERIOR = 1e-5
"""A component whose state is less probable at its level is left to the other levels; with several
faces so many times more, squared, or the small components would outgrow the sample."""
SHELL = -1
"""In place of the number of a face: a shell, whose position is the distance from the centre."""
SHELL_RADIUS = 0.97
"""Where a shell begins, as a share of the least distance at which a face does."""
RARE_SHELL = 0.1
"""A shell that holds more than this is left to the runs drawn as they come."""
LEAST_IN_SHELL = 4e-4
"""Share of a shell's runs that must be rare, as the faces see it, for the shell to be drawn."""


class Component(NamedTuple):
    """One source of samples.

    Attributes
    ----------
    n_failed : int
        Number of failed units.
    face : int
        Which face it draws along, or `SHELL`.
    begins : (members,)
        Position beyond which it draws, for each state with so many failed units; −inf: everywhere.
    probability : float
        Probability of what it may draw, by the surrogate's geometry; exact.
    runs : int
        How many samples it gives.
    """

    n_failed: int
    face: int
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
        Position along the direction, or distance from the centre, that the component drew.
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
    faces: list[Surrogate], states: FailureStates, probabilities: FloatArray, runs: int
) -> list[Component]:
    """Return the components that serve all the given probabilities with about so many runs.

    Parameters
    ----------
    faces : list of Surrogate
        Where the rare runs lie.
    states : FailureStates
        What may have failed.
    probabilities : (levels,)
        Probabilities of the levels, between 0 and 1.
    runs : int
        Runs to share out; small components are rounded up.
    """
    bounds = bounds_of(faces, states, probabilities)
    begins = np.array([face.beginnings(states, bounds) for face in faces])
    counts = [np.flatnonzero(states.n_failed == count) for count in np.unique(states.n_failed)]
    found = []
    share = WHOLE_SHARE / float(sum(np.sqrt(states.weight[members].sum()) for members in counts))
    for members in counts:
        whole = float(states.weight[members].sum())
        size = max(LEAST_RUNS, round(runs * share * np.sqrt(whole)))
        everywhere = np.full(len(members), -np.inf)
        found.append(Component(int(states.n_failed[members[0]]), 0, everywhere, whole, size))
    share = (1.0 - WHOLE_SHARE) / len(probabilities)
    for level in range(len(probabilities)):
        sources = [
            source for members in counts
            for source in _sources(begins[:, level, members], states, members, faces)
        ]  # fmt: skip
        # the root gives the states that matter little their say: they may matter more than the
        # surrogate knows
        rare = np.array([source.rare for source in sources])
        posterior = rare / rare[[source.face != SHELL for source in sources]].sum()
        efficiency = rare / np.array([source.probability for source in sources])
        said = np.sqrt(posterior * efficiency) * (posterior > LEAST_POSTERIOR * len(faces) ** 2)
        for source, own in zip(sources, said / said.sum(), strict=True):
            if own > 0.0:
                size = max(LEAST_RUNS, round(runs * share * own))
                found.append(
                    Component(source.n_failed, source.face, source.begins, source.probability, size)
                )
    return found


class _Source(NamedTuple):
    """What one level might draw from: its probability, and how much of it is rare."""

    n_failed: int
    face: int
    begins: FloatArray
    probability: float
    rare: float


def _sources(
    begins: FloatArray, states: FailureStates, members: IntArray, faces: list[Surrogate]
) -> list[_Source]:
    """Return the faces of one number of failed units, (faces, members), and their shell."""
    weight, count = states.weight[members], int(states.n_failed[members[0]])
    found = []
    for face, own in enumerate(begins):
        part = float((weight * ndtr(-own)).sum())
        if part > 0.0:
            found.append(_Source(count, face, own, part, part))
    rare = sum(source.rare for source in found)
    radius = SHELL_RADIUS * np.clip(begins.min(axis=0), 0.0, UNREACHABLE)
    held = float((weight * chdtrc(faces[0].direction.shape[1], radius**2)).sum())
    if 0.0 < held < RARE_SHELL * weight.sum() and rare > LEAST_IN_SHELL * held:
        found.append(_Source(count, SHELL, radius, held, min(rare, held)))
    return found


def draw(
    chosen: list[Component],
    faces: list[Surrogate],
    states: FailureStates,
    generator: np.random.Generator,
) -> Sample:
    """Return the samples of all components."""
    variables = faces[0].direction.shape[1]
    state, position, origin = [], [], []
    for number, component in enumerate(chosen):
        members = np.flatnonzero(states.n_failed == component.n_failed)
        is_shell = component.face == SHELL
        beyond = (
            chdtrc(variables, component.begins**2) if is_shell else ndtr(-component.begins)
        )  # fmt: skip
        tails = states.weight[members] * beyond
        picked = generator.choice(len(members), component.runs, p=tails / tails.sum())
        # one uniform number in each of so many equal parts: the intervals do not count on it
        parts = generator.permutation(component.runs)
        uniform = (parts + generator.random(component.runs)) / component.runs
        if is_shell:
            position.append(np.sqrt(chdtri(variables, uniform * beyond[picked])))
        else:
            log_tail = log_ndtr(-component.begins[picked])
            position.append(-ndtri_exp(np.log(uniform) + log_tail))
        state.append(members[picked])
        origin.append(np.full(component.runs, number))
    t, row, source = np.concatenate(position), np.concatenate(state), np.concatenate(origin)
    normals = generator.standard_normal((len(t), variables))
    face = np.array([component.face for component in chosen])[source]
    for number, one in enumerate(faces):
        own = np.flatnonzero(face == number)
        along = one.direction[row[own]]
        across = np.einsum("ij,ij->i", normals[own], along)
        normals[own] += (t[own] - across)[:, None] * along
    own = np.flatnonzero(face == SHELL)
    normals[own] *= (t[own] / np.linalg.norm(normals[own], axis=1))[:, None]
    weight = _balance(chosen, faces, states, row, normals)
    return Sample(normals, row, t, weight, source)


def _balance(
    chosen: list[Component],
    faces: list[Surrogate],
    states: FailureStates,
    row: IntArray,
    normals: FloatArray,
) -> FloatArray:
    """Return one over the density of all components together, relative to the true density."""
    density = np.zeros(len(row))
    place = np.zeros(len(states.weight), dtype=np.intp)
    for count in np.unique(states.n_failed):
        members = np.flatnonzero(states.n_failed == count)
        place[members] = np.arange(len(members))
    positions = [np.einsum("ij,ij->i", normals, face.direction[row]) for face in faces]
    positions.append(np.linalg.norm(normals, axis=1))  # found at −1, the number of a shell
    for component in chosen:
        here = np.flatnonzero(states.n_failed[row] == component.n_failed)
        reached = positions[component.face][here] > component.begins[place[row[here]]]
        density[here] += reached * (component.runs / component.probability)
    return 1.0 / density
