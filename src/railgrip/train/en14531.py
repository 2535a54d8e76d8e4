"""Stopping distance from mean forces and an equivalent response time (EN 14531-1).

The quick calculation on paper: every brake counts with its mean force and with the time after
which it may be taken as fully applied at once. Use it to check a simulated stop, or where a few
mean values are all that is known. Where wheels slide, where friction depends strongly on speed
and temperature, or where the line has gradients, simulate the stop instead.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from railgrip.core.errors import Problem, RailgripError


class Stop(NamedTuple):
    """A stop by mean values."""

    distance: float
    """Stopping distance from the brake command, m."""
    response_time: float
    """Equivalent response time of the whole train, s."""
    deceleration: float
    """Mean deceleration once the brake is fully applied, m/s²."""


def mean_resistance(
    speed: float, *, constant: float, linear: float, quadratic: float, final_speed: float = 0.0
) -> float:
    """Return the running resistance averaged over the distance of an even deceleration.

    Parameters
    ----------
    speed, final_speed : float
        Speed at the beginning and at the end, m/s; ``speed > final_speed >= 0``.
    constant, linear, quadratic : float
        Coefficients of ``constant + linear v + quadratic v²``, N, N s/m, N s²/m².

    Returns
    -------
    resistance : float
        Mean resistance against the motion, N.

    Notes
    -----
    At constant deceleration equal distances mean equal steps of v², so that the means of v and v²
    over the distance are 2/3 (v0² + v0 v1 + v1²)/(v0 + v1) and (v0² + v1²)/2.

    References
    ----------
    .. [1] EN 14531-1:2015, simplified example (annex D), mean external retarding force.

    Examples
    --------
    >>> round(mean_resistance(100 / 3.6, constant=3000.0, linear=110.0, quadratic=7.0), 1)
    7737.7
    """
    mean_speed = 2 / 3 * (speed**2 + speed * final_speed + final_speed**2) / (speed + final_speed)
    mean_square = 0.5 * (speed**2 + final_speed**2)
    return constant + linear * mean_speed + quadratic * mean_square


def stopping_distance(
    speed: float,
    brake_forces: Sequence[float],
    response_times: Sequence[float],
    *,
    dynamic_mass: float,
    external_force: float = 0.0,
    final_speed: float = 0.0,
) -> Stop:
    """Return the stop of a train whose brakes are known by mean force and response time.

    Parameters
    ----------
    speed : float
        Speed at the brake command, m/s, positive.
    brake_forces : sequence of float
        Mean braking force of each brake at the wheel tread, N, not negative.
    response_times : sequence of float
        Equivalent response time of each brake, s: dead time plus half the rise time.
    dynamic_mass : float
        Static plus rotating mass of the train, kg, positive.
    external_force : float
        Mean of the forces that brake without a command, N: resistance; a downgrade is negative.
    final_speed : float
        Speed at which the distance ends, m/s; 0 is a stop.

    Returns
    -------
    stop : Stop
        Distance m, equivalent response time s, mean deceleration m/s².

    Raises
    ------
    RailgripError
        ``the brakes do not hold the train; got a total force of -100 N; try: …``

    Notes
    -----
    ``t_e = Σ t_i F_i / (Σ F_i + F_ext)``, ``a_e = (Σ F_i + F_ext)/m_dyn``,
    ``s = v0 t_e + (v0² − v1²)/(2 a_e)``.

    Known wrong when the resistance is large: it is counted as if it began with the brakes.

    References
    ----------
    .. [1] EN 14531-1:2015, "Railway applications – Methods for calculation of stopping and
       slowing distances and immobilization braking – Part 1: General algorithms utilizing mean
       value calculation for train sets or single vehicles".

    Examples
    --------
    Twenty tonnes, one brake of 20 kN after 1 s, from 20 m/s:

    >>> stopping_distance(20.0, [20e3], [1.0], dynamic_mass=20e3).distance
    220.0
    """
    if len(brake_forces) != len(response_times):
        raise RailgripError(
            Problem(
                "response_times",
                "must have one value for each brake force",
                got=f"{len(response_times)} for {len(brake_forces)} forces",
            )
        )
    total = sum(brake_forces) + external_force
    if total <= 0.0:
        raise RailgripError(
            Problem(
                "",
                "the brakes do not hold the train",
                got=f"a total force of {total:g} N",
                cure="more braking force or a gentler gradient",
            )
        )
    weighted = sum(f * t for f, t in zip(brake_forces, response_times, strict=True))
    response_time = weighted / total
    deceleration = total / dynamic_mass
    distance = speed * response_time + (speed**2 - final_speed**2) / (2 * deceleration)
    return Stop(distance, response_time, deceleration)
