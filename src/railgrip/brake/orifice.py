"""Air through an orifice between two volumes, and the calibration from filling and venting times.

The flow is normalised: it is a pressure, and times a rate constant [1/s] it is the rate of the
pressure in the volume that is filled or vented. The rate constant holds the orifice's area, the
volume and the state of the air; it comes from a time that somebody measured.
"""

import math
from collections.abc import Callable
from itertools import pairwise

from railgrip.core.constants import ATMOSPHERE
from railgrip.core.errors import Problem, RailgripError

_LINEAR_BELOW = 0.25e5
_INTERVALS = 200


def orifice_flow(pressure_from: float, pressure_to: float) -> float:
    """Normalised flow through an orifice, positive from the first volume to the second.

    Choose it for filling, venting and leaks of brake cylinders and reservoirs.

    Parameters
    ----------
    pressure_from, pressure_to : float
        Gauge pressures, ≥ 0 [Pa].

    Returns
    -------
    float
        Flow as a pressure [Pa]; negative when the second pressure is the higher one.

    Notes
    -----
    With absolute pressures, r = p_low/p_high: p_high · ψ(r), ψ = 1 up to r = ½ (sonic), then
    2 √(r (1 − r)). Below a difference of 0.25 bar the flow is proportional to the difference, with
    the value of the formula at 0.25 bar, so that equal pressures are approached without chatter.
    Isothermal, both sides at the ambient temperature.
    Known wrong when a long pipe, not an orifice, limits the flow.

    References
    ----------
    .. [1] The ellipse of ISO 6358 with the critical ratio b = ½.

    Checked by tests/reference/orifice_times, 1e-6.

    Examples
    --------
    >>> orifice_flow(7.0e5, 0.0)
    800000.0
    >>> round(orifice_flow(3.8e5, 3.6e5))
    170646
    """
    difference = pressure_from - pressure_to
    high = max(pressure_from, pressure_to) + ATMOSPHERE
    low = high - max(abs(difference), _LINEAR_BELOW)
    throat = max(low, 0.5 * high)
    greatest = 2.0 * math.sqrt(throat * (high - throat))
    return greatest * max(-1.0, min(1.0, difference * (1.0 / _LINEAR_BELOW)))


def orifice_time(
    pressure_start: float, pressure_end: float, other: float, rate_constant: float
) -> float:
    """Time in which a volume goes from one pressure to another through an orifice.

    Parameters
    ----------
    pressure_start, pressure_end : float
        Gauge pressures in the volume [Pa].
    other : float
        Constant gauge pressure on the other side of the orifice [Pa]; 0 is the atmosphere.
    rate_constant : float
        Rate of the pressure per flow, > 0 [1/s].

    Returns
    -------
    float
        Time, ≥ 0 [s].

    Raises
    ------
    RailgripError
        "the pressure never gets there" when the end does not lie between the start and the other
        pressure; "the rate constant must be positive".

    Notes
    -----
    ∫ dp/(k · flow), by Simpson's rule in ln|other − p|, split where the flow is sonic and where it
    becomes linear.

    Examples
    --------
    >>> round(orifice_time(3.8e5, 1.0e5, 0.0, 1.0), 6)  # sonic: ln(4.8/2.0)
    0.875469
    """
    if not rate_constant > 0.0:
        raise RailgripError(
            Problem("", "the rate constant must be positive", got=f"{rate_constant} 1/s")
        )
    _refuse_unreachable(pressure_start, pressure_end, other)
    far, near = abs(other - pressure_start), abs(other - pressure_end)
    absolute = other + ATMOSPHERE
    sonic = absolute if pressure_start > other else 0.5 * absolute
    kinks = [kink for kink in (sonic, _LINEAR_BELOW) if near < kink < far]
    borders = sorted([near, *kinks, far])
    sign = 1.0 if pressure_start > other else -1.0

    def seconds_per_log_gap(log_gap: float) -> float:
        gap = math.exp(log_gap)
        return gap / abs(orifice_flow(other + sign * gap, other))

    pieces = [
        _simpson(seconds_per_log_gap, math.log(left), math.log(right))
        for left, right in pairwise(borders)
    ]
    return sum(pieces) / rate_constant


def rate_constant_vent(pressure_start: float, pressure_end: float, time: float) -> float:
    """Rate constant with which a volume vents to the atmosphere in a given time.

    Parameters
    ----------
    pressure_start, pressure_end : float
        Gauge pressures, start > end > 0 [Pa].
    time : float
        Time between them, > 0 [s].

    Returns
    -------
    float
        Rate constant [1/s].

    Raises
    ------
    RailgripError
        "the time must be positive", and the sentences of `orifice_time`.

    Examples
    --------
    >>> round(rate_constant_vent(3.8e5, 0.4e5, 0.7), 4)
    1.7757
    """
    return orifice_time(pressure_start, pressure_end, 0.0, 1.0) / _positive(time)


def rate_constant_fill(
    pressure_start: float, pressure_end: float, supply: float, time: float
) -> float:
    """Rate constant with which a volume fills from a constant supply in a given time.

    Parameters
    ----------
    pressure_start, pressure_end : float
        Gauge pressures, start < end < supply [Pa].
    supply : float
        Gauge pressure of the supply [Pa].
    time : float
        Time between them, > 0 [s].

    Returns
    -------
    float
        Rate constant [1/s].

    Raises
    ------
    RailgripError
        "the time must be positive", and the sentences of `orifice_time`.

    Examples
    --------
    >>> round(rate_constant_fill(0.4e5, 3.6e5, 7.0e5, 1.0), 4)
    0.4003
    """
    return orifice_time(pressure_start, pressure_end, supply, 1.0) / _positive(time)


def _simpson(function: Callable[[float], float], left: float, right: float) -> float:
    width = (right - left) / _INTERVALS
    inner = sum((4.0 if k % 2 else 2.0) * function(left + k * width) for k in range(1, _INTERVALS))
    return (function(left) + inner + function(right)) * width / 3.0


def _positive(time: float) -> float:
    if not 0.0 < time < math.inf:
        raise RailgripError(Problem("", "the time must be positive", got=f"{time} s"))
    return time


def _refuse_unreachable(pressure_start: float, pressure_end: float, other: float) -> None:
    falls = pressure_start >= pressure_end > other
    rises = pressure_start <= pressure_end < other
    if not (falls or rises):
        raise RailgripError(
            Problem(
                "",
                "the pressure never gets there",
                got=f"from {pressure_start} Pa to {pressure_end} Pa against {other} Pa",
                allowed="the end lies between the start and the other side's pressure",
            )
        )
