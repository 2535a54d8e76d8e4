"""The exact steady rise under a semi-elliptic heat source, at any speed and at rest."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.flash_temperature import ThermalMaterial

Array = NDArray[np.float64]

GREATEST_PECLET = 1000.0
_ANGLES, _RADII = 160, 40


def peclet(material: ThermalMaterial, a: float, speed: float) -> float:
    """Return the Peclet number v a/(2κ): how fast a surface is for the heat in it [-].

    Examples
    --------
    >>> from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002
    >>> round(peclet(STEEL_ERTZ_2002, 5.88e-3, 30.0))
    6231
    """
    diffusivity = material.conductivity / (material.density * material.specific_heat)
    return 0.5 * abs(speed) * a / diffusivity


def semi_elliptic_rise(
    material: ThermalMaterial,
    a: float,
    b: float,
    speed: float,
    heat_flux: float,
    x: ArrayLike,
    y: ArrayLike = 0.0,
) -> Array:
    """Rise of the surface of a half-space under q0 √(1 − (x/a)² − (y/b)²), in the steady state.

    Choose it for slow and locked wheels, and to judge the formulas for fast ones; it integrates
    numerically, some 10 000 points a second.

    Parameters
    ----------
    material : ThermalMaterial
        The body's material.
    a, b : float
        Semi-axes along and across the track, > 0 [m].
    speed : float
        Speed of the surface through the source towards positive x, ≥ 0 [m/s].
    heat_flux : float
        Into the body at the centre [W/m²].
    x, y : array_like
        Places from the centre of the patch, in it or beside it [m].

    Returns
    -------
    ndarray
        Rise [K], in the common shape of x and y.

    Raises
    ------
    RailgripError
        "the surface is too fast for the exact solution" (Peclet number over 1000).

    Notes
    -----
    ΔT = 1/(2πλ) ∬ q/r · exp(−v (r − (x − x'))/(2κ)) dx' dy'. In polar coordinates around the point
    1/r drops out; the angle is stretched by sinh, for at speed the heat comes from a narrow sector
    ahead. Gauss points: 160 angles, 40 radii; error below 4e-5 of the greatest rise.
    Known wrong before a body at rest has become steady (about a²/κ, 2.5 s for 6 mm).

    References
    ----------
    .. [1] J. C. Jaeger, Moving sources of heat and the temperature at sliding contacts, J. Proc.
       R. Soc. N.S.W. 76 (1942) 203–224.

    Checked by tests/unit/laboratory/test_moving_source.py: Hertz's potential at rest, the strip
    formula when fast.

    Examples
    --------
    >>> from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002
    >>> float(semi_elliptic_rise(STEEL_ERTZ_2002, 6e-3, 6e-3, 0.0, 1e6, 0.0).round(4))
    94.2478
    """
    rate = peclet(material, a, speed)
    if not rate <= GREATEST_PECLET:
        raise RailgripError(
            Problem(
                "speed",
                "the surface is too fast for the exact solution",
                got=f"Peclet number {rate:.0f}",
                allowed=f"0 … {GREATEST_PECLET:.0f}",
                cure="railgrip.laboratory.contact_temperature",
            )
        )
    places = np.broadcast_arrays(np.asarray(x, float) / a, np.asarray(y, float) / b)
    flat = np.column_stack([place.ravel() for place in places])
    rises = np.array([_at_point(px, py, b / a, rate) for px, py in flat])
    return np.asarray(a * heat_flux / material.conductivity * rises.reshape(places[0].shape))


@cache
def _gauss(count: int) -> tuple[Array, Array]:
    return np.polynomial.legendre.leggauss(count)


def _radial_nodes() -> tuple[Array, Array]:
    """Places 0 … 1 on a ray, bunched smoothly at both ends, where the flux goes like a root."""
    node, weight = _gauss(_RADII)
    u = 0.5 * (1.0 + node)
    return u**3 * (10.0 - 15.0 * u + 6.0 * u * u), 15.0 * weight * (u * (1.0 - u)) ** 2


def _angles(x: float, y: float, ratio: float, stretch: float) -> tuple[Array, Array]:
    """Directions in which the source lies, counted from the entry side, with weights."""
    low, high = -np.pi, np.pi
    distance = np.hypot(x, y)
    if distance > 1.0:
        middle = np.arctan2(-y * ratio, x)
        half = np.arcsin(1.0 / distance) * np.array([-1.0, 1.0])
        direction = np.arctan2(-y, x) + half  # of the tangents, where the ellipse is a circle
        tangent = np.arctan2(np.sin(direction) * ratio, np.cos(direction))
        low, high = middle + (tangent - middle + np.pi) % (2.0 * np.pi) - np.pi
    start, end = np.arcsinh(low / stretch), np.arcsinh(high / stretch)
    node, weight = _gauss(_ANGLES)
    place = 0.5 * ((end + start) + (end - start) * node)
    return stretch * np.sinh(place), 0.5 * (end - start) * weight * stretch * np.cosh(place)


def _at_point(x: float, y: float, ratio: float, rate: float) -> float:
    """Rise in units of a q0/λ at (x/a, y/b), for b/a = ratio and Peclet number = rate."""
    angle, angle_weight = _angles(x, y, ratio, 1.0 / np.sqrt(1.0 + 2.0 * rate))
    radial, radial_weight = _radial_nodes()
    along, across = -np.cos(angle), np.sin(angle) / ratio
    # where the ray x + r·along, y + r·across cuts the ellipse (the unit circle in these scales)
    square = along * along + across * across
    half = x * along + y * across
    under_root = np.maximum(half * half - square * (x * x + y * y - 1.0), 0.0)
    near = np.maximum((-half - np.sqrt(under_root)) / square, 0.0)
    far = np.maximum((-half + np.sqrt(under_root)) / square, 0.0)
    r = near[:, None] + (far - near)[:, None] * radial
    inside = 1.0 - (x + r * along[:, None]) ** 2 - (y + r * across[:, None]) ** 2
    flux = np.sqrt(np.maximum(inside, 0.0))
    carried = np.exp(-rate * r * (1.0 - np.cos(angle))[:, None])
    strips = (far - near) * ((flux * carried) @ radial_weight)
    return float(strips @ angle_weight) / (2.0 * np.pi)
