"""Numbers and arrays at the door of the laboratory: finite, in range, not empty."""

from __future__ import annotations

import math
from typing import SupportsFloat

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.core.errors import Problem, RailgripError


def checked_number(
    name: str, value: SupportsFloat, unit: str, *, least: float, or_equal: bool = False
) -> float:
    """Return a number that is finite and above a limit.

    Raises
    ------
    RailgripError
        ``speed: must be positive and finite; got nan m/s``

    Examples
    --------
    >>> checked_number("speed", 20, "m/s", least=0.0)
    20.0
    """
    number = float(value)
    is_in = number >= least if or_equal else number > least
    if is_in and math.isfinite(number):
        return number
    words = "must not be negative" if or_equal else "must be positive"
    if least != 0.0:
        words = f"must be at least {least:g}" if or_equal else f"must be above {least:g}"
    raise RailgripError(Problem(name, f"{words} and finite", got=f"{number} {unit}".strip()))


def checked_array(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return a one-dimensional array of at least one finite number.

    Raises
    ------
    RailgripError
        ``creepage: must have at least one point``, ``creepage: point 3 is not a finite number``

    Examples
    --------
    >>> checked_array("creepage", [0, 1]).tolist()
    [0.0, 1.0]
    """
    try:
        array = np.array(values, dtype=float, ndmin=1)
    except (TypeError, ValueError) as error:
        raise RailgripError(Problem(name, "must be a row of numbers", got=str(error))) from error
    if array.ndim != 1:
        raise RailgripError(Problem(name, "must be one row", got=f"{array.ndim} dimensions"))
    if not array.size:
        raise RailgripError(Problem(name, "must have at least one point"))
    wrong = np.flatnonzero(~np.isfinite(array))
    if wrong.size:
        value = array[wrong[0]]
        raise RailgripError(
            Problem(name, f"point {wrong[0] + 1} is not a finite number", got=f"{value}")
        )
    return array
