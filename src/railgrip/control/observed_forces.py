"""What each axle reaches, by observed forces of the rail: F0, mean force, slid distance.

`adaptive_forces` reckons the same from cylinder pressures. Here the controller observes the force
itself, driving or braking, so that one function serves both.
"""

from __future__ import annotations

from typing import NamedTuple

from railgrip.control.adaptive_forces import count_in, find_leads, sum_up
from railgrip.control.adaptive_parameters import (
    ADHESION_SHARE,
    BREAKAWAY_FLOOR,
    BREAKAWAY_GROWTH,
    BREAKAWAY_SLIP,
    F0_FILTER,
    MEAN_TIME,
    RESTART_AFTER,
)
from railgrip.control.adaptive_state import (
    F0,
    FACTOR,
    FORCE,
    IS_ARMED,
    IS_LEAD,
    MEAN,
    RANGE_CLOCK,
    SLID,
)
from railgrip.control.contract import FloatArray
from railgrip.control.slip_band import threshold
from railgrip.control.state_layout import axle_base
from railgrip.core.formulas.choosing import choose

SETTLED = 0.3
"""So long an axle must have been observed before its force counts as F0, s."""


class Observing(NamedTuple):
    """What is the same for all axles when their observed forces are weighed, read once.

    Parameters
    ----------
    breaking, adhering : float
        Slip speed at breakaway and the one below which an axle adheres again, [m/s].
    growth : float
        Rate of the slip speed at breakaway, [m/s²].
    restart : float
        Time in a range before its mean begins, [s].
    force_blend, mean_blend : float
        Shares of the filters.
    """

    breaking: float
    adhering: float
    growth: float
    restart: float
    force_blend: float
    mean_blend: float


def observing(parameters: FloatArray, reference: float, dt: float) -> Observing:
    """Return what is the same for all axles.

    Parameters
    ----------
    parameters : ndarray
        Those of `Supervision` at the places that `adaptive_parameters` has for them.
    reference : float
        Reference speed, [m/s].
    dt : float
        Time since the last call, [s].
    """
    breaking = threshold(parameters[BREAKAWAY_SLIP], parameters[BREAKAWAY_FLOOR], reference)
    return Observing(
        breaking=breaking,
        adhering=parameters[ADHESION_SHARE] * breaking,
        growth=parameters[BREAKAWAY_GROWTH],
        restart=parameters[RESTART_AFTER],
        force_blend=dt / (parameters[F0_FILTER] + dt),
        mean_blend=dt / (parameters[MEAN_TIME] + dt),
    )


def leave_out(state: FloatArray, axle: int) -> None:
    """Let an axle tell nothing, as one does that is not driven."""
    state[axle_base(axle) + RANGE_CLOCK] = 0.0
    state[axle_base(axle) + IS_LEAD] = 0.0


def weigh_axle(
    same: Observing, state: FloatArray, base: int, works: bool,
    force: float, slip_speed: float, growth: float, dt: float,
) -> None:  # fmt: skip
    """Update F0, mean and slid distance of one axle: without branches, for packed arithmetic.

    Parameters
    ----------
    same : Observing
        What is the same for all axles.
    state : ndarray
        As in the controller contract.
    base : int
        Where the axle's values begin.
    works : bool
        Whether the axle tells anything: brakes or pulls, is believed, and is not let run free.
    force : float
        Observed force of the rail in the sense of the demand, [N].
    slip_speed : float
        In the same sense, ≥ 0 while it slides, [m/s].
    growth : float
        Rate of the slip speed, [m/s²].
    dt : float
        Time since the last call, [s].
    """
    signal = force * state[base + FACTOR]
    before = state[base + FORCE]
    smooth = before + same.force_blend * (signal - before)
    adheres = slip_speed < same.adhering
    is_settled = state[base + RANGE_CLOCK] > SETTLED
    grows = (slip_speed > same.breaking) & (growth > same.growth) & is_settled
    breaks = grows & (not adheres)
    is_armed = state[base + IS_ARMED]
    armed = choose(adheres, 1.0, choose(breaks, 0.0, is_armed))
    is_first = works & breaks & (is_armed > 0.0)
    clock = choose(works, state[base + RANGE_CLOCK] + dt, 0.0)
    is_new = clock <= same.restart
    mean = state[base + MEAN] + same.mean_blend * (signal - state[base + MEAN])
    slid = choose(is_new, 0.0, state[base + SLID] + abs(slip_speed) * dt)
    state[base + FORCE] = choose(works, smooth, before)
    state[base + F0] = choose(is_first, max(smooth, 0.0), state[base + F0])
    state[base + IS_ARMED] = choose(works, armed, is_armed)
    state[base + RANGE_CLOCK] = clock
    state[base + MEAN] = choose(works, choose(is_new, smooth, mean), state[base + MEAN])
    state[base + SLID] = choose(works, slid, state[base + SLID])
    count_in(state, base, works, is_new)


def add_up(parameters: FloatArray, state: FloatArray, n_axles: int) -> None:
    """Find the leading axles and sum up over both ranges, when all have been weighed."""
    find_leads(parameters, state, n_axles)
    sum_up(parameters, state, n_axles)
