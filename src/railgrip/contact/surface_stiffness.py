"""Slopes of the creep forces by the tangential stiffness K of the surface (Čáp 2000, 2.8–2.11)."""

from typing import NamedTuple

from railgrip.contact.input_checks import refuse_not_positive
from railgrip.contact.rolling_contact import Creepage, CreepForce

SURFACE_STIFFNESS = 20e12
"""K that Čáp takes, from his measurements on a test rig [N/m³]. The paper prints 20·10⁹ N/m³: it
means kN/m³. Kalker's theory gives 19.5·10¹² for a wheel of 0.46 m, a head of 0.3 m and 100 kN."""

STIFFNESS_BAND = (15e12, 25e12)
"""Range of K that figure 2.2 compares with measurements [N/m³]."""


class StiffnessSlopes(NamedTuple):
    """Forces and moment per creepage of an ellipse, for small creepages.

    Parameters
    ----------
    c11, c22 : float
        Force per creepage along and across the track [N].
    c23 : float
        Lateral force per spin, and minus the spin moment per lateral creepage [N m].
    c33 : float
        Spin moment per spin [N m²].
    """

    c11: float
    c22: float
    c23: float
    c33: float


def stiffness_slope(a: float, b: float, stiffness: float) -> float:
    """Slope dT/ds at zero creepage of an elliptic patch.

    Parameters
    ----------
    a, b : float
        Semi-axes along and across the track, > 0 [m].
    stiffness : float
        K, > 0 [N/m³].

    Returns
    -------
    float
        Slope (8/3) a² b K [N per unit creepage].

    Raises
    ------
    RailgripError
        "the semi-axis a must be positive and finite" and likewise for b and K.

    Notes
    -----
    (2.10) at ε = 0, and (2.11a). A brush of bristles of stiffness K that stick gives
    ∬ K (x_leading − x) s dA = (8/3) a² b K s. The sentence before (2.10) calls the patch
    rectangular; it is elliptic.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 2.8a, 2.10, 2.11a.

    Checked by tests/reference/five_slopes, 1e-4.

    Examples
    --------
    >>> round(stiffness_slope(7.2e-3, 5.4e-3, SURFACE_STIFFNESS) / 1e3, 1)
    14929.9
    """
    refuse_not_positive(
        (("semi-axis a", a, "m"), ("semi-axis b", b, "m"), ("stiffness", stiffness, "N/m^3"))
    )
    return 8.0 / 3.0 * a * a * b * stiffness


def rectangular_stiffness_slope(a: float, width: float, stiffness: float) -> float:
    """Slope dT/ds at zero creepage of a rectangular patch.

    Parameters
    ----------
    a : float
        Half its length along the track, > 0 [m].
    width : float
        Its width l, > 0 [m].
    stiffness : float
        K, > 0 [N/m³].

    Returns
    -------
    float
        Slope 2 a² l K [N per unit creepage].

    Raises
    ------
    RailgripError
        "the half-length must be positive and finite" and likewise for the width and K.

    Notes
    -----
    (2.11b). For l = 2b (the paper prints l = 2) the 8/3 of the ellipse becomes 4 (2.11c).

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 2.7b, 2.11b, 2.11c.

    Checked by tests/unit/contact/test_surface_stiffness.py.

    Examples
    --------
    >>> round(rectangular_stiffness_slope(5e-3, 0.02, SURFACE_STIFFNESS) / 1e3, 1)
    20000.0
    """
    refuse_not_positive(
        (("half-length", a, "m"), ("width", width, "m"), ("stiffness", stiffness, "N/m^3"))
    )
    return 2.0 * a * a * width * stiffness


def stiffness_slopes(a: float, b: float, stiffness: float) -> StiffnessSlopes:
    """Slopes for creepages along and across the track and spin, of an elliptic patch.

    Parameters
    ----------
    a, b, stiffness : float
        As in `stiffness_slope`.

    Returns
    -------
    StiffnessSlopes
        c11, c22, c23, c33.

    Raises
    ------
    RailgripError
        As `stiffness_slope`.

    Notes
    -----
    c11 = c22 = (8/3) a² b K, c23 = −c32 = (π/4) a³ b K, c33 = (8/15) a² b³ K (2.8a–c).
    One stiffness serves every direction here; Kalker's three flexibilities differ.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 2.8a–c.

    Checked by tests/unit/contact/test_surface_stiffness.py: integrals over the sticking patch.

    Examples
    --------
    >>> slopes = stiffness_slopes(7.2e-3, 5.4e-3, SURFACE_STIFFNESS)
    >>> round(slopes.c23 / 1e3, 3), round(slopes.c33, 3)
    (31.66, 87.071)
    """
    slope = stiffness_slope(a, b, stiffness)
    return StiffnessSlopes(
        slope, slope, 0.7853981633974483 * a**3 * b * stiffness, 0.2 * slope * b * b
    )


def stiffness_force(slopes: StiffnessSlopes, creepage: Creepage) -> CreepForce:
    """Forces and spin moment for small creepages, without a bound by friction.

    Choose it in linear studies; where |force| nears friction times load it is far too high.

    Parameters
    ----------
    slopes : StiffnessSlopes
        Of the ellipse.
    creepage : Creepage
        Along, across, spin.

    Returns
    -------
    CreepForce
        With the sign of the creepage.

    Notes
    -----
    (2.9), with c32 = −c23. Its Z is the spin moment; the Z of (1.11) and (1.12) is the normal
    force.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 2.9.

    Checked by tests/unit/contact/test_surface_stiffness.py.

    Examples
    --------
    >>> slopes = stiffness_slopes(7.2e-3, 5.4e-3, SURFACE_STIFFNESS)
    >>> round(stiffness_force(slopes, Creepage(1e-4, 0.0, 0.0)).longitudinal, 2)
    1492.99
    """
    return CreepForce(
        slopes.c11 * creepage.longitudinal,
        slopes.c22 * creepage.lateral + slopes.c23 * creepage.spin,
        slopes.c33 * creepage.spin - slopes.c23 * creepage.lateral,
    )
