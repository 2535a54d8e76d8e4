"""The rectangular patch of a cylindrical wheel on a rail worn flat (Hertz's line contact)."""

import math
from typing import NamedTuple

from railgrip.contact.input_checks import refuse_not_positive, refuse_poisson


class RectangularPatch(NamedTuple):
    """The strip in which a worn rail and a wheel touch.

    Parameters
    ----------
    a : float
        Half its length along the track [m].
    width : float
        Its width across the track, l [m].
    greatest_pressure : float
        Pressure on the middle line, 2Q/(πal) [Pa].
    """

    a: float
    width: float
    greatest_pressure: float


def rectangular_patch(
    load: float, wheel_radius: float, width: float, young: float, poisson: float
) -> RectangularPatch:
    """Patch of a wheel on a rail head worn flat over a width.

    Choose it for worn heads and thin test discs; for round heads take `hertz_1882`.

    Parameters
    ----------
    load : float
        Vertical wheel load Q, > 0 [N].
    wheel_radius : float
        Rolling radius r1x, > 0 [m]; on a roller 1/(1/r1x + 1/r2x).
    width : float
        Width of the contact l, > 0 [m].
    young, poisson : float
        Young's modulus [Pa], > 0, and Poisson's ratio [-], −1 < ν ≤ ½, of both bodies.

    Returns
    -------
    RectangularPatch
        Half-length, width, greatest pressure.

    Raises
    ------
    RailgripError
        "the width of the contact must be positive and finite" and likewise for load, radius and
        material.

    Notes
    -----
    p = p_m √(1 − (x/a)²), p_m = 2Q/(πal), a = √(8 Q r1x (1 − ν²)/(π E l)) (1.13, 1.14; the δ that
    the scanned paper prints is π). Plane strain: exact for l much greater than a.
    Known wrong at the edges of the strip, where the true pressure rises, and for l of the order
    of a.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 1.13, 1.14.
    .. [2] K. L. Johnson, Contact Mechanics, Cambridge 1985, eqs 4.43–4.46.

    Checked by tests/unit/contact/test_rectangular_patch.py: the load is the integral of the
    pressure, and a long ellipse tends to it.

    Examples
    --------
    >>> patch = rectangular_patch(100e3, 0.5, 0.02, 210e9, 0.3)
    >>> round(patch.a * 1e3, 3), round(patch.greatest_pressure / 1e6, 1)
    (5.252, 606.0)
    """
    refuse_not_positive(
        (
            ("load", load, "N"),
            ("wheel radius", wheel_radius, "m"),
            ("width of the contact", width, "m"),
            ("Young's modulus", young, "Pa"),
        )
    )
    refuse_poisson(poisson)
    a = math.sqrt(8.0 * load * wheel_radius * (1.0 - poisson * poisson) / (math.pi * young * width))
    return RectangularPatch(a, width, 2.0 * load / (math.pi * a * width))
