"""Creep curves of the plant's laws, under any friction law."""

from __future__ import annotations

from collections.abc import Callable

from numpy.typing import ArrayLike

from railgrip.contact.rail_friction import RailFriction
from railgrip.laboratory.creep_curve import CreepCurve, creep_curve
from railgrip.laboratory.friction_curve import with_friction
from railgrip.laboratory.inputs import checked_number

PlantLaw = Callable[[RailFriction, float, float, float, float], float]
"""``law(rail, load, slope, slip_speed, creepage)``, registered under ``railgrip.laws``."""


def curve_of_plant_law(
    law: PlantLaw,
    rail: RailFriction,
    *,
    load: float,
    slope: float,
    speed: float,
    creepage: ArrayLike | None = None,
    friction: Callable[[float], float] | None = None,
) -> CreepCurve:
    """Creep curve of a law of the plant.

    Parameters
    ----------
    law : function
        `polach_2005` or another of the group ``railgrip.laws``.
    rail : RailFriction
        State of the rail.
    load, slope, speed : float
        Wheel load [N], initial slope of Kalker's theory [N], speed of the train [m/s], all > 0.
    creepage : array, optional
        Creepages; `railgrip.laboratory.creep_curve.CREEPAGES` if not given.
    friction : function, optional
        Friction coefficient at a slip speed, in place of the rail's own; make it from any friction
        law, e.g. ``lambda w: three_regime_friction(parameters, w, 20.0)``.

    Returns
    -------
    CreepCurve
        The curve in its four forms.

    Raises
    ------
    RailgripError
        From `creep_curve`, and for a slope that is not positive.

    Examples
    --------
    >>> from railgrip.contact.polach_2005 import polach_2005
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> curve = curve_of_plant_law(
    ...     polach_2005, DRY_POLACH_2005, load=100e3, slope=14.523733e6, speed=20.0
    ... )
    >>> round(curve.peak.adhesion, 3), round(100 * curve.peak.creepage, 2)
    (0.397, 2.63)
    """
    load = checked_number("load", load, "N", least=0.0)
    slope = checked_number("slope", slope, "N", least=0.0)
    speed = checked_number("speed", speed, "m/s", least=0.0)

    def force(s: float) -> float:
        slip_speed = s * speed
        here = rail if friction is None else with_friction(rail, friction(slip_speed))
        return law(here, load, slope, slip_speed, s)

    return creep_curve(speed=speed, load=load, creepage=creepage, force=force)
