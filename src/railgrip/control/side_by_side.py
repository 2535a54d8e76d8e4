"""Sixteen axles at one blow: their columns copied, their values counted and compared.

The passes over the axles are loops, which the compiler packs. What only moves or gathers sixteen
values is told it outright (`railgrip.intrinsics`): of such short loops it makes more to do around
the values than with them.
"""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.state_layout import GROUP


def take(state: FloatArray, place: int, table: FloatArray, axle: int, column: int) -> None:
    """Put one column of a table into the state for the sixteen axles from one on.

    Places beyond the last axle get 0.

    Examples
    --------
    >>> import numpy as np
    >>> state = np.full(32, 9.0)
    >>> take(state, 16, np.array([[1.0, 2.0], [3.0, 4.0]], order="F"), 0, 1)
    >>> state[15:20]
    array([9., 2., 4., 0., 0.])
    """
    values = table[axle : axle + GROUP, column]
    state[place : place + len(values)] = values
    state[place + len(values) : place + GROUP] = 0.0


def give(table: FloatArray, axle: int, column: int, state: FloatArray, place: int) -> None:
    """Write one column of a table for the sixteen axles from one on, as far as there are axles.

    Examples
    --------
    >>> import numpy as np
    >>> table = np.zeros((2, 2), order="F")
    >>> give(table, 0, 1, np.arange(32.0), 16)
    >>> table[:, 1]
    array([16., 17.])
    """
    values = table[axle : axle + GROUP, column]
    values[:] = state[place : place + len(values)]


def give_all(table: FloatArray, axle: int, column: int, value: float) -> None:
    """Write one value for the sixteen axles from one on, as far as there are axles.

    Examples
    --------
    >>> import numpy as np
    >>> table = np.zeros((2, 2), order="F")
    >>> give_all(table, 0, 1, 3.0)
    >>> table[:, 1]
    array([3., 3.])
    """
    table[axle : axle + GROUP, column] = value


def move(state: FloatArray, to: int, place: int) -> None:
    """Copy sixteen values within the state.

    Examples
    --------
    >>> import numpy as np
    >>> state = np.arange(32.0)
    >>> move(state, 0, 16)
    >>> float(state[1])
    17.0
    """
    state[to : to + GROUP] = state[place : place + GROUP]


def total(state: FloatArray, place: int) -> float:
    """Return the sum of sixteen values, first half and second half added, and so on.

    One after the other each addition would wait for the one before.

    Examples
    --------
    >>> import numpy as np
    >>> total(np.arange(32.0), 16)
    376.0
    """
    values = state[place : place + GROUP]
    while len(values) > 1:
        half = len(values) // 2
        values = values[:half] + values[half:]
    return float(values[0])


def greatest(state: FloatArray, place: int) -> float:
    """Return the greatest of sixteen values, none of which is NaN.

    Examples
    --------
    >>> import numpy as np
    >>> greatest(np.arange(32.0), 16)
    31.0
    """
    return float(state[place : place + GROUP].max())


def count_equal(state: FloatArray, place: int, value: float) -> int:
    """Return how many of sixteen values are equal to one.

    Examples
    --------
    >>> import numpy as np
    >>> count_equal(np.arange(32.0) % 8, 16, 3.0)
    2
    """
    return int((state[place : place + GROUP] == value).sum())


def count_above(state: FloatArray, place: int, bound: float, but: int) -> int:
    """Return how many of sixteen values lie above a bound, where those from `but` on are 0.

    Examples
    --------
    >>> import numpy as np
    >>> state = np.arange(48.0)
    >>> state[32:40] = 0.0
    >>> count_above(state, 16, 20.5, 32)
    3
    """
    is_above = state[place : place + GROUP] > bound
    return int((is_above & (state[but : but + GROUP] == 0.0)).sum())
