"""Pressure between wheel and rail at a point of the patch."""

import math

from railgrip.contact.rectangular_patch import RectangularPatch
from railgrip.core.formulas.patch import HertzPatch


def elliptic_pressure(patch: HertzPatch, x: float, y: float) -> float:
    """Pressure at a point of Hertz's ellipse.

    Parameters
    ----------
    patch : HertzPatch
        Semi-axes and greatest pressure.
    x, y : float
        Place along and across the track, from the centre [m].

    Returns
    -------
    float
        Pressure, 0 outside the ellipse [Pa].

    Notes
    -----
    p = p_m √(1 − (x/a)² − (y/b)²), p_m = 3Q/(2πab) (1.9, 1.10). Where the scanned paper shows δ in
    such a place, read π.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 1.8–1.10.

    Checked by tests/unit/contact/test_contact_pressure.py: its integral is the load.

    Examples
    --------
    >>> round(elliptic_pressure(HertzPatch(6e-3, 4e-3, 1e9, 0.0), 3e-3, 0.0) / 1e6, 1)
    866.0
    """
    inside = 1.0 - (x / patch.a) ** 2 - (y / patch.b) ** 2
    return patch.greatest_pressure * math.sqrt(max(inside, 0.0))


def rectangular_pressure(patch: RectangularPatch, x: float, y: float) -> float:
    """Pressure at a point of the rectangular patch of a worn rail.

    Parameters
    ----------
    patch : RectangularPatch
        Half-length, width and greatest pressure.
    x, y : float
        Place along and across the track, from the centre [m].

    Returns
    -------
    float
        Pressure, 0 outside the rectangle [Pa].

    Notes
    -----
    p = p_m √(1 − (x/a)²) for |y| ≤ l/2 (1.13).

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 1.13.

    Checked by tests/unit/contact/test_contact_pressure.py: its integral is the load.

    Examples
    --------
    >>> round(rectangular_pressure(RectangularPatch(5e-3, 0.02, 6e8), 3e-3, 0.0) / 1e6, 1)
    480.0
    """
    inside = 1.0 - (x / patch.a) ** 2 if abs(y) <= 0.5 * patch.width else 0.0
    return patch.greatest_pressure * math.sqrt(max(inside, 0.0))
