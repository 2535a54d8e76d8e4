"""Temperatures of both surfaces, in the patch and behind it: flash, and unequal bulk."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import elliprf

from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.flash_temperature import ThermalMaterial, effusivity
from railgrip.laboratory.heat_profiles import semi_elliptic_profile, strip_profile
from railgrip.laboratory.moving_source import peclet, semi_elliptic_rise
from railgrip.laboratory.sliding_contact import SlidingContact

Array = NDArray[np.float64]

FAST = 100.0
"""Peclet number from which a surface is taken strip by strip: 0.5 m/s for a = 6 mm."""

_NEARLY_AT_REST = 1.0


@dataclass(frozen=True)
class SurfaceTemperatures:
    """Temperatures of both surfaces at places of the patch and around it.

    Parameters
    ----------
    behind, beside : ndarray
        Places: behind the centre of the patch (the surfaces enter at −a and leave at +a), and
        beside it [m].
    heat_flux : ndarray
        Friction power per area there, zero outside the patch [W/m²].
    wheel, rail : ndarray
        Temperatures [°C].
    """

    behind: Array
    beside: Array
    heat_flux: Array
    wheel: Array
    rail: Array


def surface_temperatures(
    contact: SlidingContact, behind: ArrayLike, beside: ArrayLike = 0.0
) -> SurfaceTemperatures:
    """Temperatures of wheel and rail surface at any places of the patch and around it.

    Parameters
    ----------
    contact : SlidingContact
        The contact.
    behind, beside : array_like
        Places as in `SurfaceTemperatures`; for a profile one row, for a map `behind[None, :]` and
        `beside[:, None]` [m].

    Returns
    -------
    SurfaceTemperatures
        In the common shape of the places.

    Notes
    -----
    Flash: a strip at y has the half-length a_y = a√(1 − y²/b²) and q0_y = q0 a_y/a, and
    ΔT = share q0_y √a_y/(β√(πv)) I(x/a_y). Unequal bulk temperatures: both surfaces jump to the
    mean weighted by β√v, stay there, and behind the patch return by (2/π) asin √(2a_y/(a_y + x)).
    A body with a Peclet number under 100 is taken exactly instead (steady; a body at rest keeps
    Hertz's potential around an isothermal ellipse). The shares are those of `flash_temperature`, so
    both surfaces agree at each point when both are fast, in their greatest values otherwise.
    Known wrong when part of the patch sticks: creepage under saturation heats less of it, see
    `flux_rises`; between Peclet 1 and 100 with unequal bulk, outside the patch.

    CONTACT (Kalker's program) prints too high flash temperatures on coarse grids: the element
    heats itself twice, an error with the root of the element's length. Its Ertz example prints
    166.8 °C; refined it goes to 150.4, the formula gives 150.30. It is no oracle here.

    References
    ----------
    .. [1] M. Ertz, K. Knothe, A comparison of analytical and numerical methods for the
       calculation of temperatures in wheel/rail contact, Wear 253 (2002) 498–508,
       doi:10.1016/S0043-1648(02)00120-5, eq 47 for the return.

    Checked by tests/reference/flash_temperature and tests/reference/contact_chill, the second
    also against a numerical march of two half-spaces.

    Examples
    --------
    >>> ertz = SlidingContact(100e3, 5.88e-3, 10.54e-3, 0.3, 30.0, 31.0, 150.0, 0.0)
    >>> hot = surface_temperatures(ertz, [-6e-3, 3.834e-3, 0.1])
    >>> hot.wheel.round(2).tolist(), hot.rail.round(2).tolist()
    ([150.0, 223.45, 159.6], [0.0, 223.45, 42.04])
    """
    x, y = np.broadcast_arrays(np.asarray(behind, float), np.asarray(beside, float))
    share = contact.flash().wheel_share
    inside = 1.0 - (x / contact.a) ** 2 - (y / contact.b) ** 2
    flux = contact.heat_flux * np.sqrt(np.maximum(inside, 0.0))
    middle = contact.touch_temperature()
    bodies = (
        (contact.wheel, contact.wheel_speed, share, contact.wheel_temperature),
        (contact.rail, contact.train_speed, 1.0 - share, contact.rail_temperature),
    )
    wheel, rail = (
        bulk
        + _flash_rise(contact, material, speed, part, x, y)
        + (middle - bulk) * _touch_shape(contact, material, speed, x, y)
        for material, speed, part, bulk in bodies
    )
    return SurfaceTemperatures(x, y, flux, wheel, rail)


def flux_rises(contact: SlidingContact, places: ArrayLike, flux: ArrayLike) -> tuple[Array, Array]:
    """Flash rises of wheel and rail for any distribution of the friction power.

    Choose it for non-Hertzian pressure, or where only part of the patch slides: the flux is shear
    stress times local slip speed.

    Parameters
    ----------
    contact : SlidingContact
        Speeds and materials; its own pressure is not used. Both bodies must be fast.
    places : array_like, shape (n,)
        Along the strips, rising in the direction in which the surfaces run [m].
    flux : array_like, shape (..., n)
        Friction power per area at the places, one row a strip [W/m²].

    Returns
    -------
    wheel, rail : ndarray, shape (..., n)
        Rises [K].

    Raises
    ------
    RailgripError
        "the surface of the wheel (rail) is too slow to be taken strip by strip", and those of
        `strip_profile`.

    Examples
    --------
    >>> contact = SlidingContact(100e3, 5.88e-3, 10.54e-3, 0.3, 30.0, 30.0)
    >>> x = np.linspace(-1.0, 1.0, 5) * 5.88e-3
    >>> [rise[-1].round(2).item() for rise in flux_rises(contact, x, np.full(5, 1e8))]
    [84.05, 84.05]
    """
    share = contact.flash().wheel_share
    integral = strip_profile(places, flux)
    rises = []
    for name, material, speed, part in (
        ("wheel", contact.wheel, contact.wheel_speed, share),
        ("rail", contact.rail, contact.train_speed, 1.0 - share),
    ):
        rate = peclet(material, contact.a, speed)
        if rate < FAST:
            raise RailgripError(
                Problem(
                    f"{'wheel' if name == 'wheel' else 'train'}_speed",
                    f"the surface of the {name} is too slow to be taken strip by strip",
                    got=f"Peclet number {rate:.3g}",
                    allowed=f"{FAST:.0f} or more",
                    cure="surface_temperatures, which knows slow bodies",
                )
            )
        rises.append(part * integral / (effusivity(material) * math.sqrt(math.pi * speed)))
    return rises[0], rises[1]


def _flash_rise(
    contact: SlidingContact,
    material: ThermalMaterial,
    speed: float,
    share: float,
    x: Array,
    y: Array,
) -> Array:
    flux = share * contact.heat_flux
    if peclet(material, contact.a, speed) < FAST:
        return semi_elliptic_rise(material, contact.a, contact.b, speed, flux, x, y)
    width = _strip(contact, y)
    with np.errstate(divide="ignore", invalid="ignore"):
        shape = semi_elliptic_profile(x / (contact.a * width))
    rise = flux * math.sqrt(contact.a / (math.pi * speed)) / effusivity(material)
    return np.where(width > 0.0, rise * width**1.5 * np.nan_to_num(shape), 0.0)


def _touch_shape(
    contact: SlidingContact, material: ThermalMaterial, speed: float, x: Array, y: Array
) -> Array:
    """1 in the patch, falling to 0 outside it: how far a surface follows the touch temperature."""
    a, b = contact.a, contact.b
    if peclet(material, a, speed) < _NEARLY_AT_REST:
        # the confocal ellipse through the place: x²/(a² + s) + y²/(b² + s) = 1
        half = 0.5 * (x * x + y * y - a * a - b * b)
        rest = (a * b) ** 2 - (b * x) ** 2 - (a * y) ** 2
        s = np.maximum(half + np.sqrt(np.maximum(half * half - rest, 0.0)), 0.0)
        return np.asarray(elliprf(s, a * a + s, b * b + s) / elliprf(0.0, a * a, b * b))
    length = a * _strip(contact, y)
    since_entry = np.maximum(x + length, 1e-300)
    share = np.clip(2.0 * length / since_entry, 0.0, 1.0)
    shape = 2.0 / np.pi * np.arcsin(np.sqrt(share))
    return np.where((x >= -length) & (length > 0.0), shape, 0.0)


def _strip(contact: SlidingContact, y: Array) -> Array:
    """Half-length of the strip at y over a, zero beside the patch."""
    return np.sqrt(np.maximum(1.0 - (y / contact.b) ** 2, 0.0))
