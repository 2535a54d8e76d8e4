"""The curves that a table needs of a law, and the points at which it is compared with it."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import RollingContact
from railgrip.laboratory.creep_grid import GridAxis
from railgrip.laboratory.creep_samples import (
    Points,
    coulomb,
    linear_share,
    linear_slope,
    points_at,
)
from railgrip.laboratory.creep_spline import places_between
from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.laws_over_arrays import rescaled

STEEPEST = 1e3
"""c over f, or fall of friction, that stands for infinity."""
OTHER_STATES = (
    (0.7, 0.02, 0.4, 0.2, 20.0),
    (0.7, 0.1, 0.4, 0.2, 5.0),
    (1.3, 0.1, 1.0, 0.0, 20.0),
    (1.3, 0.5, 0.5, 0.6, 40.0),
)
"""Where a table is compared too: load over reference, μ0, A, B [s/m], speed [m/s]."""
FEW = 16
"""Points of a comparison away from the curves."""
_SPEED = 20.0
"""Of no matter where friction does not fall, m/s."""


class Frame(NamedTuple):
    """What the curves of a table have in common."""

    contact: RollingContact
    rail: RailFriction
    lateral: float
    spin: float
    axis: GridAxis

    @property
    def crossing(self) -> float:
        """Strain c by lateral creepage and spin, at the load and friction of reference [-]."""
        own, axis = self.contact, self.axis
        unit = axis.by_slope * linear_slope(own) + axis.by_friction * own.load
        return axis.size * unit / (own.load * self.rail.static_friction)


class Curve(NamedTuple):
    """Points of one curve.

    Parameters
    ----------
    points : Points
        Where the law is asked.
    scale : ndarray
        Creepages and friction there over those for which the point stands [-].
    along, across : ndarray
        Strains f and c [-].
    """

    points: Points
    scale: FloatArray
    along: FloatArray
    across: FloatArray


def axis_for(contact: RollingContact, lateral: float, spin: float, is_local: bool) -> GridAxis:
    """What the curves of a table differ in.

    Examples
    --------
    >>> wheel = RollingContact(100e3, 8e-3, 5e-3, 80e9, 0.28, 4.5, 4.5, 1.8, 1.0)
    >>> axis_for(wheel, 0.003, 0.0, False)
    GridAxis(by_slope=1.0, by_friction=0.0, by_fall=0.0, size=0.003, lateral=0.003)
    """
    if is_local:
        return GridAxis(0.0, 0.0, 1.0, 1.0, lateral)
    # creepages that would give the same force along the track, by linear theory
    sideways = contact.c22 * abs(lateral) / contact.c11
    turning = math.sqrt(contact.a * contact.b) * contact.c23 * abs(spin) / contact.c11
    size = math.hypot(sideways, turning)
    if turning > sideways:
        return GridAxis(0.0, 1.0, 0.0, size * linear_slope(contact) / contact.load, lateral)
    return GridAxis(1.0 if size > 0.0 else 0.0, 0.0, 0.0, size, lateral)


def curve_at(frame: Frame, p: float, places: FloatArray) -> Curve:
    """Points of the curve that stands at p, at places u.

    The strain c of constant creepages changes with the friction, so that a curve needs every
    friction. By similarity that of reference does, with all creepages in proportion.
    """
    contact, rail = frame.contact, frame.rail
    strain = linear_share(places)
    steep = min((1.0 - p) / max(p, 1.0 / STEEPEST), STEEPEST)
    ones, zeros = np.ones(places.size), np.zeros(places.size)
    if frame.axis.by_fall:
        slip_speed = max(steep, 1e-9) / rail.friction_decay
        level = coulomb(rail, falling_friction(rail, slip_speed))
        points = points_at(contact, level, _SPEED, strain, frame.lateral, frame.spin)
        speed = slip_speed / np.sqrt(points.creepage**2 + points.lateral**2)
        return Curve(points._replace(rail=rail, speed=speed), ones, strain, zeros)
    level = coulomb(rail, rail.static_friction)
    if frame.axis.size == 0.0:
        points = points_at(contact, level, _SPEED, strain, 0.0, 0.0)
        return Curve(points, ones, strain, zeros)
    along = strain / math.sqrt(1.0 + steep * steep)
    across = along * steep
    # where nothing crosses, any friction does
    scale = across / frame.crossing if steep > 0.0 else zeros
    points = points_at(contact, level, _SPEED, along, 0.0, 0.0)
    points = points._replace(lateral=scale * frame.lateral, spin=scale * frame.spin)
    return Curve(points, scale, along, across)


def curves_between(frame: Frame, cells: int, n_curves: int) -> list[Curve]:
    """Points between the nodes and, where there are several curves, between these."""
    places = places_between(cells)
    if n_curves == 1:
        return [curve_at(frame, 1.0, places)]
    every = max(1, places.size // FEW)
    middles = [(i + 0.5) / (n_curves - 1) for i in range(n_curves - 1)]
    return [curve_at(frame, p, places[i % every :: every]) for i, p in enumerate(middles)]


def points_elsewhere(frame: Frame, cells: int) -> list[Points]:
    """Points at other loads, speeds and states of the rail, for which similarity must answer."""
    linear = linear_share(places_between(min(cells, FEW)))
    found = []
    for load, friction, ratio, decay, speed in OTHER_STATES:
        rail = frame.rail._replace(
            static_friction=friction,
            friction_ratio=frame.rail.friction_ratio if frame.axis.by_fall else ratio,
            friction_decay=decay,
        )
        contact = rescaled(frame.contact, load * frame.contact.load)
        found.append(points_at(contact, rail, speed, linear, frame.lateral, frame.spin))
    return found
