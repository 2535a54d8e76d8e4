"""Heat that a hot wheel gives a cold rail in the contact, without any friction."""

import math

from railgrip.core.formulas.flash_temperature import (
    ThermalMaterial,
    effusivity,
    mean_semi_axis,
)

ELLIPSE_CHILL = 1.7480383695280797
"""∫ (1 − η²)^¼ dη from −1 to 1 = B(½, 5/4) [-]."""


def touch_conductance(material: ThermalMaterial, a: float, b: float, speed: float) -> float:
    """Heat that one body takes up from a patch that is held at one temperature.

    Parameters
    ----------
    material : ThermalMaterial
        The body's material.
    a, b : float
        Semi-axes of the contact along and across the track, > 0 [m].
    speed : float
        Speed at which the body's surface passes the contact, any sign, or zero [m/s].

    Returns
    -------
    float
        Power into the body over patch minus body temperature, > 0 [W/K].

    Notes
    -----
    At rest 4 λ AGM(a, b) (an isothermal ellipse on a half-space). Fast, a strip takes the heat flux
    β√(v/π) ΔT/√(distance from the leading edge), together 2β√(2av/π) · b · B(½, 5/4). Joined like
    `flash_conductance`, by the root of the sum of squares. That joint is our own: against a
    numerical solution with 40 × 40 elements it is at most 5 % too small for b = a, 11 % for
    b = a/2 and within 1 % for b = 2a, worst at v a/(2κ) = 1 … 10 (some cm/s).

    References
    ----------
    .. [1] M. Ertz, K. Knothe, A comparison of analytical and numerical methods for the
       calculation of temperatures in wheel/rail contact, Wear 253 (2002) 498–508.
    .. [2] H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, Oxford 1959, § 8.2.

    Checked by tests/reference/contact_chill, 1e-3.

    Examples
    --------
    >>> from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002
    >>> round(touch_conductance(STEEL_ERTZ_2002, 5.88e-3, 10.54e-3, 30.0), 1)
    164.1
    """
    still = 4.0 * material.conductivity * mean_semi_axis(a, b)
    moving = 2.0 * ELLIPSE_CHILL * b * effusivity(material)
    return math.sqrt(still * still + moving * moving * (2.0 / math.pi) * a * abs(speed))


def contact_temperature(
    wheel: float, rail: float, wheel_temperature: float, rail_temperature: float
) -> float:
    """Temperature that both surfaces take in the contact when they come in unequal.

    Parameters
    ----------
    wheel, rail : float
        `touch_conductance` of the bodies, or β√v of each, > 0.
    wheel_temperature, rail_temperature : float
        With which they enter [°C].

    Returns
    -------
    float
        Weighted mean [°C]; the flash rise comes on top of it.

    Notes
    -----
    At once after touching, and to the end of the contact: (w_w T_w + w_r T_r)/(w_w + w_r), with
    w = β√v. Equal steels at equal speeds meet in the middle: 150 °C on 0 °C gives 75 °C.

    Checked by tests/reference/contact_chill.

    Examples
    --------
    >>> contact_temperature(1.0, 1.0, 150.0, 0.0)
    75.0
    """
    return (wheel * wheel_temperature + rail * rail_temperature) / (wheel + rail)


def chill_conductance(wheel: float, rail: float) -> float:
    """Heat from the wheel to the rail over the difference of their temperatures.

    Parameters
    ----------
    wheel, rail : float
        `touch_conductance` of the bodies, > 0 [W/K].

    Returns
    -------
    float
        The two in series [W/K].

    Examples
    --------
    >>> chill_conductance(164.0, 164.0)
    82.0
    """
    return wheel * rail / (wheel + rail)
