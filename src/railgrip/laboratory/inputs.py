"""Numbers that a user hands to the laboratory: arrays of one shape, in range, or a clear word."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NoReturn

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
