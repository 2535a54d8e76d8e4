"""A law asked for its share of the friction force, at the points that a table needs."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import resultant
from railgrip.contact.rolling_contact import Creepage, RollingContact, RollingLaw
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.laws_over_arrays import creep_forces

SMALLEST, LARGEST = 1e-5, 1e9
"""Forces of linear theory over friction force that stand for none and for infinite creepage."""
_NEWTON_STEPS = 60


class Points(NamedTuple):
    """Where a law is asked.

    Parameters
    ----------
    contact, rail
        The contact under its load, and the rail.
    speed : ndarray
        Speed of the train [m/s].
    creepage, lateral : ndarray
        Longitudinal and lateral creepage [-].
    spin : ndarray
        [1/m].
    """

    contact: RollingContact
    rail: RailFriction
    speed: FloatArray
    creepage: FloatArray
    lateral: FloatArray
    spin: FloatArray


def linear_slope(contact: RollingContact) -> float:
    """Initial slope of linear theory, C = G a b C11 [N per unit creepage].

    Examples
    --------
    >>> wheel = RollingContact(100e3, 8e-3, 5e-3, 80e9, 0.28, 4.5, 4.1, 1.8, 1.0)
    >>> round(linear_slope(wheel), 3)
    14400000.0
    """
    return contact.shear_modulus * contact.a * contact.b * contact.c11


def linear_share(places: FloatArray) -> FloatArray:
    """Return f = u/(1 − u) for places u from 0 to 1, from `SMALLEST` to `LARGEST`.

    Examples
    --------
    >>> linear_share(np.array([0.0, 0.5, 0.75])).tolist()
    [1e-05, 1.0, 3.0]
    """
    rest = np.maximum(1.0 - places, 1.0 / LARGEST)
    shares: FloatArray = np.clip(places / rest, SMALLEST, LARGEST)
    return shares


def points_at(
    contact: RollingContact, rail: RailFriction, speed: float, linear: FloatArray,
    lateral: float, spin: float,
) -> Points:  # fmt: skip
    """Points where linear theory's longitudinal force is `linear` times the friction force.

    Examples
    --------
    >>> wheel = RollingContact(100e3, 8e-3, 5e-3, 80e9, 0.28, 4.5, 4.1, 1.8, 1.0)
    >>> rail = RailFriction(0.3, 0.4, 0.2, 1.0, 1.0)
    >>> points_at(wheel, rail, 20.0, np.array([1.0]), 0.0, 0.0).creepage.round(6).tolist()
    [0.002073]
    """
    creepage = [_creepage_at(contact, rail, speed, each, lateral) for each in linear.tolist()]
    ones = np.ones(linear.size)
    return Points(contact, rail, speed * ones, np.array(creepage), lateral * ones, spin * ones)


def _creepage_at(
    contact: RollingContact, rail: RailFriction, speed: float, linear: float, lateral: float
) -> float:
    """Solve C s = f μ(w) Q, w = v √(s² + s_y²), by Newton's method from s = f A μ0 Q/C.

    The friction falls, so there is one solution, and it is approached from below.
    """
    per_friction = linear * contact.load / linear_slope(contact)
    least = rail.friction_ratio * rail.static_friction
    creepage = per_friction * least
    for _ in range(_NEWTON_STEPS):
        straight = resultant(creepage, lateral)
        friction = falling_friction(rail, speed * straight)
        turn = creepage / straight if straight > 0.0 else 0.0
        fall = rail.friction_decay * speed * (friction - least)
        step = (per_friction * friction - creepage) / (1.0 + per_friction * fall * turn)
        creepage += step
        if abs(step) <= 1e-15 * creepage:
            break
    return creepage


def is_compiled(law: RollingLaw) -> bool:
    """Whether a law is one of the package's scalar functions, which are compiled and so fast.

    Examples
    --------
    >>> from railgrip.contact.fastsim_1982 import fastsim_1982
    >>> is_compiled(fastsim_1982), is_compiled(lambda contact, rail, speed, creepage: None)
    (True, False)
    """
    return getattr(law, "__module__", "").startswith("railgrip.contact.")


class Law:
    """A law, and who is to hear how many points it has been asked for.

    Laws of the package are compiled; any other function is called from Python, point by point.

    Parameters
    ----------
    law : callable
        With the contract of a law of rolling contact.
    asked : callable
        Called with a number of points, whenever so many more are done.
    """

    def __init__(self, law: RollingLaw, asked: Callable[[int], None]) -> None:
        self._law, self._asked = law, asked
        self._is_compiled = is_compiled(law)

    def shares(self, points: Points) -> FloatArray:
        """Return longitudinal force over friction force μQ, with μ at the centre's slip speed.

        Raises
        ------
        RailgripError
            "the law gave no finite force; got nan at creepage 0.001".
        """
        straight = np.sqrt(points.creepage**2 + points.lateral**2)
        slip_speed = (points.speed * straight).tolist()
        friction = [falling_friction(points.rail, each) for each in slip_speed]
        force = self._forces(points)
        if not np.isfinite(force).all():
            wrong = int(np.flatnonzero(~np.isfinite(force))[0])
            got = f"{force[wrong]} at creepage {points.creepage[wrong]:.3g}"
            raise RailgripError(Problem("", "the law gave no finite force", got=got))
        shares: FloatArray = force / (points.contact.load * np.array(friction))
        return shares

    def _forces(self, points: Points) -> FloatArray:
        contact, rail, *columns = points
        if self._is_compiled:
            force = creep_forces(self._law, contact, rail, *columns).longitudinal
            self._asked(force.size)
            return force
        force = np.empty(points.creepage.size)
        rows = zip(*(each.tolist() for each in columns), strict=True)
        for i, (speed, *creepage) in enumerate(rows):
            force[i] = self._law(contact, rail, speed, Creepage(*creepage)).longitudinal
            self._asked(1)
        return force


def coulomb(rail: RailFriction, friction: float) -> RailFriction:
    """Return a rail whose friction does not fall; k_A and k_S are those of the rail given.

    Examples
    --------
    >>> coulomb(RailFriction(0.3, 0.4, 0.2, 0.9, 0.8), 0.1)[:3]
    (0.1, 1.0, 0.0)
    """
    return rail._replace(static_friction=friction, friction_ratio=1.0, friction_decay=0.0)
