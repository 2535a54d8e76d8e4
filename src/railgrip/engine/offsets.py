"""The layout's numbers as unsigned integers, for the loops over lanes.

A signed index may be negative, which Numba handles with a select that hides from LLVM that
neighbouring lanes are neighbours in memory; with unsigned ones the loops become packed.
"""

from __future__ import annotations

import numpy as np

from railgrip.compiler import inlined
from railgrip.engine import layout

ONE_LANE = (0,)
SIXTEEN_LANES = (0,) * layout.LANES
"""Tuples stand for their length: Numba knows it when it compiles a pass, so that LLVM does too."""


@inlined
def width(lanes: tuple[int, ...]) -> np.uint64:
    """Return the number of lanes."""
    return np.uint64(len(lanes))


@inlined
def as_offset(number: int) -> np.uint64:
    """Return a non-negative integer as an unsigned one."""
    return np.uint64(number)


def __getattr__(name: str) -> np.uint64:
    return np.uint64(getattr(layout, name))
