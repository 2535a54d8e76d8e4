"""Uniform numbers for the runs of a campaign: run i gets the same in any chunk, on any machine.

Random numbers are counter-based (Philox4x64-10, numpy): the key is the campaign's seed and the
column's name, the counter is the run. So a column keeps its numbers when others are added, and two
designs are drawn alike.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from functools import lru_cache
from typing import Any, Literal

import numpy as np

from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.plan import FloatArray

Method = Literal["random", "sobol", "latin"]
_PER_COUNTER = 4
_ROUNDS = 6


def stream_of(name: str) -> int:
    """Return the second key word that belongs to a column's name.

    Examples
    --------
    >>> stream_of("mass") == stream_of("mass") != stream_of("speed")
    True
    """
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:8], "little")


def random_column(seed: int, name: str, first: int, last: int) -> FloatArray:
    """Return uniform numbers of the runs first … last − 1, inside (0, 1).

    Examples
    --------
    >>> whole = random_column(1, "mass", 0, 10)
    >>> bool((random_column(1, "mass", 3, 10) == whole[3:]).all())
    True
    """
    begin = first // _PER_COUNTER
    generator = np.random.Philox(key=[seed, stream_of(name)], counter=[begin, 0, 0, 0])
    words = generator.random_raw(last - _PER_COUNTER * begin)[first - _PER_COUNTER * begin :]
    uniform: FloatArray = ((words >> np.uint64(11)).astype(np.float64) + 0.5) * 2.0**-53
    return uniform


def uniform_numbers(
    method: Method, seed: int, names: Sequence[str], first: int, last: int, runs: int
) -> FloatArray:
    """Return the uniform numbers (run, column) of the runs first … last − 1.

    Parameters
    ----------
    method : str
        ``random``, ``sobol`` (scrambled) or ``latin`` (hypercube over all `runs`).
    seed : int
        Of the campaign.
    names : sequence of str
        Of the columns; random and latin columns depend on their names only, Sobol's on the order.
    first, last : int
        Runs.
    runs : int
        Of the whole campaign; a Latin hypercube is laid out over them.

    Raises
    ------
    RailgripError
        ``sampling.method: a Latin hypercube has as many runs as it was laid out for; …``

    References
    ----------
    .. [1] J. K. Salmon and others, Parallel random numbers: as easy as 1, 2, 3, SC11 (2011).
    .. [2] S. Joe, F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections,
       SIAM J. Sci. Comput. 30 (2008) 2635–2654.

    Examples
    --------
    >>> uniform_numbers("sobol", 1, ["mass", "speed"], 0, 4, 4).shape
    (4, 2)
    """
    if method == "sobol":
        return _sobol(seed, len(names), first, last)
    if method == "latin":
        if last > runs:
            what = "a Latin hypercube has as many runs as it was laid out for"
            raise RailgripError(
                Problem("sampling.method", what, f"{last}", f"up to {runs}", "method = 'random'")
            )
        columns = [_latin(seed, name, first, last, runs) for name in names]
    else:
        columns = [random_column(seed, name, first, last) for name in names]
    return np.stack(columns, axis=1) if columns else np.zeros((last - first, 0))


@lru_cache(maxsize=4)
def _sobol_matrix(seed: int, columns: int) -> Any:
    from scipy.stats import qmc

    return qmc.Sobol(columns, scramble=True, seed=np.random.default_rng(seed))


def _sobol(seed: int, columns: int, first: int, last: int) -> FloatArray:
    if columns == 0:
        return np.zeros((last - first, 0))
    import copy

    sequence = copy.deepcopy(_sobol_matrix(seed, columns))
    if first:
        sequence.fast_forward(first)
        points = sequence.random(last - first)
    else:  # the first point alone: any number of the others then comes without a warning
        points = np.vstack([sequence.random(1), sequence.random(last - 1)])
    return np.asarray(points) + 2.0**-31  # the middle of each cell of the 30 bits, never 0


def _latin(seed: int, name: str, first: int, last: int, runs: int) -> FloatArray:
    place = permuted(np.arange(first, last, dtype=np.uint64), runs, seed ^ stream_of(name))
    within = random_column(seed, f"{name} within its stratum", first, last)
    return (place + within) / runs  # type: ignore[no-any-return]


def permuted(index: Any, n: int, key: int) -> Any:
    """Return where a pseudo-random permutation of 0 … n − 1 sends the indices, without a table.

    A Feistel network over the next power of four; what falls outside goes through it again.

    Examples
    --------
    >>> sorted(int(i) for i in permuted(np.arange(7, dtype=np.uint64), 7, 42))
    [0, 1, 2, 3, 4, 5, 6]
    """
    half = max(1, -(-max(n - 1, 1).bit_length() // 2))
    result = _feistel(index, half, key)
    while (outside := result >= n).any():
        result[outside] = _feistel(result[outside], half, key)
    return result


def _feistel(index: Any, half: int, key: int) -> Any:
    mask = np.uint64((1 << half) - 1)
    left, right = index >> np.uint64(half), index & mask
    for turn in range(_ROUNDS):
        # splitmix64's finaliser as the round function
        salt = np.uint64((key + turn * 0x9E3779B97F4A7C15) & 0xFFFFFFFFFFFFFFFF)
        mixed = right + salt
        mixed = (mixed ^ (mixed >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        mixed = (mixed ^ (mixed >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        left, right = right, left ^ ((mixed ^ (mixed >> np.uint64(31))) & mask)
    return (left << np.uint64(half)) | right
