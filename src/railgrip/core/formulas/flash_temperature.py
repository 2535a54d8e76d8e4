"""Flash temperature of wheel and rail: what the friction of one contact adds to both surfaces."""

import math
from typing import NamedTuple

from railgrip.core.errors import Problem, RailgripError

FASTEST_RISE = 1.2346198309610953
"""Greatest rise over q0 √(a/v)/β under a fast semi-elliptic source: 2.188307/√π [-]."""

_MOVING = 2.0 / 3.0 * math.pi / FASTEST_RISE


class ThermalMaterial(NamedTuple):
    """What decides how a body takes up heat.

    Parameters
    ----------
    conductivity : float
        λ, > 0 [W/(m K)].
    density : float
        ρ, > 0 [kg/m³].
    specific_heat : float
        c, > 0 [J/(kg K)].
    """

    conductivity: float
    density: float
    specific_heat: float


STEEL_ERTZ_2002 = ThermalMaterial(50.0, 7850.0, 450.0)
"""Wheel and rail steel as in Ertz and Knothe's example, β = 13 290 W√s/(m²K)."""


class FlashTemperature(NamedTuple):
    """Greatest rise in one contact, and where the heat goes.

    Parameters
    ----------
    rise : float
        Greatest rise of the two surfaces, the same for both, ≥ 0 [K].
    wheel_share : float
        Share of the friction power that enters the wheel, 0 … 1 [-].
    """

    rise: float
    wheel_share: float


def thermal_material(conductivity: float, density: float, specific_heat: float) -> ThermalMaterial:
    """Return a material after checking its numbers.

    Parameters
    ----------
    conductivity, density, specific_heat : float
        As in `ThermalMaterial`, all > 0.

    Returns
    -------
    ThermalMaterial
        The material.

    Raises
    ------
    RailgripError
        "the conductivity (density, specific heat) must be positive and finite".

    Examples
    --------
    >>> round(effusivity(thermal_material(50.0, 7850.0, 450.0)), 2)
    13290.03
    """
    for name, value, unit in (
        ("conductivity", conductivity, "W/(m K)"),
        ("density", density, "kg/m³"),
        ("specific heat", specific_heat, "J/(kg K)"),
    ):
        if not 0.0 < value < math.inf:
            raise RailgripError(
                Problem("", f"the {name} must be positive and finite", got=f"{value} {unit}")
            )
    return ThermalMaterial(conductivity, density, specific_heat)


def effusivity(material: ThermalMaterial) -> float:
    """β = √(λρc): heat a surface takes up in a short time, over its rise [W√s/(m²K)].

    Examples
    --------
    >>> round(effusivity(STEEL_ERTZ_2002), 2)
    13290.03
    """
    return math.sqrt(material.conductivity * material.density * material.specific_heat)


def friction_power(wheel_speed: float, train_speed: float, force: float) -> float:
    """Power that sliding turns into heat in one contact, |wheel speed − train speed| · |force|.

    Parameters
    ----------
    wheel_speed, train_speed : float
        Speed at the tread and speed of the train [m/s].
    force : float
        Tangential force, any sign [N].

    Returns
    -------
    float
        Power, ≥ 0 [W].

    Examples
    --------
    >>> friction_power(24.0, 30.0, -5e3)
    30000.0
    """
    return abs(wheel_speed - train_speed) * abs(force)


def mean_semi_axis(a: float, b: float) -> float:
    """Arithmetic-geometric mean of the semi-axes: the size of an ellipse for steady heat flow.

    Four averages are within 2e-9 for 1/10 ≤ a/b ≤ 10, 2e-6 for 1/50 … 50. Both must be > 0 [m].

    Examples
    --------
    >>> round(mean_semi_axis(5.88e-3, 10.54e-3) * 1e3, 5)
    8.04033
    """
    x, y = 0.5 * (a + b), math.sqrt(a * b)
    x, y = 0.5 * (x + y), math.sqrt(x * y)
    x, y = 0.5 * (x + y), math.sqrt(x * y)
    return 0.5 * (x + y)


def flash_conductance(material: ThermalMaterial, a: float, b: float, speed: float) -> float:
    """Heat that one body takes up over the greatest rise of its surface.

    Choose it where only the greatest temperature counts; the course along the patch is in
    `railgrip.laboratory.contact_temperature`.

    Parameters
    ----------
    material : ThermalMaterial
        The body's material.
    a, b : float
        Semi-axes of the contact along and across the track, > 0 [m].
    speed : float
        Speed at which the body's surface passes the contact: of the tread for the wheel, of the
        train for the rail; any sign, zero for a locked wheel [m/s].

    Returns
    -------
    float
        Power into the body over its greatest rise, > 0 [W/K].

    Notes
    -----
    The heat is semi-elliptic like Hertz's pressure, q0 = 3P/(2πab). At rest its centre becomes as
    hot as Hertz's pressure makes a half-space sink, ΔT = q0 b K(e)/(2λ), so that, with
    m = AGM(a, b),

        G_still = (8/3) λ m;      fast: ΔT = 1.234620 q0 √(a/v)/β,  G_fast = 1.696389 β b √(a v).

    Greenwood joins the two by 1/ΔT² = 1/ΔT_still² + 1/ΔT_fast², that is G² = G_still² + G_fast²:
    nothing is divided by the speed. Against the exact half-space solution the rise is within 1.2 %
    for b = a at every speed; at a Peclet number v a/(2κ) of 1 to 3 (1 to 3 cm/s) it is up to 7.5 %
    too large for b = a/2 and 5 % too small for b = 2a, at 10 up to 23 % too large for b = a/5;
    above 0.5 m/s within 1 % for b ≥ a/2.
    Known wrong when a locked wheel has slid for less than a few seconds: a body at rest needs
    about a²/κ (2.5 s for 6 mm) to reach its steady rise, and takes more heat before.

    References
    ----------
    .. [1] J. A. Greenwood, An interpolation formula for flash temperatures, Wear 150 (1991)
       153–158, doi:10.1016/0043-1648(91)90312-I.
    .. [2] X. Tian, F. E. Kennedy, Maximum and average flash temperatures in sliding contacts,
       J. Tribology 116 (1994) 167–174, doi:10.1115/1.2927035.
    .. [3] K. L. Johnson, Contact Mechanics, Cambridge 1985, eq 4.26 (the sinking at the centre).

    Checked by tests/reference/flash_temperature, 1e-4, and
    tests/unit/laboratory/test_moving_source.py against the exact solution.

    Examples
    --------
    >>> round(flash_conductance(STEEL_ERTZ_2002, 5.88e-3, 10.54e-3, 30.0), 3)
    99.808
    """
    still = 8.0 / 3.0 * material.conductivity * mean_semi_axis(a, b)
    moving = _MOVING * b * effusivity(material)
    return math.sqrt(still * still + moving * moving * a * abs(speed))


def flash_temperature(
    wheel: float,
    rail: float,
    power: float,
) -> FlashTemperature:
    """Greatest flash temperature of a contact, and the wheel's share of the heat.

    Parameters
    ----------
    wheel, rail : float
        `flash_conductance` of the two bodies, > 0 [W/K].
    power : float
        `friction_power` of the contact, ≥ 0 [W].

    Returns
    -------
    FlashTemperature
        Rise over the temperature at which both surfaces enter, and share of the wheel.

    Notes
    -----
    Blok's postulate: both surfaces become equally hot, so each takes heat in proportion to its
    conductance, ΔT = P/(G_wheel + G_rail). Fast, that is share_i = β_i√v_i/(β_w√v_w + β_r√v_r), and
    the postulate holds at every point of the patch; with a slow or locked wheel only the greatest
    rises are equal. Where the bodies come with different temperatures, see
    `railgrip.core.formulas.rail_chill`.

    References
    ----------
    .. [1] H. Blok, The flash temperature concept, Wear 6 (1963) 483–494.
    .. [2] M. Ertz, K. Knothe, A comparison of analytical and numerical methods for the
       calculation of temperatures in wheel/rail contact, Wear 253 (2002) 498–508,
       doi:10.1016/S0043-1648(02)00120-5.

    Checked by tests/laws/test_flash_temperature.py.

    Examples
    --------
    >>> rail = flash_conductance(STEEL_ERTZ_2002, 5.88e-3, 10.54e-3, 30.0)
    >>> locked = flash_conductance(STEEL_ERTZ_2002, 5.88e-3, 10.54e-3, 0.0)
    >>> [round(x, 4) for x in flash_temperature(locked, rail, 30e3)]
    [297.3822, 0.0106]
    """
    total = wheel + rail
    return FlashTemperature(power / total, wheel / total)


def fast_rise(
    share: float, heat_flux: float, a: float, speed: float, surface_effusivity: float
) -> float:
    """Greatest rise under a fast semi-elliptic source, 1.234620 · share · q0 √(a/v)/β.

    Choose it to compare with the literature; `flash_conductance` also knows slow bodies.

    Parameters
    ----------
    share : float
        Share of the heat that enters this body, 0 … 1 [-].
    heat_flux : float
        At the centre of the patch, q0 = μ p0 · slip speed, ≥ 0 [W/m²].
    a : float
        Semi-axis along the track, > 0 [m].
    speed : float
        Speed of the surface through the contact, > 0 [m/s].
    surface_effusivity : float
        `effusivity` of the body [W√s/(m²K)].

    Returns
    -------
    float
        Greatest rise, at x/a = 0.65223 behind the centre [K].

    Notes
    -----
    Known wrong when v a/(2κ) is below about 10, and infinite at v = 0.

    Checked by tests/reference/flash_temperature, 1e-5.

    Examples
    --------
    >>> flux = 0.3 * 1.5 * 100e3 / (math.pi * 5.88e-3 * 10.54e-3)
    >>> round(fast_rise(0.5, flux, 5.88e-3, 30.0, effusivity(STEEL_ERTZ_2002)), 3)
    150.297
    """
    return FASTEST_RISE * share * heat_flux * math.sqrt(a / speed) / surface_effusivity
