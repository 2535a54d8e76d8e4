"""Where the rare runs lie: in each failure state a few directions, how far along they begin.

Learnt from pilot runs, and used to place samples only. A poor surrogate costs runs; it cannot bias
an estimate, because the weights of the samples are exact whatever placed them.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr

from railgrip.campaign.rare.failures import FailureStates

FloatArray = NDArray[np.float64]
LEAST_SLOPE = 1e-12
"""A result that depends on nothing gets this slope, so that one can divide by it."""


class Bend(NamedTuple):
    """Position along the direction against the position that a straight line would give.

    ``t = constant + linear z + quadratic z²`` between the ends, straight on beyond them.
    """

    constant: float = 0.0
    linear: float = 1.0
    quadratic: float = 0.0
    low: float = -40.0
    high: float = 40.0

    def __call__(self, z: FloatArray) -> FloatArray:
        """Return t, at most 40 in size (beyond is nothing a double can tell)."""
        inside = np.clip(z, self.low, self.high)
        slope = self.linear + 2.0 * self.quadratic * inside
        t = self.constant + (self.linear + self.quadratic * inside) * inside
        return np.clip(t + slope * (z - inside), -40.0, 40.0)


UNREACHABLE = 40.0
"""Position that no run gets to."""


class Surrogate(NamedTuple):
    """One face: result of a run ≈ centre − slope · t, bent; t is standard normal along a direction.

    A result that falls in several directions has several faces, and is the least of what they say.

    Attributes
    ----------
    centre : (states,)
        Result with every variable at its median, as this face sees it.
    direction : (states, variables)
        Unit vector that points where the result becomes worse (smaller).
    slope : (states,)
        Fall of the result per unit of t, > 0.
    bend : list of Bend
        One for each number of failed units.
    is_there : (states,) bool
        Whether the state has this face.
    """

    centre: FloatArray
    direction: FloatArray
    slope: FloatArray
    bend: list[Bend]
    is_there: NDArray[np.bool_]

    def beginnings(self, states: FailureStates, bounds: FloatArray) -> FloatArray:
        """Return t beyond which a run is worse than each bound, (bounds, states)."""
        z = (self.centre - bounds[:, None]) / self.slope
        t = np.empty_like(z)
        for count, bend in enumerate(self.bend):
            here = states.n_failed == count
            t[:, here] = bend(z[:, here])
        return np.where(self.is_there, t, UNREACHABLE)


def probability(faces: list[Surrogate], states: FailureStates, bounds: FloatArray) -> FloatArray:
    """Return the probability of a worse result than each bound, as the faces see it together."""
    tails: FloatArray = np.sum([ndtr(-face.beginnings(states, bounds)) for face in faces], axis=0)
    seen: FloatArray = np.minimum(tails, 1.0) @ states.weight
    return seen


def bounds_of(
    faces: list[Surrogate], states: FailureStates, probabilities: FloatArray
) -> FloatArray:
    """Return the results that are undercut with the given probabilities (by bisection)."""
    ends = [(face.centre - 45.0 * face.slope, face.centre + 45.0 * face.slope) for face in faces]
    low = np.full(len(probabilities), min(low.min() for low, _ in ends))
    high = np.full(len(probabilities), max(high.max() for _, high in ends))
    for _ in range(100):
        middle = 0.5 * (low + high)
        above = probability(faces, states, middle) > probabilities
        high, low = np.where(above, middle, high), np.where(above, low, middle)
    bounds: FloatArray = 0.5 * (low + high)
    return bounds


def fit_direction(
    normals: FloatArray, fall: FloatArray, *, ridge: float = 1e-6
) -> tuple[float, FloatArray]:
    """Return constant and gradient of a linear least-squares fit of ``fall`` over normals."""
    table = np.column_stack([np.ones(len(fall)), normals])
    square = table.T @ table
    square[np.diag_indices_from(square)] += ridge * len(fall)
    solved = np.linalg.solve(square, table.T @ fall)
    return float(solved[0]), solved[1:]


def fit_bend(z: FloatArray, t: FloatArray) -> Bend:
    """Return the bend that fits samples: t as a function of the straight line's z.

    A fit that is not rising over all samples, or has too few of them, is replaced by a straight
    one, and that by none.
    """
    spread = float(np.ptp(z)) if len(z) else 0.0
    if len(z) < 12 or spread < 1.0:
        return Bend()
    low, high = np.quantile(z, [0.02, 0.98])
    for order in (2, 1):
        coefficients = np.polynomial.polynomial.polyfit(z, t, order)
        constant, linear, quadratic = (*coefficients, 0.0)[:3]
        slopes = linear + 2.0 * quadratic * np.array([low, high])
        if np.all(slopes > 0.2):
            return Bend(constant, linear, quadratic, low, high)
    return Bend()


def surrogate_of(
    centre: FloatArray, gradients: FloatArray, bend: list[Bend], is_there: NDArray[np.bool_]
) -> Surrogate:
    """Return the face of gradients (states, variables) of the result."""
    slope = np.linalg.norm(gradients, axis=1)
    direction = np.zeros_like(gradients)
    moving = slope > LEAST_SLOPE
    direction[moving] = -gradients[moving] / slope[moving, None]
    direction[~moving, 0] = 1.0
    return Surrogate(centre, direction, np.maximum(slope, LEAST_SLOPE), bend, is_there)
