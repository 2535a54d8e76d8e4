"""Braking curve and coasting-initiation curves (ALK) before a target, from the same data."""

from __future__ import annotations

import math


def braking_speed(distance: float, target_speed: float, deceleration: float) -> float:
    """Return the speed of the braking curve before a target.

    Parameters
    ----------
    distance : float
        To the target, z; behind the target the curve goes on at its speed, [m].
    target_speed : float
        v_z, ≥ 0, [m/s].
    deceleration : float
        b, > 0, [m/s²].

    Returns
    -------
    float
        v_B, [m/s].

    Notes
    -----
    ``v_B = √(v_z² + 2 b z)``. With b_ALK < b for b it is the parabolic ALK (figure 1).

    References
    ----------
    .. [1] H. Übel, ES 100 730 (priority DE 26 31 540.2, 1976), figure 1.

    Examples
    --------
    >>> braking_speed(800.0, 0.0, 1.0)
    40.0
    """
    return math.sqrt(target_speed * target_speed + 2.0 * deceleration * max(distance, 0.0))


def straight_speed(
    distance: float, target_speed: float, distance_gain: float, speed_gain: float = 1.0
) -> float:
    """Return the speed of a straight coasting-initiation curve.

    Parameters
    ----------
    distance : float
        To the target, z, [m].
    target_speed : float
        v_z, ≥ 0, [m/s].
    distance_gain, speed_gain : float
        k1 > 0, [1/s]; k2 ≥ 1.

    Returns
    -------
    float
        v_ALK before it is held below the braking curve, [m/s].

    Notes
    -----
    ``v_ALK = k1 z + k2 v_z``; in the source's circuit k1 and k2 are ratios of resistors.

    References
    ----------
    .. [1] H. Übel, ES 100 730, figures 2 and 3, claim 4.

    Examples
    --------
    >>> straight_speed(1000.0, 10.0, 0.015)
    25.0
    """
    return distance_gain * max(distance, 0.0) + speed_gain * target_speed


def raised_speed(speed: float, knee_speed: float, lift: float) -> float:
    """Return a coasting-initiation curve's speed, raised at its high-speed end.

    Parameters
    ----------
    speed : float
        v_ALK, ≥ 0, [m/s].
    knee_speed : float
        Where raising begins, v_knee, [m/s].
    lift : float
        k_h ≥ 0; at the speed v the curve is k_h (v − v_knee) higher.

    Returns
    -------
    float
        [m/s].

    References
    ----------
    .. [1] H. Übel, ES 100 730, claim 3 (for flat braking curves; the law is ours).

    Examples
    --------
    >>> raised_speed(30.0, 20.0, 0.5), raised_speed(15.0, 20.0, 0.5)
    (35.0, 15.0)
    """
    return speed + lift * max(speed - knee_speed, 0.0)
