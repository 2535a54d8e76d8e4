"""Force of the rail on an axle, out of what is applied to it and how its speed changes (f8)."""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.temperature_state import (
    FORCE_BEFORE,
    FRICTION,
    IMPULSE,
    IMPULSES,
    MASS,
    N_WINDOW,
    SPEEDS,
)


def observe_friction(
    state: FloatArray, own: int, sample: int, length: int, speed: float, applied: float,
    dt: float, per_time: float,
) -> None:  # fmt: skip
    """Update the observed force of one axle in the state.

    Parameters
    ----------
    state : ndarray
        As in the controller contract.
    own : int
        Where the axle's own block begins.
    sample : int
        Number of this sample since the controller began.
    length : int
        Samples in the window, below `N_WINDOW` and not more than there have been before.
    speed : float
        Of the wheel, [m/s].
    applied : float
        Sum of brake and motor forces at the tread now, driving positive, [N].
    dt, per_time : float
        Period [s]; one over the length of the window, [1/s].

    Notes
    -----
    Momentum over the window: m_r Δw = ∫F* dt − ∫F dt, so the mean force of the rail is
    F = (∫F* dt − m_r Δw)/Δt, and μ* M g = |F|. Speeds come one period late, so the forces of one
    period ago are put beside them. It lags by half the window and that period.
    """
    state[own + IMPULSE] += state[own + FORCE_BEFORE] * dt
    state[own + FORCE_BEFORE] = applied
    now = sample & (N_WINDOW - 1)
    state[own + SPEEDS + now] = speed
    state[own + IMPULSES + now] = state[own + IMPULSE]
    if length < 1:
        state[own + FRICTION] = applied
        return
    then = (sample - length) & (N_WINDOW - 1)
    gained = state[own + MASS] * (speed - state[own + SPEEDS + then])
    given = state[own + IMPULSE] - state[own + IMPULSES + then]
    state[own + FRICTION] = (given - gained) * per_time
