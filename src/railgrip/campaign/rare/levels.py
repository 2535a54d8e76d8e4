"""Confidence levels of the emergency brake (EBCL 0 … 9) as probabilities."""

from __future__ import annotations

from typing import Final

EBCL: Final[tuple[int, ...]] = tuple(range(10))
"""Emergency brake confidence levels of ETCS."""


def shortfall_probability(level: int) -> float:
    """Return the probability with which a train may brake worse than the level promises.

    Parameters
    ----------
    level : int
        EBCL, 0 … 9.

    Returns
    -------
    probability : float
        One minus the confidence: 0.5 for EBCL 0, then 10⁻¹ … 10⁻⁹.

    References
    ----------
    .. [1] UNISIG SUBSET-026 §3.13, M_NVEBCL: 50, 90, 99 … 99.9999999 %.

    Examples
    --------
    >>> shortfall_probability(9)
    1e-09
    """
    return 0.5 if level == 0 else float(f"1e-{level}")


SHORTFALLS: Final[tuple[float, ...]] = tuple(shortfall_probability(level) for level in EBCL)
"""Probabilities of EBCL 0 … 9 in this order."""
