"""What an axle reaches: F0 at breakaway, mean force FB, slid distance sRB, and their sums.

Any signal proportional to the force will do: `adaptive_forces` takes the cylinder pressure, driving
and temperature control take the observed force of the rail.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control.adaptive_parameters import (
    ADHESION_SHARE,
    BREAKAWAY_FLOOR,
    BREAKAWAY_GROWTH,
    BREAKAWAY_SLIP,
    F0_FILTER,
    LEAD_AXLES,
    LOOKOUT,
    MEAN_TIME,
    RESTART_AFTER,
    RULE,
)
from railgrip.control.adaptive_state import (
    COUNTS,
    F0,
    FACTOR,
    FOLLOWER_FORCE,
    FORCE,
    IN_MACRO,
    IN_MICRO,
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
    TELLS,
)
from railgrip.control.contract import MICRO, FloatArray
from railgrip.control.side_by_side import count_equal
from railgrip.control.slip_band import threshold
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups
from railgrip.core.formulas.choosing import choose

OBSERVED_AFTER: Final = 0.3
"""So long an axle must have been observed before its force counts as F0, s."""
ALWAYS_SETTLED: Final = -1.0
"""A measured pressure needs no such time, s."""


class Weighing(NamedTuple):
    """What is the same for all axles when their forces are weighed, read once.

    Parameters
    ----------
    breaking, adhering : float
        Slip speed at breakaway and the one below which an axle adheres again, [m/s].
    growth : float
        Rate of the slip speed at breakaway, [m/s²].
    settled, restart : float
        Time in a range before a breakaway gives an F0, and before the mean begins, [s].
    force_blend, mean_blend : float
        Shares of the filters.
    """

    breaking: float
    adhering: float
    growth: float
    settled: float
    restart: float
    force_blend: float
    mean_blend: float


def weighing(parameters: FloatArray, reference: float, settled: float, dt: float) -> Weighing:
    """Return what is the same for all axles.

    Parameters
    ----------
    parameters : ndarray
        Those of `Supervision` at the places that `adaptive_parameters` has for them.
    reference : float
        Reference speed, [m/s].
    settled : float
        As in `Weighing`; negative where every breakaway gives an F0, [s].
    dt : float
        Time since the last call, [s].
    """
    breaking = threshold(parameters[BREAKAWAY_SLIP], parameters[BREAKAWAY_FLOOR], reference)
    return Weighing(
        breaking=breaking,
        adhering=parameters[ADHESION_SHARE] * breaking,
        growth=parameters[BREAKAWAY_GROWTH],
        settled=settled,
        restart=parameters[RESTART_AFTER],
        force_blend=dt / (parameters[F0_FILTER] + dt),
        mean_blend=dt / (parameters[MEAN_TIME] + dt),
    )


def leave_out(state: FloatArray, axle: int) -> None:
    """Let an axle tell nothing, as one does that is not driven."""
    state[axle_base(axle) + RANGE_CLOCK] = 0.0
    state[axle_base(axle) + IS_LEAD] = 0.0


def weigh_axle(
    same: Weighing, state: FloatArray, base: int, works: bool,
    force: float, slip_speed: float, growth: float, dt: float,
) -> None:  # fmt: skip
    """Update F0, mean and slid distance of one axle: without branches, for packed arithmetic.

    Parameters
    ----------
    same : Weighing
        What is the same for all axles.
    state : ndarray
        As in the controller contract.
    base : int
        Where the axle's values begin.
    works : bool
        Whether the axle tells anything: brakes or pulls, is believed, and is not let run free.
    force : float
        Brake or tractive force in the sense of the demand, in the unit of the signal.
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
    is_settled = state[base + RANGE_CLOCK] > same.settled
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
    _find_leads(parameters, state, n_axles)
    _sum_up(parameters, state, n_axles)


def count_in(state: FloatArray, base: int, works: bool, is_new: bool) -> None:
    """Note whether an axle tells anything, and in which range it counts; none leads as yet."""
    counts = works & (not is_new)
    is_broken_away = state[base + F0] > 0.0
    is_micro = state[base + RANGE] <= MICRO
    state[base + TELLS] = choose(works, 1.0, 0.0)
    state[base + IS_LEAD] = 0.0
    state[base + COUNTS] = choose(counts, 1.0, 0.0)
    state[base + IN_MACRO] = choose(counts & is_broken_away & (not is_micro), 1.0, 0.0)
    state[base + IN_MICRO] = choose(counts & is_broken_away & is_micro, 1.0, 0.0)


def _find_leads(parameters: FloatArray, state: FloatArray, n_axles: int) -> None:
    """Let the first axles that tell anything lead, and note what first and last of them say."""
    n_lead = 0.0
    leader_force = follower_force = leader_slid = 0.0
    for axle in range(n_axles):
        if n_lead >= parameters[LEAD_AXLES]:
            break
        base = axle_base(axle)
        if state[base + TELLS] > 0.0:
            n_lead += 1.0
            state[base + IS_LEAD] = 1.0
            counts = state[base + COUNTS] > 0.0
            if counts and n_lead == 1.0:
                leader_force = state[base + MEAN]
                leader_slid = state[base + SLID]
            if counts and n_lead == parameters[LEAD_AXLES]:
                follower_force = state[base + MEAN]
    state[LEADER_FORCE] = leader_force
    state[FOLLOWER_FORCE] = follower_force
    state[LEADER_SLID] = leader_slid


def _sum_up(parameters: FloatArray, state: FloatArray, n_axles: int) -> None:
    """Count the axles in either range; sum up what they reach, where the rule asks for it."""
    n_macro = 0
    n_micro = 0
    for group in range(groups(n_axles)):
        n_macro += count_equal(state, group_base(group) + IN_MACRO, 1.0)
        n_micro += count_equal(state, group_base(group) + IN_MICRO, 1.0)
    state[N_MACRO] = n_macro
    state[N_MICRO] = n_micro
    if parameters[RULE] != LOOKOUT:
        _sum_up_forces(state, n_axles)


def _sum_up_forces(state: FloatArray, n_axles: int) -> None:
    """Sum up over the axles that count in either range, in the order of the axles."""
    macro_force = micro_force = macro_f0 = macro_slid = 0.0
    for group in range(groups(n_axles)):
        for i in range(GROUP):
            base = group_base(group) + i
            in_macro = state[base + IN_MACRO]
            macro_force += in_macro * state[base + MEAN]
            macro_f0 += in_macro * state[base + F0]
            macro_slid += in_macro * state[base + SLID]
            micro_force += state[base + IN_MICRO] * state[base + MEAN]
    state[MACRO_FORCE] = macro_force
    state[MICRO_FORCE] = micro_force
    state[MACRO_F0] = macro_f0
    state[MACRO_SLID] = macro_slid
