"""Numbers and courses that contact temperatures are computed from: in range, or a clear word."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.inputs import as_floats

Array = NDArray[np.float64]


def one_number(
    name: str, value: ArrayLike, unit: str, *, least: float = -math.inf, is_above: bool = False
) -> float:
    """Return one finite number, at least (or above) a limit of zero.

    Raises
    ------
    RailgripError
        "load: must be positive and finite; got 0 N" and the like.

    Examples
    --------
    >>> one_number("load", 100e3, "N", least=0.0, is_above=True)
    100000.0
    """
    given = as_floats(_words(name), value)
    if given.ndim:
        raise RailgripError(Problem(name, "must be one number", got=f"shape {given.shape}"))
    number = float(given)
    is_in = number > least if is_above else number >= least
    if is_in and math.isfinite(number):
        return number
    got = f"{number:g} {unit}".strip()
    raise RailgripError(Problem(name, _rule(least, is_above=is_above), got=got))


def rising(name: str, values: ArrayLike) -> Array:
    """Return a row of two or more finite numbers, each above the one before.

    Examples
    --------
    >>> rising("time", [0, 1]).tolist()
    [0.0, 1.0]
    """
    row = as_floats(_words(name), values)
    is_row = row.ndim == 1 and row.size >= 2 and bool(np.all(np.isfinite(row)))
    if is_row and bool(np.all(np.diff(row) > 0.0)):
        return row
    raise RailgripError(
        Problem(name, f"the {_words(name)} must rise", cure="two or more finite numbers, in order")
    )


def course(
    name: str, values: ArrayLike, count: int, *, of: str = "time", least: float = -math.inf
) -> Array:
    """Return one finite number for each time (wheel, …) from a row, or from one for all.

    Examples
    --------
    >>> course("power", 5.0, 3).tolist()
    [5.0, 5.0, 5.0]
    """
    given = as_floats(_words(name), values)
    if given.shape not in ((), (count,)):
        what = f"one value for each {of}, or one for all"
        raise RailgripError(Problem(name, what, got=f"shape {given.shape} for {count}"))
    wrong = given[~(np.isfinite(given) & (given >= least))]
    if wrong.size:
        raise RailgripError(Problem(name, _rule(least, is_above=False), got=f"{wrong.flat[0]:g}"))
    return np.broadcast_to(given, (count,))


def _rule(least: float, *, is_above: bool) -> str:
    if least == -math.inf:
        return "must be a finite number"
    return "must be positive and finite" if is_above else "must be zero or more, and finite"


def _words(name: str) -> str:
    return name.replace("_", " ").replace(".", " ")
