"""How the initial slope of the creep curve changes as an S1002 wheel shifts across the rail."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.contact.input_checks import refuse_not_positive
from railgrip.contact.kalker_1990 import kalker_coefficients
from railgrip.contact.s1002 import s1002
from railgrip.contact.s1002_contact import s1002_radii
from railgrip.contact.surface_stiffness import SURFACE_STIFFNESS, stiffness_slope
from railgrip.core.formulas.patch import hertz_1882

Array = NDArray[np.float64]


class SlopeOverShift(NamedTuple):
    """Contact of an S1002 wheel by place of contact; NaN where Hertz has no solution.

    Parameters
    ----------
    position : ndarray (position)
        Place of contact on the profile, positive towards the field side [m].
    transverse_radius : ndarray (position)
        Of the tread [m]; negative: concave; known everywhere.
    conicity : ndarray (position)
        Local slope of the tread [-]; known everywhere.
    a, b : ndarray (position)
        Semi-axes along and across the track [m].
    slope_by_stiffness : ndarray (position)
        (8/3) a² b K [N per unit creepage].
    slope_by_kalker : ndarray (position)
        G a b C11 of Kalker's table [N per unit creepage].
    """

    position: Array
    transverse_radius: Array
    conicity: Array
    a: Array
    b: Array
    slope_by_stiffness: Array
    slope_by_kalker: Array


def slope_over_shift(
    positions: ArrayLike,
    load: float,
    wheel_radius: float,
    rail_transverse_radius: float,
    young: float = 210e9,
    poisson: float = 0.28,
    stiffness: float = SURFACE_STIFFNESS,
) -> SlopeOverShift:
    """Ellipse and initial slope by the place where an S1002 wheel touches a round rail head.

    Choose it for the step that Čáp's paper announces and leaves out. The place of contact is given,
    not looked for: it is not the shift of the wheelset.

    Parameters
    ----------
    positions : array_like (position)
        Places y on the profile, −0.070 … 0.060 [m].
    load : float
        Normal force Q, > 0 [N].
    wheel_radius : float
        Radius at the running circle, > 0 [m].
    rail_transverse_radius : float
        Radius of the rail where it is touched, > 0 [m].
    young, poisson : float
        Young's modulus [Pa] and Poisson's ratio [-] of both bodies.
    stiffness : float
        Tangential stiffness of the surface K [N/m³].

    Returns
    -------
    SlopeOverShift
        Arrays; NaN where the hollow of the tread is as round as the head, or rounder.

    Raises
    ------
    RailgripError
        "the position is off the profile S1002"; for load, radii or material out of range.

    Notes
    -----
    r1y of the profile enters Hertz with its sign. On a head of 0.3 m there is no solution from
    y = −1.23 mm towards the flange; as that place is neared from outside the ellipse grows across
    the track without end, and the half-space theory fails before. At the back of the flange, where
    the profile is vertical, there is none either.
    Known wrong where the radius changes within the ellipse: the paper says so too.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       sections on the profile UIC-ORE and after (2.12a).

    Checked by tests/unit/laboratory/test_slope_over_shift.py: against `s1002_contact`.

    Examples
    --------
    >>> found = slope_over_shift([-0.008, 0.003, 0.008], 100e3, 0.46, 0.3)
    >>> np.round(found.slope_by_kalker / 1e6, 2).tolist()
    [nan, 19.27, 16.35]
    """
    refuse_not_positive(
        (("load", load, "N"), ("radius of the rail head", rail_transverse_radius, "m"))
    )
    places: Array = np.atleast_1d(np.asarray(positions, dtype=np.float64))
    rows = np.full((7, places.size), math.nan)
    shear_modulus = young / (2.0 * (1.0 + poisson))
    for index, place in enumerate(places.flat):
        radii = s1002_radii(wheel_radius, float(place))
        rows[0, index], rows[1, index] = place, radii.across
        rows[2, index] = s1002(float(place)).conicity
        if math.isinf(radii.along) or 1.0 / radii.across + 1.0 / rail_transverse_radius <= 0.0:
            continue
        patch = hertz_1882(load, *radii, rail_transverse_radius, young, poisson)
        c11 = kalker_coefficients(patch.a, patch.b, poisson).c11
        rows[3:, index] = (
            patch.a,
            patch.b,
            stiffness_slope(patch.a, patch.b, stiffness),
            shear_modulus * patch.a * patch.b * c11,
        )
    return SlopeOverShift(*rows)
