"""A rail that varies at random along the line, the same for the same seed on every machine.

Random numbers are counter-based (Philox4x32-10): key = seed, counter = (cell, run, stream), so a
run finds the same rail whatever was run before it, beside it, or on how many threads.
"""

from __future__ import annotations

import math

MASK_32 = 0xFFFFFFFF
_ROUNDS = 10


def philox_4x32(
    counter0: int, counter1: int, counter2: int, counter3: int, key0: int, key1: int
) -> tuple[int, int, int, int]:
    """Return four random 32-bit words (Philox4x32-10).

    Parameters
    ----------
    counter0, counter1, counter2, counter3 : int
        Counter words, 0 … 2³²−1.
    key0, key1 : int
        Key words, 0 … 2³²−1.

    Returns
    -------
    tuple of four int
        Uniform 32-bit words.

    References
    ----------
    J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, Parallel random numbers: as easy as 1, 2,
    3, SC11 (2011), doi 10.1145/2063384.2063405.

    Checked by tests/reference/philox: the known-answer vectors of the authors' library.

    Examples
    --------
    >>> hex(philox_4x32(0, 0, 0, 0, 0, 0)[0])
    '0x6627e8d5'
    """
    for _ in range(_ROUNDS):
        product0 = 0xD2511F53 * counter0
        product1 = 0xCD9E8D57 * counter2
        high0, low0 = (product0 >> 32) & MASK_32, product0 & MASK_32
        high1, low1 = (product1 >> 32) & MASK_32, product1 & MASK_32
        counter0, counter1, counter2, counter3 = (
            high1 ^ counter1 ^ key0,
            low1,
            high0 ^ counter3 ^ key1,
            low0,
        )
        key0 = (key0 + 0x9E3779B9) & MASK_32
        key1 = (key1 + 0xBB67AE85) & MASK_32
    return counter0, counter1, counter2, counter3


def standard_normal(cell: int, run: int, stream: int, seed: int) -> float:
    """Return a standard normal number that belongs to a cell of a run (Box and Muller).

    Parameters
    ----------
    cell, run, stream, seed : int
        Non-negative; together they name the number.

    Examples
    --------
    >>> round(standard_normal(7, 0, 0, 1), 6) == round(standard_normal(7, 0, 0, 1), 6)
    True
    """
    word0, word1, word2, word3 = philox_4x32(
        cell & MASK_32, run & MASK_32, stream, 0, seed & MASK_32, (seed >> 32) & MASK_32
    )
    uniform0 = (word0 * 67108864 + (word1 >> 6) + 0.5) / 2.0**58
    uniform1 = (word2 * 67108864 + (word3 >> 6) + 0.5) / 2.0**58
    return math.sqrt(-2.0 * math.log(uniform0)) * math.cos(2.0 * math.pi * uniform1)


def next_field_value(previous: float, correlation: float, normal: float) -> float:
    """Return the standard field one cell on: a first-order autoregression.

    Parameters
    ----------
    previous : float
        Field in the cell before; standard normal.
    correlation : float
        exp(−cell length/correlation length), 0 … 1.
    normal : float
        Fresh standard normal number.

    Notes
    -----
    Its autocorrelation over a distance d is exp(−d/correlation length), whatever the cell length
    (an exponential, "Ornstein–Uhlenbeck" field sampled exactly).

    Examples
    --------
    >>> next_field_value(1.0, 0.6, 0.5)
    1.0
    """
    return correlation * previous + math.sqrt(1.0 - correlation * correlation) * normal


def lognormal_factor(field: float, relative_spread: float) -> float:
    """Return the factor on the mean friction: lognormal with mean 1, so friction stays positive.

    Parameters
    ----------
    field : float
        Standard normal field value.
    relative_spread : float
        Standard deviation over mean, ≥ 0.

    Examples
    --------
    >>> lognormal_factor(0.0, 0.0)
    1.0
    """
    variance = math.log(1.0 + relative_spread * relative_spread)
    return math.exp(math.sqrt(variance) * field - 0.5 * variance)
