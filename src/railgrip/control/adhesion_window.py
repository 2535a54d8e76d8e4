"""Force of the rail on an axle, out of what is applied to it and how its speed changes (f8)."""

from __future__ import annotations

from railgrip.control.axle_forces import applied_force
from railgrip.control.contract import FloatArray
from railgrip.control.conventional_state import SPEED
from railgrip.control.state_layout import GROUP, group_base, groups
from railgrip.control.temperature_state import (
    FORCE_BEFORE,
    FRICTION,
    IMPULSE,
    IMPULSES,
    MASS,
    N_WINDOW,
    SPEEDS,
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
    F = (∫F* dt − m_r Δw)/Δt, and μ* M g = |F|. Speeds come one period late, so the forces of one
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
        # one loop for each step: places that depend on the sample keep larger ones from packing
        for i in range(GROUP):
            base = group_base(group) + i
            state[base + IMPULSE] += state[base + FORCE_BEFORE] * dt
            state[base + FORCE_BEFORE] = applied_force(state, base)
        for i in range(GROUP):
            base = group_base(group) + i
            state[base + SPEEDS + now] = state[base + SPEED]
            state[base + IMPULSES + now] = state[base + IMPULSE]
        for i in range(GROUP):
            base = group_base(group) + i
            gained = state[base + MASS] * (state[base + SPEED] - state[base + SPEEDS + then])
            given = state[base + IMPULSE] - state[base + IMPULSES + then]
            observed = (given - gained) * per_time
            state[base + FRICTION] = choose(length > 0, observed, state[base + FORCE_BEFORE])
