"""Numbers that a user hands to the laboratory: arrays of one shape, in range, or a clear word."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NoReturn, SupportsFloat

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.core.errors import Problem, RailgripError

FloatArray = NDArray[np.float64]


def as_floats(name: str, value: ArrayLike) -> FloatArray:
    """Return the value as an array of floats, or say which quantity is none.

    Examples
    --------
    >>> as_floats("speed", [10, 20])
    array([10., 20.])
    """
    try:
        return np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise RailgripError(
            Problem("", f"the {name} must be a number or an array of numbers", got=repr(value))
        ) from error


def common_shape(columns: Mapping[str, FloatArray]) -> tuple[int, ...]:
    """Return the shape that the named arrays broadcast to, or say that they do not fit.

    Examples
    --------
    >>> common_shape({"speed": np.zeros((3, 1)), "creepage": np.zeros(5)})
    (3, 5)
    """
    try:
        return np.broadcast_shapes(*(column.shape for column in columns.values()))
    except ValueError as error:
        shapes = ", ".join(f"{name} {column.shape}" for name, column in columns.items())
        raise RailgripError(
            Problem(
                "",
                "the arrays do not fit together",
                got=shapes,
                cure="arrays of one shape, or shapes that NumPy broadcasts, as (3, 1) and (5,)",
            )
        ) from error


def checked_points(
    speed: ArrayLike, load: ArrayLike, longitudinal: ArrayLike, lateral: ArrayLike, spin: ArrayLike
) -> tuple[FloatArray, ...]:
    """Return speed, load, creepages and spin in one shape, or say which of them is out of range.

    Examples
    --------
    >>> [each.shape for each in checked_points(20.0, 1e5, [0.0, 0.01], 0.0, 0.0)]
    [(2,), (2,), (2,), (2,), (2,)]
    """
    given = {
        "speed": (speed, "m/s"),
        "load": (load, "N"),
        "longitudinal creepage": (longitudinal, ""),
        "lateral creepage": (lateral, ""),
        "spin": (spin, "1/m"),
    }
    columns = {name: as_floats(name, value) for name, (value, _) in given.items()}
    for name, (_, unit) in given.items():
        refuse_bad_values(name, columns[name], unit, positive=name in ("speed", "load"))
    shape = common_shape(columns)
    return tuple(np.broadcast_to(column, shape).copy() for column in columns.values())


def refuse_bad_values(name: str, column: FloatArray, unit: str, *, positive: bool) -> None:
    """Refuse NaN and infinite values and, where a quantity must be positive, zero and below."""
    good = np.isfinite(column) & (column > 0.0) if positive else np.isfinite(column)
    if not good.all():
        refuse(name, float(column[~good].flat[0]), unit, positive=positive)


def refuse(name: str, value: float, unit: str, *, positive: bool) -> NoReturn:
    """Say which quantity is out of range, and what it was."""
    raise RailgripError(
        Problem(
            "",
            f"the {name} must be {'positive and ' if positive else ''}finite",
            got=f"{value:g} {unit}".rstrip(),
        )
    )


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


def checked_array(name: str, values: ArrayLike) -> FloatArray:
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
