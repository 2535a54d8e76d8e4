"""In how many directions a result falls: a greatest-of-planes fit to pilot runs.

The fall of the smallest of several quantities is the greatest of several planes, and the runs
beyond a bound are then a union of half-spaces, one for each plane. A convex fall, such as a
distance from the centre, is a greatest of many planes.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.rare.surrogate import fit_direction

FloatArray = NDArray[np.float64]

EXACT: Final = 0.9999
"""Share of the variance at which no further plane is sought."""
CUTS: Final = 2
"""Random ways to cut a plane in two, besides the one in which it bends most."""
GAIN: Final = 0.8
"""A further plane must bring the squared error down to this share at least."""
ALIKE: Final = 0.9
"""Cosine beyond which two planes are one direction, bent."""
MOST_FACES: Final = 6
TURNS: Final = 8
"""Rounds of sharing out the runs among the planes and fitting them anew."""


class Plane(NamedTuple):
    """Fall ≈ constant + gradient · normals, for the runs where this plane is the greatest."""

    constant: float
    gradient: FloatArray


def fit_planes(
    normals: FloatArray, fall: FloatArray, begin: list[list[Plane]] | None = None
) -> list[Plane]:
    """Return the planes whose greatest fits a fall.

    Parameters
    ----------
    normals : (runs, variables)
        Standard normal numbers.
    fall : (runs,)
        By how much each run is worse than the one with every variable at its median.
    begin : list of planes, optional
        Fits to begin with, besides a single plane; the best one goes on.

    Returns
    -------
    planes : list of Plane
        At least one; no two point the same way.

    References
    ----------
    .. [1] A. Magnani, S. Boyd, Convex piecewise-linear fitting, Optim. Eng. 10 (2009) 1-17, §3.1
       (least-squares partition algorithm).

    Examples
    --------
    >>> u = np.random.default_rng(1).standard_normal((400, 3))
    >>> len(fit_planes(u, u[:, 0])), len(fit_planes(u, u.max(axis=1)))
    (1, 3)
    """
    fewest = normals.shape[1] + 5
    single = [Plane(*fit_direction(normals, fall))]
    tried = [single]
    for known in begin or []:
        settled = _settled(share_out(known, normals), len(known), normals, fall, fewest)
        tried += [settled] if settled else []
    planes = min(tried, key=lambda one: _error(one, normals, fall))
    error, enough = _error(planes, normals, fall), (1.0 - EXACT) * _variance(fall)
    while error > enough and len(planes) < MOST_FACES:
        more = _one_more(planes, normals, fall, fewest)
        now = _error(more, normals, fall)
        if len(more) <= len(planes) or now > GAIN * error:
            break
        planes, error = more, now
    kept = _apart(planes)
    return kept if len(kept) > 1 else single


def explained(planes: list[Plane], normals: FloatArray, fall: FloatArray) -> float:
    """Return the share of the variance of a fall that planes explain."""
    return 1.0 - _error(planes, normals, fall) / max(_variance(fall), 1e-300)


def _variance(fall: FloatArray) -> float:
    return float(np.var(fall)) * len(fall)


def share_out(planes: list[Plane], normals: FloatArray) -> NDArray[np.intp]:
    """Return which plane is the greatest in each run."""
    owner: NDArray[np.intp] = np.argmax(_heights(planes, normals), axis=1)
    return owner


def _heights(planes: list[Plane], normals: FloatArray) -> FloatArray:
    gradients = np.array([plane.gradient for plane in planes])
    constants = np.array([plane.constant for plane in planes])
    heights: FloatArray = constants + normals @ gradients.T
    return heights


def _error(planes: list[Plane], normals: FloatArray, fall: FloatArray) -> float:
    return float(((fall - _heights(planes, normals).max(axis=1)) ** 2).sum())


def _one_more(
    planes: list[Plane], normals: FloatArray, fall: FloatArray, fewest: int
) -> list[Plane]:
    """Return the best fit of one plane more: each one is tried at being split in two."""
    owner = share_out(planes, normals)
    missed = fall - _heights(planes, normals).max(axis=1)
    tries = []
    for split in range(len(planes)):
        own = np.flatnonzero(owner == split)
        if len(own) < 2 * fewest:
            continue
        # what bends most within the plane's own runs tells where to cut it
        inside = normals[own] - normals[own].mean(axis=0)
        twist = (inside * missed[own, None]).T @ inside
        _, vectors = np.linalg.eigh(twist)
        random = np.random.default_rng(split).standard_normal((CUTS, normals.shape[1]))
        for cut in [vectors[:, -1], *random]:
            begun = owner.copy()
            begun[own[inside @ cut > 0.0]] = len(planes)
            tries.append(_settled(begun, len(planes) + 1, normals, fall, fewest))
    return min(tries, key=lambda one: _error(one, normals, fall), default=planes)


def _settled(
    owner: NDArray[np.intp], count: int, normals: FloatArray, fall: FloatArray, fewest: int
) -> list[Plane]:
    best: list[Plane] = []
    least = np.inf
    for _ in range(TURNS):
        members = [owner == plane for plane in range(count)]
        planes = [Plane(*fit_direction(normals[own], fall[own])) for own in members
                  if own.sum() >= fewest]  # fmt: skip
        if not planes:
            break
        error = _error(planes, normals, fall)
        if error >= least:
            break
        best, least, count = planes, error, len(planes)
        owner = share_out(planes, normals)
    return best


def _apart(planes: list[Plane]) -> list[Plane]:
    """Keep, of planes that point the same way, the steepest; flat ones go, but one stays."""
    steepness = [float(np.linalg.norm(plane.gradient)) for plane in planes]
    kept: list[Plane] = []
    for place in np.argsort(steepness)[::-1]:
        plane = planes[place]
        if kept and steepness[place] < 0.05 * max(steepness):
            continue
        alike = [
            plane.gradient @ other.gradient
            > ALIKE * np.linalg.norm(plane.gradient) * np.linalg.norm(other.gradient)
            for other in kept
        ]
        if not any(alike):
            kept.append(plane)
    return kept
