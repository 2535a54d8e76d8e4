"""What may have failed: every state of the units with its exact probability.

Units fail independently, each with its own probability. States of units that are alike are counted
once: which two of sixteen equal brakes have failed does not matter, only that there are two.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Hashable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.core.errors import Problem, RailgripError

FloatArray = NDArray[np.float64]

NEGLIGIBLE = 1e-13
"""States beyond are left out once their probability together is below; the least of a level is
1e-9, so that they shift it by 1e-4 of itself. The intervals contain them."""
MOST_STATES = 100_000


class FailureStates(NamedTuple):
    """The states of the units, most of them working.

    Attributes
    ----------
    failed : (states, units) bool
        Which units have failed.
    weight : (states,)
        Probability of each state.
    n_failed : (states,) int
        How many units have failed.
    left_out : float
        Probability of all states that are not listed.
    """

    failed: NDArray[np.bool_]
    weight: FloatArray
    n_failed: NDArray[np.intp]
    left_out: float


def failure_states(
    probabilities: Sequence[float] | FloatArray,
    kinds: Sequence[Hashable] | None = None,
    *,
    negligible: float = NEGLIGIBLE,
) -> FailureStates:
    """Return the states of independent units, each with its exact probability.

    Parameters
    ----------
    probabilities : (units,)
        Probability that a unit has failed, 0 … 1 each.
    kinds : (units,), optional
        A label for each unit. Units with the same label are alike: they have the same
        probability, and what happens does not depend on which of them has failed. Without labels
        no two units are alike.
    negligible : float
        States with more failed units are left out once all of them together are less probable.

    Returns
    -------
    states : FailureStates
        Ordered by the number of failed units. Of units that are alike, the first ones fail.

    Raises
    ------
    RailgripError
        ``unit 3: the probability of failure must lie between 0 and 1; got 1.2``

    Examples
    --------
    >>> states = failure_states([1e-3] * 16, ["brake"] * 16)
    >>> [int(n) for n in states.n_failed], float(states.weight[2].round(8))
    ([0, 1, 2, 3, 4, 5], 0.00011833)
    """
    chances = np.asarray(probabilities, dtype=float)
    labels: list[Hashable] = list(range(len(chances))) if kinds is None else list(kinds)
    _check(chances, labels)
    beyond = _more_than(chances)
    members: dict[Hashable, list[int]] = {}
    for unit, label in enumerate(labels):
        members.setdefault(label, []).append(unit)
    groups = list(members.values())
    # the last entry is exactly 0: no more than all can fail
    most = int(np.argmax((beyond < negligible) | (beyond <= 0.0)))
    _refuse_too_many([len(group) for group in groups], most)
    rows: list[NDArray[np.bool_]] = []
    weights: list[float] = []
    for count in range(most + 1):
        for split in _splits(count, [len(group) for group in groups]):
            weight = _weight(split, groups, chances)
            if weight > 0.0:
                rows.append(_state(split, groups, len(chances)))
                weights.append(weight)
    failed = np.array(rows, dtype=bool).reshape(len(rows), len(chances))
    return FailureStates(failed, np.array(weights), failed.sum(axis=1), float(beyond[most]))


def _check(chances: FloatArray, labels: list[Hashable]) -> None:
    problems = [
        Problem(f"unit {unit}", "the probability of failure must lie between 0 and 1", got=f"{q:g}")
        for unit, q in enumerate(chances)
        if not 0.0 <= q <= 1.0
    ]
    if len(labels) != len(chances):
        problems.append(
            Problem("kinds", "needs one label for each unit", got=f"{len(labels)}")
        )  # fmt: skip
    else:
        first: dict[Hashable, float] = {}
        for label, q in zip(labels, chances, strict=True):
            if first.setdefault(label, q) != q:
                what = "units of one kind must fail with one probability"
                problems.append(Problem(f"kind {label}", what, got=f"{first[label]:g} and {q:g}"))
    if problems:
        raise RailgripError(problems)


def _refuse_too_many(sizes: list[int], most: int) -> None:
    """Count the states before they are made: coefficients of Π (1 + x + … + xⁿ)."""
    ways = np.ones(1)
    for size in sizes:
        ways = np.convolve(ways, np.ones(size + 1))[: most + 1]
    if ways.sum() > MOST_STATES:
        what = f"more than {MOST_STATES} states of the units are probable"
        cure = "give units that are alike the same kind"
        got = f"{sum(sizes)} units of {len(sizes)} kinds"
        raise RailgripError(Problem("failures", what, got=got, cure=cure))


def _more_than(chances: FloatArray) -> FloatArray:
    """Return the probability that more than 0, 1, … n units fail (summed from the small end)."""
    exactly = np.array([1.0])
    for q in chances:
        exactly = np.append(exactly * (1.0 - q), 0.0) + np.append(0.0, exactly * q)
    return np.append(np.cumsum(exactly[::-1])[::-1][1:], 0.0)


def _splits(count: int, sizes: list[int]) -> Iterator[tuple[int, ...]]:
    """Yield how many of each kind fail if so many fail altogether."""
    if all(size == 1 for size in sizes):
        for chosen in itertools.combinations(range(len(sizes)), count):
            yield tuple(int(kind in chosen) for kind in range(len(sizes)))
        return
    if not sizes:
        if count == 0:
            yield ()
        return
    for here in range(min(count, sizes[0]) + 1):
        if count - here <= sum(sizes[1:]):
            for rest in _splits(count - here, sizes[1:]):
                yield (here, *rest)


def _weight(split: tuple[int, ...], groups: list[list[int]], chances: FloatArray) -> float:
    weight = 1.0
    for failed, group in zip(split, groups, strict=True):
        q, n = float(chances[group[0]]), len(group)
        weight *= math.comb(n, failed) * q**failed * (1.0 - q) ** (n - failed)
    return weight


def _state(split: tuple[int, ...], groups: list[list[int]], units: int) -> NDArray[np.bool_]:
    state = np.zeros(units, dtype=bool)
    for failed, group in zip(split, groups, strict=True):
        state[group[:failed]] = True
    return state
