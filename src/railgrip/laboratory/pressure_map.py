"""Maps of the pressure over an elliptic or a rectangular patch."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.contact.rectangular_patch import RectangularPatch
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.patch import HertzPatch

Array = NDArray[np.float64]

_MOST_CELLS = 4000


class PressureMap(NamedTuple):
    """Pressure at the centres of equal cells that cover the patch.

    Parameters
    ----------
    x : ndarray (along)
        Places along the track, from the centre [m].
    y : ndarray (across)
        Places across the track, from the centre [m].
    pressure : ndarray (across, along)
        Pressure, 0 outside the patch [Pa].
    """

    x: Array
    y: Array
    pressure: Array


def pressure_map(patch: HertzPatch | RectangularPatch, cells: int = 100) -> PressureMap:
    """Pressure over a patch, on a grid as long and as wide as the patch.

    The scalar forms are `elliptic_pressure` and `rectangular_pressure`.

    Parameters
    ----------
    patch : HertzPatch or RectangularPatch
        From `hertz_1882` or `rectangular_patch`.
    cells : int
        How many cells lie along and across the track each, 2 … 4000.

    Returns
    -------
    PressureMap
        Places and pressures.

    Raises
    ------
    RailgripError
        "the number of cells is out of range; got 1; allowed: 2 … 4000".

    Notes
    -----
    p = p_m √(1 − (x/a)² − (y/b)²) (1.9), or p_m √(1 − (x/a)²) (1.13).

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 1.9, 1.13.

    Checked by tests/unit/laboratory/test_pressure_map.py: against the scalar forms, and its sum
    against the load.

    Examples
    --------
    >>> found = pressure_map(HertzPatch(6e-3, 4e-3, 1e9, 0.0), cells=3)
    >>> np.round(found.pressure[1] / 1e6).tolist()
    [745.0, 1000.0, 745.0]
    """
    if not 2 <= cells <= _MOST_CELLS:
        raise RailgripError(
            Problem(
                "",
                "the number of cells is out of range",
                got=f"{cells}",
                allowed=f"2 … {_MOST_CELLS}",
            )
        )
    centre: Array = (2.0 * np.arange(cells) + 1.0 - cells) / cells
    is_ellipse = isinstance(patch, HertzPatch)
    half_width = patch.b if isinstance(patch, HertzPatch) else 0.5 * patch.width
    across: Any = centre[:, None] if is_ellipse else np.zeros((cells, 1))
    inside = np.maximum(1.0 - centre[None, :] ** 2 - across**2, 0.0)
    pressure: Array = patch.greatest_pressure * np.sqrt(inside)
    return PressureMap(patch.a * centre, half_width * centre, pressure)
