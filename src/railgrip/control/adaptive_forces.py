"""What each axle reaches: F0 at breakaway, mean force FB, slid distance sRB, and their sums.

Any signal proportional to the brake force will do. The cylinder pressure is one; at breakaway it
runs ahead of the rail's force, because a part of it only slows the wheel. That part is known from
the wheel's deceleration and the ordinary WSP's own estimate of what a Pascal brakes, so the rail's
force is the better signal, most of all in a cylinder that is still filling.
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
    RAIL_FORCE,
    RESTART_AFTER,
    RULE,
    SIGNAL,
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
from railgrip.control.axle_protection import freed_place
from railgrip.control.contract import MICRO, FloatArray
from railgrip.control.conventional_parameters import (
    ROTATING_SHARE,
    ConventionalParameters,
    conventional_of,
)
from railgrip.control.conventional_state import (
    ACCELERATION,
    DECELERATION,
    IS_BRAKED,
    IS_FAULTY,
    IS_MOTORED,
    PRESSURE_GAIN,
    REFERENCE,
    SAFETY_FILL,
    SETTLED_CLOCK,
    SPEED,
)
from railgrip.control.slip_band import threshold
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups, in_group
from railgrip.control.train_observer import braking_pressure
from railgrip.core.formulas.choosing import choose

RELEASED_AFTER: Final = 1.0  # s without brake and without gain of speed: released or cut out


class Weighing(NamedTuple):
    """What is the same for all axles when their forces are weighed, read once.

    Parameters
    ----------
    inertia : float
        Pressure that slows a wheel by 1 m/s², [Pa s²/m]; 0 where the signal is the pressure.
    breaking, adhering : float
        Slip speed at breakaway and the one below which an axle adheres again, [m/s].
    growth : float
        Rate of the slip speed at breakaway, [m/s²].
    restart : float
        Time in a range before its mean begins, [s].
    force_blend, mean_blend : float
        Shares of the filters.
    """

    inertia: float
    breaking: float
    adhering: float
    growth: float
    restart: float
    force_blend: float
    mean_blend: float


def weighing(parameters: FloatArray, state: FloatArray, dt: float) -> Weighing:
    """Return what is the same for all axles."""
    inertia = 0.0
    if parameters[SIGNAL] == RAIL_FORCE:
        inertia = parameters[ROTATING_SHARE] / state[PRESSURE_GAIN]
    breaking = threshold(parameters[BREAKAWAY_SLIP], parameters[BREAKAWAY_FLOOR], state[REFERENCE])
    return Weighing(
        inertia=inertia,
        breaking=breaking,
        adhering=parameters[ADHESION_SHARE] * breaking,
        growth=parameters[BREAKAWAY_GROWTH],
        restart=parameters[RESTART_AFTER],
        force_blend=dt / (parameters[F0_FILTER] + dt),
        mean_blend=dt / (parameters[MEAN_TIME] + dt),
    )


def weigh_axles(parameters: FloatArray, state: FloatArray, n_axles: int, dt: float) -> None:
    """Update F0, FB and slid distance of every axle and the sums over both ranges.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    n_axles : int
        Number of axles.
    dt : float
        Time since the last call, [s].

    Notes
    -----
    Only axles count that brake, whose sensor is believed, that have broken away once, and that have
    been in their range for `restart_after`.
    """
    own = conventional_of(parameters)
    same = weighing(parameters, state, dt)
    reference = state[REFERENCE]
    deceleration = state[DECELERATION]
    freed = freed_place(state)
    for group in range(groups(n_axles)):
        for i in range(GROUP):
            base = group_base(group) + i
            _weigh(own, same, state, base, reference, deceleration, base == freed, dt)
    find_leads(parameters, state, n_axles)
    sum_up(parameters, state, n_axles)


def _weigh(
    parameters: ConventionalParameters,
    same: Weighing,
    state: FloatArray,
    base: int,
    reference: float,
    deceleration: float,
    is_freed: bool,
    dt: float,
) -> None:
    """Update one axle: without branches, for packed arithmetic."""
    brakes = has_brake(state, base)
    works = brakes & (not is_freed)
    slip_speed = reference - state[base + SPEED]
    acceleration = state[base + ACCELERATION]
    pressure = braking_pressure(parameters, state, base)
    signal = (pressure + same.inertia * acceleration) * state[base + FACTOR]
    force = state[base + FORCE] + same.force_blend * (signal - state[base + FORCE])
    is_armed = state[base + IS_ARMED]
    adheres = slip_speed < same.adhering
    grows = acceleration + deceleration < -same.growth
    breaks = (is_armed > 0.0) & (slip_speed > same.breaking) & grows & (not adheres)
    armed = choose(adheres, 1.0, choose(breaks, 0.0, is_armed))
    clock = choose(works, state[base + RANGE_CLOCK] + dt, 0.0)
    is_new = clock <= same.restart
    mean = state[base + MEAN] + same.mean_blend * (signal - state[base + MEAN])
    mean = choose(works, choose(is_new, force, mean), state[base + MEAN])
    slid = choose(is_new, 0.0, state[base + SLID] + abs(slip_speed) * dt)
    slid = choose(works, slid, state[base + SLID])
    f0 = choose(works & breaks, max(force, 0.0), state[base + F0])
    state[base + FORCE] = choose(works, force, state[base + FORCE])
    state[base + F0] = f0
    state[base + IS_ARMED] = choose(works, armed, is_armed)
    state[base + RANGE_CLOCK] = clock
    state[base + MEAN] = mean
    state[base + SLID] = slid
    count_in(state, base, works, is_new)
    state[base + TELLS] = choose(brakes, 1.0, 0.0)


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


def find_leads(parameters: FloatArray, state: FloatArray, n_axles: int) -> None:
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


def sum_up(parameters: FloatArray, state: FloatArray, n_axles: int) -> None:
    """Count the axles in either range; sum up what they reach, where the rule asks for it."""
    n_macro = 0
    n_micro = 0
    for group in range(groups(n_axles)):
        for i in range(in_group(group, n_axles)):
            base = group_base(group) + i
            n_macro += state[base + IN_MACRO] > 0.0
            n_micro += state[base + IN_MICRO] > 0.0
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


def has_brake(state: FloatArray, base: int) -> bool:
    """Return whether an axle brakes and its speed is believed: not faulty, released or cut out."""
    is_equipped = state[base + IS_BRAKED] + state[base + IS_MOTORED] > 0.0
    is_believed = state[base + IS_FAULTY] == 0.0
    is_trusted = state[base + SAFETY_FILL] == 0.0
    is_at_work = state[base + SETTLED_CLOCK] <= RELEASED_AFTER
    return bool(is_equipped & is_believed & is_trusted & is_at_work)
