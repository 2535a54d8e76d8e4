"""Force of the rail on an axle, out of what is applied to it and how its speed changes (f8)."""

from __future__ import annotations

from railgrip.control.axle_forces import applied_force
from railgrip.control.contract import FloatArray
from railgrip.control.conventional_state import IS_FAULTY, SPEED
from railgrip.control.side_by_side import move
from railgrip.control.state_layout import GROUP, group_base, groups
from railgrip.control.temperature_state import (
    COUNTED_FRICTION,
    COUNTED_LOAD,
    FORCE_BEFORE,
    FRICTION,
    IMPULSE,
    LOAD,
    MASS,
    MOMENTA,
    MOMENTUM,
    MOMENTUM_THEN,
    N_WINDOW,
)
from railgrip.core.formulas.choosing import choose


def observe_friction(
    state: FloatArray,
    n_axles: int,
    sample: int,
    window: int,
    dt: float,
) -> None:
    """Update the observed force of every axle in the state.

    Parameters
    ----------
    state : ndarray
        As in the controller contract; what is measured has been put into it.
    n_axles : int
        Number of axles.
    sample : int
        Number of this sample since the controller began.
    window : int
        Samples in the window, below `N_WINDOW`.
    dt : float
        Period, [s].

    Notes
    -----
    Momentum over the window: m_r Δw = ∫F* dt − ∫F dt, so the mean force of the rail is
    F = Δ(∫F* dt − m_r w)/Δt, and μ* M g = |F|. Speeds come one period late, so the forces of one
    period ago are put beside them. It lags by half the window and that period.
    """
    length = min(window, sample)
    per_time = 1.0 / (max(length, 1) * dt)
    # no more samples than the window reaches back to, since each in use wants its room in the cache
    kept = 1
    while kept <= window:
        kept = 2 * kept
    now = (sample & (kept - 1) & (N_WINDOW - 1)) * GROUP
    then = ((sample - length) & (kept - 1) & (N_WINDOW - 1)) * GROUP
    for group in range(groups(n_axles)):
        first = group_base(group)
        move(state, first + MOMENTUM_THEN, first + MOMENTA + then)
        for i in range(GROUP):
            base = first + i
            impulse = state[base + IMPULSE] + state[base + FORCE_BEFORE] * dt
            momentum = impulse - state[base + MASS] * state[base + SPEED]
            applied = applied_force(state, base)
            observed = (momentum - state[base + MOMENTUM_THEN]) * per_time
            friction = choose(length > 0, observed, applied)
            is_valid = state[base + IS_FAULTY] == 0.0
            state[base + IMPULSE] = impulse
            state[base + MOMENTUM] = momentum
            state[base + FORCE_BEFORE] = applied
            state[base + FRICTION] = friction
            state[base + COUNTED_FRICTION] = choose(is_valid, friction, 0.0)
            state[base + COUNTED_LOAD] = choose(is_valid, state[base + LOAD], 0.0)
        move(state, first + MOMENTA + now, first + MOMENTUM)
