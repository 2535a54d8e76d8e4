"""Deceleration and build-up time from the braked weight percentage (SUBSET-026, A.3.7 to A.3.9)."""

from __future__ import annotations

import math
from typing import Final

from railgrip.control.etcs.steps import Steps
from railgrip.core.errors import Problem, RailgripError, unknown_name

POSITIONS: Final = ("passenger P", "freight P", "freight G")
"""Brake positions the conversion knows."""
SERVICE_CAP: Final = 135.0
"""What the service brake counts for at most, %."""
LEAST, GREATEST = 30.0, 250.0
LONGEST: Final = {"passenger P": 900.0, "freight P": 1500.0, "freight G": 1500.0}
FASTEST: Final = 200.0 / 3.6

# Upper end in km/h and polynomial in λ of each range of speed.
_RANGES = (
    (100.0, (0.0663, 4.72e-3, 6.1e-5, -6.3e-7)),
    (120.0, (0.13, 5.14e-3, -4.54e-6, 2.73e-7)),
    (150.0, (0.0479, 5.81e-3, -6.76e-6, 5.58e-8)),
    (180.0, (0.048, 5.52e-3, -3.85e-6, 3e-8)),
    (math.inf, (0.0559, 5.06e-3, 1.66e-6, 3.23e-9)),
)
# (a, b, c, least length) up to 900 m and beyond, of a + b l + c l² with l = length/100 m.
_EMERGENCY = {
    "passenger P": ((2.3, 0.0, 0.17, 400.0),),
    "freight P": ((2.3, 0.0, 0.17, 400.0), (-0.5, 1.6, 0.03, 0.0)),
    "freight G": ((12.0, 0.0, 0.05, 0.0), (-0.4, 1.6, 0.03, 0.0)),
}
_SERVICE = {
    "passenger P": ((3.0, 1.5, 0.1, 0.0),),
    "freight P": ((3.0, 2.77, 0.0, 0.0), (10.5, 0.32, 0.18, 0.0)),
    "freight G": ((3.0, 2.77, 0.0, 400.0), (10.5, 0.32, 0.18, 0.0)),
}
_TO_A_SPEED = {"passenger P": 1.20, "freight P": 1.20, "freight G": 1.16}


def deceleration_of(percentage: float) -> Steps:
    """Return the basic deceleration over the speed.

    Parameters
    ----------
    percentage : float
        λ, 30 to 250, [%].

    Returns
    -------
    Steps
        A_basic, [m/s²] over [m/s].

    Raises
    ------
    RailgripError
        ``braked_weight: is outside the conversion; got 20 %; allowed: 30 to 250 %``

    Notes
    -----
    The first step holds up to V_lim = 16.85 λ^0.428 km/h, raised to the next 0.1 km/h; above it
    each range has its polynomial.

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, A.3.7.

    Checked by tests/reference/etcs_era_tool.

    Examples
    --------
    >>> steps = deceleration_of(100.0)
    >>> [round(3.6 * begin, 1) for begin in steps.begins], [round(a, 4) for a in steps.values]
    ([0.0, 121.0, 150.0, 180.0], [0.826, 0.6171, 0.5915, 0.5817])
    """
    if not LEAST <= percentage <= GREATEST:
        raise RailgripError(
            Problem(
                "braked_weight",
                "is outside the conversion",
                got=f"{percentage:g} %",
                allowed=f"{LEAST:g} to {GREATEST:g} %",
            )
        )
    begin = math.ceil(10.0 * 16.85 * percentage**0.428 - 1e-9) / 10.0
    begins, values = [0.0], [0.0075 * percentage + 0.076]
    for end, (c0, c1, c2, c3) in _RANGES:
        if begin < end:
            begins.append(begin / 3.6)
            values.append(c0 + percentage * (c1 + percentage * (c2 + percentage * c3)))
            begin = end
    return Steps(tuple(begins), tuple(values))


def service_deceleration_of(percentage: float, as_era_tool: bool = False) -> Steps:
    """Return the basic deceleration of the service brake over the speed.

    Parameters
    ----------
    percentage : float
        λ, 30 to 250, [%]; it counts for 135 at most.
    as_era_tool : bool
        Whether above 180 km/h the percentage counts in full, as in ERA's tool v3.0.

    Returns
    -------
    Steps
        [m/s²] over [m/s].

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, A.3.7.

    Checked by tests/reference/etcs_era_tool.

    Examples
    --------
    >>> [round(service_deceleration_of(200.0, tool).at(51.0), 4) for tool in (False, True)]
    [0.7772, 1.1601]
    """
    steps = deceleration_of(min(percentage, SERVICE_CAP))
    if not as_era_tool:
        return steps
    return Steps(steps.begins, (*steps.values[:-1], deceleration_of(percentage).values[-1]))


def build_up_times(position: str, length: float, target_speed: float) -> tuple[float, float]:
    """Return the equivalent build-up times of emergency and service brake.

    Parameters
    ----------
    position : str
        One of `POSITIONS`.
    length : float
        Of the train, > 0, up to 900 m (passenger) or 1500 m, [m].
    target_speed : float
        ≥ 0, [m/s]; to a speed above zero the brake counts later.

    Returns
    -------
    (float, float)
        T_brake_emergency, T_brake_service, [s].

    Raises
    ------
    RailgripError
        ``length: is outside the conversion; got 1000 m; allowed: up to 900 m for passenger P``

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, A.3.8 and A.3.9. Freight in P beyond 900 m: −0.5 s; the copy of
       v3.4.0 in ERTMSFormalSpecs has −0.4 s.

    Checked by tests/reference/etcs_era_tool.

    Examples
    --------
    >>> [round(time, 2) for time in build_up_times("freight P", 700.0, 0.0)]
    [10.63, 22.39]
    """
    if position not in POSITIONS:
        raise RailgripError(unknown_name("position", "brake position", position, POSITIONS))
    if not 0.0 < length <= LONGEST[position]:
        raise RailgripError(
            Problem(
                "length",
                "is outside the conversion",
                got=f"{length:g} m",
                allowed=f"up to {LONGEST[position]:g} m for {position}",
            )
        )
    later = _TO_A_SPEED[position] if target_speed > 0.0 else 1.0
    emergency, service = (
        later * _time(table[position], length) for table in (_EMERGENCY, _SERVICE)
    )
    return emergency, service


def _time(rows: tuple[tuple[float, float, float, float], ...], length: float) -> float:
    a, b, c, least = rows[1] if len(rows) > 1 and length > 900.0 else rows[0]
    hundreds = max(length, least) / 100.0
    return a + b * hundreds + c * hundreds**2
