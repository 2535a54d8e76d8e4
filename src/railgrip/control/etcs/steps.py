"""A quantity that changes in steps: over speed, position or train length."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable
from itertools import pairwise
from typing import NamedTuple


class Steps(NamedTuple):
    """Values that hold from a place upwards; before the first place the first value holds.

    Parameters
    ----------
    begins : tuple of float
        Where each value begins, ascending, [m/s] or [m].
    values : tuple of float
        One for each beginning.

    Examples
    --------
    >>> Steps((0.0, 20.0), (1.2, 0.9)).at(25.0)
    0.9
    """

    begins: tuple[float, ...]
    values: tuple[float, ...]

    def at(self, place: float) -> float:
        """Return the value that holds at a place."""
        return self.values[max(bisect_right(self.begins, place) - 1, 0)]

    def scaled(self, factor: float) -> Steps:
        """Return the steps with every value times a factor."""
        return Steps(self.begins, tuple(factor * value for value in self.values))


def constant(value: float) -> Steps:
    """Return one value for everywhere.

    Examples
    --------
    >>> constant(1.0).at(-5.0)
    1.0
    """
    return Steps((0.0,), (value,))


def combined(rule: Callable[..., float], *parts: Steps) -> Steps:
    """Return the steps of a function of several steps over the same axis.

    Examples
    --------
    >>> combined(lambda a, b: a * b, Steps((0.0, 10.0), (1.0, 2.0)), Steps((0.0, 5.0), (3.0, 4.0)))
    Steps(begins=(0.0, 5.0, 10.0), values=(3.0, 4.0, 8.0))
    """
    begins = tuple(sorted({begin for part in parts for begin in part.begins}))
    return Steps(begins, tuple(rule(*(part.at(begin) for part in parts)) for begin in begins))


def breaks(parts: Iterable[Steps]) -> list[float]:
    """Return where anything changes, ascending.

    Examples
    --------
    >>> breaks([Steps((0.0, 10.0), (1.0, 2.0)), constant(1.0)])
    [10.0]
    """
    return sorted(
        {
            begin
            for part in parts
            for begin, (before, after) in zip(part.begins[1:], pairwise(part.values), strict=True)
            if before != after
        }
    )
