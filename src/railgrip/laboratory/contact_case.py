"""One wheel on one rail under a load: patch, pressure, coefficients, slopes."""

from __future__ import annotations

import math
import os
from typing import NamedTuple

from railgrip.contact.cap_2000 import cap_2000_simple_slope, cap_2000_slope
from railgrip.contact.carter_slope import carter_1926_slope
from railgrip.contact.kalker_slope import kalker_1967_simple_slope, kalker_1967_slope
from railgrip.contact.rolling_contact import RollingContact
from railgrip.contact.surface_stiffness import SURFACE_STIFFNESS, stiffness_slope
from railgrip.core.formulas.patch import HertzPatch, hertz_1882
from railgrip.scenario.contact_pair import ContactPair, PairGeometry, contact_of_pair, contact_pair


class InitialSlopes(NamedTuple):
    """Slope dT/ds at zero longitudinal creepage by each formula [N per unit creepage].

    Parameters
    ----------
    cap_2000, cap_2000_simple : float
        Čáp's (2.12a), for a cone on a round head, NaN for any other pair; and (2.12b).
    carter_1926 : float
        Carter's (2.13), for cylinders.
    kalker_1967, kalker_1967_simple : float
        Kalker's (2.14a) and (2.14b), as Čáp quotes them.
    surface_stiffness : float
        (8/3) a² b K, K = 20·10¹² N/m³.
    kalker_1990 : float
        G a b C11 of Kalker's table: the one that the laws start with.
    """

    cap_2000: float
    cap_2000_simple: float
    carter_1926: float
    kalker_1967: float
    kalker_1967_simple: float
    surface_stiffness: float
    kalker_1990: float


class ContactCase(NamedTuple):
    """What a contact is before it creeps.

    Parameters
    ----------
    geometry : PairGeometry
        Radii and material.
    contact : RollingContact
        Load, semi-axes and Kalker's coefficients, ready for any law.
    patch : HertzPatch
        The same ellipse with its greatest pressure and approach.
    slopes : InitialSlopes
        By the five formulas, by surface stiffness and by Kalker's table.
    """

    geometry: PairGeometry
    contact: RollingContact
    patch: HertzPatch
    slopes: InitialSlopes


def contact_case(pair: ContactPair | str | os.PathLike[str], load: float) -> ContactCase:
    """Patch, pressure, coefficients and slopes of a pair under a load.

    Choose it to begin with; hand its `contact` to `compare_laws` or to a law.

    Parameters
    ----------
    pair : ContactPair, str or path
        A pair, its shipped name, or its file; with a round or flat rail head.
    load : float
        Normal force Q, > 0 [N].

    Returns
    -------
    ContactCase
        Everything that does not depend on creepage.

    Raises
    ------
    RailgripError
        From `contact_of_pair`: unknown pair, a load that is not positive, profiles that do not
        touch in one point, or a worn head whose patch is a rectangle.

    Notes
    -----
    The simple formulas have wheels of about 0.5 m and heads of about 0.3 m built in and are shown
    for any pair; see `railgrip.contact.cap_2000` and its neighbours for what they leave out.

    Checked by tests/unit/laboratory/test_contact_case.py and tests/reference/five_slopes.

    Examples
    --------
    >>> case = contact_case("cap_2000", 100e3)
    >>> [round(slope / 1e3) for slope in case.slopes[:5]]
    [16605, 16650, 10324, 15063, 16244]
    """
    found = pair if isinstance(pair, ContactPair) else contact_pair(pair)
    geometry = found.geometry()
    contact = contact_of_pair(found, load)
    a, b, wheel, head = contact.a, contact.b, geometry.wheel_radius, geometry.rail_transverse_radius
    is_cone_on_head = math.isinf(geometry.wheel_transverse_radius) and 0.0 < head < math.inf
    slopes = InitialSlopes(
        cap_2000_slope(load, wheel, head) if is_cone_on_head else math.nan,
        cap_2000_simple_slope(load, wheel),
        carter_1926_slope(load, wheel),
        kalker_1967_slope(a, b, geometry.young),
        kalker_1967_simple_slope(load),
        stiffness_slope(a, b, SURFACE_STIFFNESS),
        contact.shear_modulus * a * b * contact.c11,
    )
    return ContactCase(geometry, contact, hertz_1882(load, *geometry), slopes)
