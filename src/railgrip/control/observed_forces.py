"""What each axle reaches, by observed forces of the rail: F0, mean force, slid distance.

`adaptive_forces` reckons the same from cylinder pressures. Here the controller observes the force
itself, driving or braking, so that one function serves both.
"""

from __future__ import annotations

from railgrip.control.adaptive_parameters import (
    ADHESION_SHARE,
    BREAKAWAY_FLOOR,
    BREAKAWAY_GROWTH,
    BREAKAWAY_SLIP,
    F0_FILTER,
    LEAD_AXLES,
    MEAN_TIME,
    RESTART_AFTER,
)
from railgrip.control.adaptive_state import (
    F0,
    FACTOR,
    FOLLOWER_FORCE,
    FORCE,
    IS_ARMED,
    IS_LEAD,
    LEADER_FORCE,
    LEADER_SLID,
    MACRO_F0,
    MACRO_FORCE,
    MACRO_SLID,
    MEAN,
    MICRO_FORCE,
    N_MACRO,
    N_MICRO,
    RANGE,
    RANGE_CLOCK,
    SLID,
)
from railgrip.control.contract import MICRO, FloatArray
from railgrip.control.slip_band import threshold
from railgrip.control.state_layout import axle_base

SETTLED = 0.3
"""So long an axle must have been observed before its force counts as F0, s."""


def clear_sums(state: FloatArray) -> None:
    """Set the sums over both ranges to zero."""
    for place in (
        N_MACRO, N_MICRO, MACRO_FORCE, MICRO_FORCE, MACRO_F0, MACRO_SLID,
        LEADER_FORCE, FOLLOWER_FORCE, LEADER_SLID,
    ):  # fmt: skip
        state[place] = 0.0


def leave_out(state: FloatArray, axle: int) -> None:
    """Let an axle tell nothing: without brake or motor, not believed, or let run free."""
    state[axle_base(axle) + RANGE_CLOCK] = 0.0
    state[axle_base(axle) + IS_LEAD] = 0.0


def weigh_axle(
    parameters: FloatArray, state: FloatArray, axle: int, n_lead: float,
    force: float, slip_speed: float, growth: float, reference: float, dt: float,
) -> float:  # fmt: skip
    """Update F0, mean and slid distance of one axle, and add them to the sums of its range.

    Parameters
    ----------
    parameters : ndarray
        Those of `Supervision` at the places that `adaptive_parameters` has for them.
    state : ndarray
        Begins so that the places of `adaptive_state` hold in it.
    axle : int
        Row of the axle.
    n_lead : float
        Leading test axles before it.
    force : float
        Observed force of the rail in the sense of the demand, [N].
    slip_speed : float
        In the same sense, ≥ 0 while it slides, [m/s].
    growth : float
        Rate of the slip speed, [m/s²].
    reference : float
        Reference speed, [m/s].
    dt : float
        Time since the last call, [s].

    Returns
    -------
    float
        Leading test axles, this one included.
    """
    base = axle_base(axle)
    breaking = threshold(parameters[BREAKAWAY_SLIP], parameters[BREAKAWAY_FLOOR], reference)
    is_lead = n_lead < parameters[LEAD_AXLES]
    state[base + IS_LEAD] = 1.0 if is_lead else 0.0
    signal = force * state[base + FACTOR]
    blend = dt / (parameters[F0_FILTER] + dt)
    state[base + FORCE] += blend * (signal - state[base + FORCE])
    if slip_speed < parameters[ADHESION_SHARE] * breaking:
        state[base + IS_ARMED] = 1.0
    elif (
        slip_speed > breaking
        and growth > parameters[BREAKAWAY_GROWTH]
        and state[base + RANGE_CLOCK] > SETTLED
    ):
        if state[base + IS_ARMED] > 0.0:
            state[base + F0] = max(state[base + FORCE], 0.0)
        state[base + IS_ARMED] = 0.0
    state[base + RANGE_CLOCK] += dt
    if state[base + RANGE_CLOCK] <= parameters[RESTART_AFTER]:
        state[base + MEAN] = state[base + FORCE]
        state[base + SLID] = 0.0
    else:
        blend = dt / (parameters[MEAN_TIME] + dt)
        state[base + MEAN] += blend * (signal - state[base + MEAN])
        state[base + SLID] += abs(slip_speed) * dt
        _sum_up(parameters, state, axle, n_lead)
    return n_lead + 1.0 if is_lead else n_lead


def _sum_up(parameters: FloatArray, state: FloatArray, axle: int, n_lead: float) -> None:
    base = axle_base(axle)
    mean, f0 = state[base + MEAN], state[base + F0]
    if state[base + IS_LEAD] > 0.0:
        if n_lead == 0.0:
            state[LEADER_FORCE] = mean
            state[LEADER_SLID] = state[base + SLID]
        if n_lead + 1.0 == parameters[LEAD_AXLES]:
            state[FOLLOWER_FORCE] = mean
    if f0 <= 0.0:
        return
    if state[base + RANGE] > MICRO:
        state[N_MACRO] += 1.0
        state[MACRO_FORCE] += mean
        state[MACRO_F0] += f0
        state[MACRO_SLID] += state[base + SLID]
    else:
        state[N_MICRO] += 1.0
        state[MICRO_FORCE] += mean
