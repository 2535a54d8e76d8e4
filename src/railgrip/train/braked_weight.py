"""Braked weight percentage of a stop (UIC 544-1): how a stopping distance stands in a data sheet.

Use it to read a simulated emergency stop as operators do, or to learn from a data sheet what stop
to expect. It holds for dry, level track and from the speeds below only. A percentage times the
mass of what was braked is the braked weight.
"""

from __future__ import annotations

from typing import NamedTuple

from railgrip.core.errors import Problem, RailgripError


class Scale(NamedTuple):
    """One line of the scale, ``s = distance / (percentage + offset)``."""

    distance: float
    """C, m."""
    offset: float
    """D, %."""


TRAINS = {
    100: Scale(61_300.0, 8.9),
    120: Scale(91_633.0, 11.6),
    140: Scale(130_995.0, 11.6),
    160: Scale(176_714.0, 11.6),
    200: Scale(287_620.0, 11.6),
}
"""By speed in km/h, for whole trains."""
SINGLE_VEHICLES = {
    100: Scale(52_840.0, 10.0),
    120: Scale(83_634.0, 19.0),
    140: Scale(119_179.0, 19.0),
    160: Scale(161_280.0, 19.0),
}
"""By speed in km/h, for a vehicle that is uncoupled and stops alone (slip test)."""
TOLERANCE = 0.05
"""A speed counts as one of the scale's within so much, m/s."""


def braked_weight_percentage(
    stopping_distance: float, speed: float, *, single_vehicle: bool = False
) -> float:
    """Return the braked weight percentage λ of a stop.

    Parameters
    ----------
    stopping_distance : float
        From the emergency command to the stand, dry and level, > 0, [m].
    speed : float
        At the command, one of the scale's: 100, 120, 140, 160, for trains also 200 km/h, [m/s].
    single_vehicle : bool
        Whether one vehicle stopped alone; its scale is another than that of whole trains.

    Returns
    -------
    float
        λ, braked weight over mass, [%].

    Raises
    ------
    RailgripError
        ``speed: has no braked weight scale; got 90 km/h; allowed: 100, 120, 140, 160, 200 km/h``.

    Notes
    -----
    ``λ = C/s − D``. A train fills more slowly than a vehicle alone and its stop is not corrected
    for that, which is why the constants differ.

    References
    ----------
    .. [1] UIC 544-1, Brakes – Braking performance; EN 16834:2019. Constants of single vehicles as
       in R. Pfaff's notebooks on brake calculation (FH Aachen, MIT licence); they reproduce table
       C.3 of the WAG TSI: 480 m = 100 %, 700 m = 65 % from 100 km/h.

    Checked by tests/reference/braked_weight.

    Examples
    --------
    >>> round(braked_weight_percentage(596.0, 100 / 3.6, single_vehicle=True), 1)
    78.7
    """
    scales = SINGLE_VEHICLES if single_vehicle else TRAINS
    if not stopping_distance > 0.0:
        raise RailgripError(
            Problem("stopping_distance", "must be positive", got=f"{stopping_distance:g} m")
        )
    for kmh, scale in scales.items():
        if abs(speed - kmh / 3.6) <= TOLERANCE:
            return scale.distance / stopping_distance - scale.offset
    raise RailgripError(
        Problem(
            "speed",
            "has no braked weight scale",
            got=f"{speed * 3.6:.4g} km/h",
            allowed=f"{', '.join(str(kmh) for kmh in scales)} km/h",
        )
    )
