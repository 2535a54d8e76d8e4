"""A friction law over arrays of slip speed and temperature."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.contact.rail_friction import RailFriction
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.inputs import checked_array

FrictionLaw = Callable[[Any, float, float], float]

_MAY_BE_NEGATIVE = ("friction_change", "reference_temperature")


def friction_curve(
    law: FrictionLaw, parameters: Any, slip_speed: ArrayLike, temperature: ArrayLike = 20.0
) -> NDArray[np.float64]:
    """Friction coefficients of a law at many slip speeds, temperatures, or both.

    Parameters
    ----------
    law : function
        `friction(parameters, slip_speed, temperature)`, see `railgrip.contact`.
    parameters : NamedTuple
        What the law reads.
    slip_speed : array
        Magnitudes of the slip speed, ≥ 0 [m/s].
    temperature : array
        Temperatures of the contact [°C]; one, or as many as there are slip speeds. One slip speed
        goes with many temperatures too.

    Returns
    -------
    ndarray
        Friction coefficients [-].

    Raises
    ------
    RailgripError
        ``slip_speed: must not be negative``, ``kinetic_friction: must be a number and not
        negative; got -0.1``, or ``the friction law gives no friction coefficient …``.

    Examples
    --------
    >>> from railgrip.contact.linear_friction import LinearFriction, linear_friction
    >>> friction_curve(linear_friction, LinearFriction(0.3, 0.1, 2.0), [0.0, 1.0, 5.0]).tolist()
    [0.3, 0.2, 0.1]
    """
    _refuse_bad_parameters(parameters)
    speeds = checked_array("slip_speed", slip_speed)
    if (speeds < 0.0).any():
        raise RailgripError(
            Problem("slip_speed", "must not be negative", got=f"{speeds.min():g} m/s",
                    cure="give its magnitude")
        )  # fmt: skip
    warmth = checked_array("temperature", temperature)
    if 1 not in (speeds.size, warmth.size) and speeds.size != warmth.size:
        raise RailgripError(
            Problem("temperature", "must have one point, or as many as the slip speed",
                    got=f"{warmth.size} and {speeds.size}")
        )  # fmt: skip
    speeds, warmth = np.broadcast_arrays(speeds, warmth)
    points = zip(speeds.tolist(), warmth.tolist(), strict=True)
    friction = np.array([law(parameters, w, t) for w, t in points])
    if not (friction >= 0.0).all():
        k = int(np.argmin(np.where(np.isnan(friction), -np.inf, friction)))
        raise RailgripError(
            Problem("", "the friction law gives no friction coefficient",
                    got=f"{friction[k]:g} at {speeds[k]:g} m/s and {warmth[k]:g} °C")
        )  # fmt: skip
    return friction


def with_friction(rail: RailFriction, coefficient: float) -> RailFriction:
    """Return the rail with one friction coefficient, so that any friction law can rule it.

    Parameters
    ----------
    rail : RailFriction
        State of the rail, whose k_A and k_S stay.
    coefficient : float
        What a friction law gives at the slip speed of the moment, ≥ 0 [-].

    Examples
    --------
    >>> from railgrip.contact.rail_friction import WET_POLACH_2005
    >>> tuple(with_friction(WET_POLACH_2005, 0.2))
    (0.2, 1.0, 0.0, 0.3, 0.1)
    """
    return rail._replace(static_friction=coefficient, friction_ratio=1.0, friction_decay=0.0)


def _refuse_bad_parameters(parameters: Any) -> None:
    """NaN nowhere; nothing negative but what has a sign by nature. Infinity means "never"."""
    for name, value in parameters._asdict().items():
        if math.isnan(value) or (value < 0.0 and name not in _MAY_BE_NEGATIVE):
            words = "a number" if name in _MAY_BE_NEGATIVE else "a number and not negative"
            raise RailgripError(Problem(name, f"must be {words}", got=f"{value}"))
