"""How warm a surface becomes point by point while it passes under a fast heat source.

Each strip along the track is heated by itself (heat flows into the depth only): with the heat flux
q(x) into the body, β = √(λρc) and the speed v,

    ΔT(x) = 1/(β√(πv)) ∫ q(x')/√(x − x') dx'  =  q0 √a/(β√(πv)) · I(x/a).

The functions here are I for three distributions, behind the patch too, and the integral itself for
any distribution. x/a is −1 where the surface enters and +1 where it leaves.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipe, ellipkm1, hyp2f1

from railgrip.core.errors import Problem, RailgripError

Array = NDArray[np.float64]


def uniform_profile(place: ArrayLike) -> Array:
    """I(x/a) under a constant heat flux: 2√2 at the exit.

    Parameters
    ----------
    place : array_like
        x/a, any value.

    Returns
    -------
    ndarray
        2(√(1 + x/a) − √(x/a − 1)), each root zero where its argument is negative.

    Examples
    --------
    >>> uniform_profile([-1.0, 1.0]).round(6).tolist()
    [0.0, 2.828427]
    """
    since_entry, since_exit = _lags(place)
    return np.asarray(2.0 * (np.sqrt(since_entry) - np.sqrt(since_exit)))


def parabolic_profile(place: ArrayLike) -> Array:
    """I(x/a) under q0 (1 − (x/a)²): greatest 1.959592 at x/a = 1/2.

    Examples
    --------
    >>> parabolic_profile([0.5, 1.0]).round(6).tolist()
    [1.959592, 1.508494]
    """
    since_entry, since_exit = _lags(place)
    x = np.asarray(place, float)

    def to(lag: Array) -> Array:
        root = np.sqrt(lag)
        return np.asarray(root * (2.0 * (1.0 - x * x) + lag * (4.0 / 3.0 * x - 0.4 * lag)))

    return np.asarray(to(since_entry) - to(since_exit))


def semi_elliptic_profile(place: ArrayLike) -> Array:
    """I(x/a) under q0 √(1 − (x/a)²), as Hertz presses: greatest 2.188307 at x/a = 0.65223.

    Parameters
    ----------
    place : array_like
        x/a, any value.

    Returns
    -------
    ndarray
        Zero before the entry, 4√2/3 = 1.885618 at the exit, (π/2)/√(x/a) far behind.

    Notes
    -----
    With m = (1 + x/a)/2 and complete elliptic integrals of the parameter m: inside
    (4√2/3)[(2m − 1) E(m) + (1 − m) K(m)]; behind, (π/(2√2)) ₂F₁(1/2, 3/2; 3; 1/m)/√m. Both follow
    from s = −1 + (1 + min(1, x/a)) sin²θ in the integral.

    Checked by tests/reference/flash_temperature (1e-8, a table by quadrature).

    Examples
    --------
    >>> semi_elliptic_profile([0.6522295, 1.0, 5.0]).round(6).tolist()
    [2.188307, 1.885618, 0.705155]
    """
    m = 0.5 * (1.0 + np.asarray(place, float))
    inside = np.clip(m, 0.0, 1.0)
    rest = np.maximum(1.0 - inside, 1e-300)  # (1 − m) K(m) → 0 at the exit
    within = (2.0 * inside - 1.0) * ellipe(inside) + rest * ellipkm1(rest)
    beyond = np.maximum(m, 1.0)
    behind = np.pi / np.sqrt(8.0 * beyond) * hyp2f1(0.5, 1.5, 3.0, 1.0 / beyond)
    return np.asarray(np.where(m < 1.0, 4.0 * np.sqrt(2.0) / 3.0 * within, behind))


def strip_profile(places: ArrayLike, flux: ArrayLike) -> Array:
    """∫ q(x')/√(x − x') dx' at each place, for any heat flux: straight between the places.

    Parameters
    ----------
    places : array_like, shape (n,)
        Rising, from the entry on; go on behind the patch with zero flux for the tail [m].
    flux : array_like, shape (..., n)
        Heat flux there, one row a strip [W/m²].

    Returns
    -------
    ndarray, shape (..., n)
        The integral [W/m^1.5]; divide by β√(πv) for the rise in kelvin.

    Raises
    ------
    RailgripError
        "the places must rise" or "one heat flux for each place is needed".

    Notes
    -----
    Exact for the straight pieces; with places of even distance h the error against a smooth flux
    falls with h², where the flux starts like a root (Hertz) with h.

    Checked by tests/unit/laboratory/test_heat_profiles.py.

    Examples
    --------
    >>> x = np.linspace(-1.0, 1.0, 5)
    >>> strip_profile(x, np.ones(5))[-1].round(6).tolist()
    2.828427
    """
    x, q = np.asarray(places, float), np.asarray(flux, float)
    if x.ndim != 1 or x.size < 2 or not np.all(np.diff(x) > 0.0):
        raise RailgripError(
            Problem("places", "the places must rise", cure="sort them, two or more")
        )
    if q.shape[-1:] != x.shape or not np.all(np.isfinite(q)):
        raise RailgripError(
            Problem("flux", "one heat flux for each place is needed", got=f"shape {q.shape}")
        )
    lag = np.maximum(x[:, None] - x[None, :], 0.0)
    root = np.sqrt(lag)
    # ∫ over one piece of 1/√ and of (x' − left)/√, each as the difference of its ends
    length = np.diff(x)
    plain = 2.0 * (root[:, :-1] - root[:, 1:])
    cubed = (lag * root)[:, :-1] - (lag * root)[:, 1:]
    rising = (lag[:, :-1] * plain - cubed / 1.5) / length
    rising = np.where(lag[:, :-1] > 0.0, rising, 0.0)
    weights = np.zeros((x.size, x.size))
    weights[:, :-1] += plain - rising
    weights[:, 1:] += rising
    return np.asarray(q @ weights.T)


def _lags(place: ArrayLike) -> tuple[Array, Array]:
    """Distance behind the entry and behind the exit, zero before them."""
    x = np.asarray(place, float)
    return np.maximum(1.0 + x, 0.0), np.maximum(x - 1.0, 0.0)
