"""Force of the rail on an axle by a steady-state Kalman filter: beside the window of f8.

The model: m dw/dt = F_applied − F, with F a random walk in its rate. The wheel speed is measured
with noise. That is target tracking with a known input, whose steady gains Kalata found in closed
form; so no Riccati equation is solved while the train runs, and the gains follow the noise of the
speed signal, which grows with the speed.
"""

from __future__ import annotations

import math


def kalata_gains(tracking_index: float) -> tuple[float, float]:
    """Return the steady-state gains α and β of a tracking filter (Kalata 1984).

    Parameters
    ----------
    tracking_index : float
        σ_a T²/σ_v, what the process does in a period over what the measurement errs, > 0.

    Returns
    -------
    tuple of float
        α, share of the error that corrects the first state, β, of the second (over T).

    Notes
    -----
    r = (4 + Λ − √(8Λ + Λ²))/4, α = 1 − r², β = 2(2 − α) − 4√(1 − α).

    References
    ----------
    .. [1] P. R. Kalata, The tracking index: a generalized parameter for α-β and α-β-γ target
       trackers, IEEE Trans. Aerospace and Electronic Systems 20(2), 1984, 174-182.

    Checked by tests/reference/kalata_gains: the algebraic Riccati equation, 1e-8.

    Examples
    --------
    >>> tuple(round(gain, 4) for gain in kalata_gains(0.1))
    (0.36, 0.08)
    """
    root = math.sqrt(8.0 * tracking_index + tracking_index * tracking_index)
    r = 0.25 * (4.0 + tracking_index - root)
    return 1.0 - r * r, 2.0 * (1.0 + r * r) - 4.0 * r


def observe_by_kalman(
    speed: float,
    believed_speed: float,
    believed_force: float,
    applied: float,
    mass: float,
    tracking_index: float,
    dt: float,
) -> tuple[float, float]:
    """Return wheel speed and force of the rail after one more measurement.

    Parameters
    ----------
    speed : float
        Of the wheel, measured, [m/s].
    believed_speed, believed_force : float
        What the last call returned, [m/s] and [N], driving positive.
    applied : float
        Mean sum of motor and brake forces at the tread over the period, driving positive, [N].
    mass : float
        Rotating mass at the tread, > 0, [kg].
    tracking_index : float
        See `kalata_gains`.
    dt : float
        Period, [s].

    Notes
    -----
    A force that rises at a steady rate is followed with a lag of (α/β − 1/2) periods.

    Examples
    --------
    A wheel that 8 kN drive and that keeps its speed is held by 8 kN:

    >>> believed = 10.0, 0.0
    >>> for _ in range(200):
    ...     believed = observe_by_kalman(10.0, *believed, 8e3, 1e3, 0.1, 0.01)
    >>> round(believed[1])
    8000
    """
    alpha, beta = kalata_gains(tracking_index)
    predicted = believed_speed + (applied - believed_force) / mass * dt
    error = speed - predicted
    force = believed_force - beta * error * mass / dt
    return predicted + alpha * error, force
