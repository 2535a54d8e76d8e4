"""The band of slopes between two stiffnesses of the surface (Čáp 2000, figure 2.2)."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.contact.freibauer_curve import (
    elliptic_stress_growth,
    freibauer_adhesion,
    freibauer_slope,
)
from railgrip.contact.input_checks import refuse_not_positive
from railgrip.contact.surface_stiffness import STIFFNESS_BAND, SURFACE_STIFFNESS
from railgrip.core.errors import Problem, RailgripError

Array = NDArray[np.float64]


class SlopeBand(NamedTuple):
    """Creep curves and their slopes for a soft, the usual and a stiff surface.

    Parameters
    ----------
    stiffness : ndarray (stiffness)
        K, rising [N/m³].
    creepage : ndarray (creepage)
        s [-].
    adhesion : ndarray (stiffness, creepage)
        μ(s) by Freibauer's curve [-].
    slope : ndarray (stiffness, creepage)
        c_μs = dμ/ds [per unit creepage]; times the load it is dT/ds.
    """

    stiffness: Array
    creepage: Array
    adhesion: Array
    slope: Array


def slope_band(
    creepage: ArrayLike,
    load: float,
    a: float,
    b: float,
    friction: float,
    stiffness: tuple[float, ...] = (STIFFNESS_BAND[0], SURFACE_STIFFNESS, STIFFNESS_BAND[1]),
) -> SlopeBand:
    """Adhesion and slope of an elliptic patch for stiffnesses of the surface.

    Choose it to see how much the unknown K leaves open.

    Parameters
    ----------
    creepage : array_like (creepage)
        Creepages s, signed [-].
    load : float
        Wheel load Q, > 0 [N].
    a, b : float
        Semi-axes along and across the track, > 0 [m].
    friction : float
        Friction coefficient φ, > 0 [-].
    stiffness : tuple of float
        K, > 0 [N/m³].

    Returns
    -------
    SlopeBand
        One row a stiffness.

    Raises
    ------
    RailgripError
        "the load must be positive and finite" and likewise for the others; "the creepage must be
        finite".

    Notes
    -----
    c_μs = (4/π)(1/ρ)/(1 + ε²)², 1/ρ = (2π/3) a² b K/Q, K = 15 … 25·10¹² N/m³. At ε = 0 the slope is
    proportional to K, −25 … +25 % about the usual one, and independent of φ. Further on the order
    turns round: a stiff surface slides sooner.
    The paper prints K with 10⁹ N/m³; it means kN/m³.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 2.6, 2.7a, figure 2.2.

    Checked by tests/unit/laboratory/test_slope_band.py.

    Examples
    --------
    >>> band = slope_band([0.0], 100e3, 7.2e-3, 5.4e-3, 0.3)
    >>> np.round(band.slope[:, 0], 2).tolist()
    [111.97, 149.3, 186.62]
    """
    refuse_not_positive((("friction", friction, "-"),))
    places: Array = np.atleast_1d(np.asarray(creepage, dtype=np.float64))
    if not np.isfinite(places).all():
        raise RailgripError(Problem("", "the creepage must be finite"))
    growths = [elliptic_stress_growth(load, a, b, each) for each in stiffness]
    return SlopeBand(
        np.array(stiffness),
        places,
        _table(freibauer_adhesion, friction, growths, places),
        _table(freibauer_slope, friction, growths, places),
    )


def _table(
    formula: Callable[[float, float, float], float],
    friction: float,
    growths: list[float],
    creepage: Array,
) -> Array:
    """One row a growth of the stress, one column a creepage."""
    return np.array([[formula(friction, growth, float(s)) for s in creepage] for growth in growths])
