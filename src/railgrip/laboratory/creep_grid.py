"""Curves of a creep table side by side: the look-up between them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction
from railgrip.laboratory.creep_spline import LEAST_FORCE, cell_of, spline_value
from railgrip.laboratory.inputs import FloatArray


class GridAxis(NamedTuple):
    """What the curves of a table differ in: they stand evenly in p, 0 … 1.

    Where lateral creepage or spin crosses the longitudinal creepage, p = f/(f + c): f is linear
    theory's force along the track, and c the one that the crossing creepages would give there,
    c = `size` · (`by_slope` · C/(μQ) + `by_friction`/μ), both over the friction force. So p is the
    direction in which the patch is strained, 1 along the track.
    Where friction falls with the slip of each point, p = 1/(1 + `size` · B w) with the slip speed w
    of the centre.

    Parameters
    ----------
    by_slope, by_friction, by_fall : float
        One of them is 1, the others are 0.
    size : float
        Of what distinguishes the curves, ≥ 0; where there is but one curve, 0.
    lateral : float
        Lateral creepage, which adds to the slip speed [-].
    """

    by_slope: float
    by_friction: float
    by_fall: float
    size: float
    lateral: float


BY_SLOPE, BY_FRICTION, BY_FALL, SIZE, LATERAL = (np.uint64(i) for i in range(len(GridAxis._fields)))


def chord_by_grid(
    grid: FloatArray,
    axis: FloatArray,
    rail: RailFriction,
    load: float,
    slope: float,
    speed: float,
    creepage: float,
) -> float:
    """Creep force over creepage, by a table of many curves.

    Choose it where `chord_by_table` does not do; it looks up two curves for one.

    Parameters
    ----------
    grid : ndarray (curve, cells + 2)
        Coefficients of the curves, at least two.
    axis : ndarray (5)
        The numbers of `GridAxis`.
    rail : RailFriction
        State of the rail.
    load : float
        Normal force Q, ≥ 0 [N].
    slope : float
        Initial slope of linear theory C at this load [N per unit creepage].
    speed : float
        Rolling speed, ≥ 0 [m/s].
    creepage : float
        Magnitude of the longitudinal creepage, ≥ 0 [-].

    Returns
    -------
    float
        F/s [N per unit creepage]; NaN where an argument is.

    Notes
    -----
    As `chord_by_table`, with μ at the slip speed v √(s² + s_y²), and linear between neighbouring
    curves. A curve runs over u = t/(1 + t) of the whole strain t = √(f² + c²), and holds χ in
    F = μQ χ f/(1 + t), which comes near F = μQ f/t when all slides: crossing creepages take from
    the force by turning it.
    F is at most μQ; on the axis of a fall at most μ0 Q, for there each point of the patch has its
    own slip, which may be less than that of the whole.

    Examples
    --------
    >>> axis = np.array(GridAxis(0.0, 1.0, 0.0, 0.0, 0.0))
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> float(chord_by_grid(np.ones((2, 6)), axis, rail, 100e3, 15e6, 20.0, 0.002))
    7500000.0
    """
    lateral, by_fall = axis[LATERAL], axis[BY_FALL]
    slip_speed = speed * math.sqrt(creepage * creepage + lateral * lateral)
    friction = falling_friction(rail, slip_speed)
    per_force = 1.0 / max(slope * creepage, LEAST_FORCE)
    # with y = 1/f and d = c/f nothing is divided by a friction of zero
    y = friction * load * per_force
    d = axis[SIZE] * (axis[BY_SLOPE] * slope + axis[BY_FRICTION] * load) * per_force
    fall = axis[SIZE] * rail.friction_decay * slip_speed
    last = float(grid.shape[0] - 1)
    place = last / (1.0 + d + by_fall * fall)
    curve = cell_of(place, last)
    share = place - np.float64(curve)

    turned = math.sqrt(1.0 + d * d)
    cells = float(grid.shape[1] - 2)
    along = cells * turned / (y + turned)
    cell = cell_of(along, cells)
    second, third, following = cell + np.uint64(1), cell + np.uint64(2), curve + np.uint64(1)
    # between two splines lies the spline with coefficients between theirs
    first = grid[curve, cell] + share * (grid[following, cell] - grid[curve, cell])
    middle = grid[curve, second] + share * (grid[following, second] - grid[curve, second])
    outer = grid[curve, third] + share * (grid[following, third] - grid[curve, third])
    chi = spline_value(first, middle, outer, along - np.float64(cell))
    most = friction + by_fall * (rail.static_friction - friction)
    chord: float = slope * min(y * chi / (y + turned), most * load * per_force)
    return chord
