"""Freibauer's creep curve in Čáp's own terms: adhesion and its slope, elliptic or rectangular."""

import math

from railgrip.contact.input_checks import refuse_not_positive
from railgrip.core.formulas.elementary import arctangent

_TWO_OVER_PI = 0.6366197723675814
_LEAST_FRICTION = 1e-12


def elliptic_stress_growth(load: float, a: float, b: float, stiffness: float) -> float:
    """Reciprocal 1/ρ of the constant of the contact for an elliptic patch.

    Parameters
    ----------
    load : float
        Wheel load Q, > 0 [N].
    a, b : float
        Semi-axes along and across the track, > 0 [m].
    stiffness : float
        Tangential stiffness of the surface K, > 0 [N/m³].

    Returns
    -------
    float
        1/ρ [-].

    Raises
    ------
    RailgripError
        "the load must be positive and finite" and likewise for the others.

    Notes
    -----
    1/ρ = (2π/3) a² b K/Q: the gradient ε of the stress in the stick area is s/(ρφ).

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 2.7a.

    Checked by tests/unit/contact/test_freibauer_curve.py.

    Examples
    --------
    >>> round(elliptic_stress_growth(100e3, 7.2e-3, 5.4e-3, 20e12), 2)
    117.26
    """
    refuse_not_positive(
        (
            ("load", load, "N"),
            ("semi-axis a", a, "m"),
            ("semi-axis b", b, "m"),
            ("stiffness", stiffness, "N/m^3"),
        )
    )
    return 2.0 * math.pi / 3.0 * a * a * b * stiffness / load


def rectangular_stress_growth(load: float, a: float, width: float, stiffness: float) -> float:
    """Reciprocal 1/ρ of the constant of the contact for the rectangular patch of a worn rail.

    Parameters
    ----------
    load : float
        Wheel load Q, > 0 [N].
    a : float
        Half the length of the patch along the track, > 0 [m].
    width : float
        Its width l, > 0 [m].
    stiffness : float
        Tangential stiffness of the surface K, > 0 [N/m³].

    Returns
    -------
    float
        1/ρ [-].

    Raises
    ------
    RailgripError
        "the load must be positive and finite" and likewise for the others.

    Notes
    -----
    1/ρ = (π/2) a² l K/Q.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 2.7b.

    Checked by tests/unit/contact/test_freibauer_curve.py.

    Examples
    --------
    >>> round(rectangular_stress_growth(100e3, 5e-3, 0.02, 20e12), 2)
    157.08
    """
    refuse_not_positive(
        (
            ("load", load, "N"),
            ("half-length", a, "m"),
            ("width", width, "m"),
            ("stiffness", stiffness, "N/m^3"),
        )
    )
    return 0.5 * math.pi * a * a * width * stiffness / load


def freibauer_adhesion(friction: float, stress_growth: float, creepage: float) -> float:
    """Adhesion coefficient μ = T/Q at a creepage, for either patch.

    Choose it beside the paper; the plant's own form of the same curve is `freibauer_1983`.

    Parameters
    ----------
    friction : float
        Friction coefficient φ, constant, ≥ 0 [-].
    stress_growth : float
        1/ρ from `elliptic_stress_growth` or `rectangular_stress_growth` [-].
    creepage : float
        Creepage s, signed [-].

    Returns
    -------
    float
        μ, with the sign of the creepage, |μ| ≤ φ [-].

    Notes
    -----
    μ = (2/π) φ (arctan ε + ε/(1 + ε²)), ε = s/(ρφ) (2.3; the δ of the scanned paper is π). The
    initial tangent μ/φ = (4/π) ε reaches 1 at ε = π/4.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 2.2–2.5.

    Checked by tests/unit/contact/test_freibauer_curve.py against `freibauer_1983`, 1e-12.

    Examples
    --------
    >>> round(freibauer_adhesion(0.3, 117.26, 0.001), 4)
    0.1359
    """
    stress = stress_growth * creepage / max(friction, _LEAST_FRICTION)
    angle = arctangent(stress)
    return _TWO_OVER_PI * friction * (angle + stress / (1.0 + stress * stress))


def freibauer_slope(friction: float, stress_growth: float, creepage: float) -> float:
    """Slope dμ/ds of Freibauer's curve at a creepage.

    Times the load it is dT/ds: (2.10) for the ellipse, (2.7b) for the rectangle.

    Parameters
    ----------
    friction, stress_growth, creepage : float
        As in `freibauer_adhesion`.

    Returns
    -------
    float
        c_μs, > 0, alike for s and −s [per unit creepage].

    Notes
    -----
    c_μs = (4/π) (1/ρ)/(1 + ε²)² (2.6). At ε = 0 it does not depend on φ.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eqs 2.4–2.7.

    Checked by tests/unit/contact/test_freibauer_curve.py: the derivative of `freibauer_adhesion`.

    Examples
    --------
    >>> round(freibauer_slope(0.3, 117.26, 0.0), 2)
    149.3
    """
    stress = stress_growth * creepage / max(friction, _LEAST_FRICTION)
    return 2.0 * _TWO_OVER_PI * stress_growth / (1.0 + stress * stress) ** 2
