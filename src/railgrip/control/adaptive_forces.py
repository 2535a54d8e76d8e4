"""What each axle reaches: F0 at breakaway, mean force FB, slid distance sRB, and their sums.

Any signal proportional to the brake force will do. The cylinder pressure is one; at breakaway it
runs ahead of the rail's force, because a part of it only slows the wheel. That part is known from
the wheel's deceleration and the ordinary WSP's own estimate of what a Pascal brakes, so the rail's
force is the better signal, most of all in a cylinder that is still filling.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.adaptive_parameters import (
    ADHESION_SHARE,
    BREAKAWAY_FLOOR,
    BREAKAWAY_GROWTH,
    BREAKAWAY_SLIP,
    F0_FILTER,
    LEAD_AXLES,
    MEAN_TIME,
    RAIL_FORCE,
    RESTART_AFTER,
    SIGNAL,
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
    RANGE_CLOCK,
    SLID,
    axle_place,
    system_place,
)
from railgrip.control.contract import BRAKED, MICRO, MOTORED, FloatArray
from railgrip.control.conventional_parameters import ROTATING_SHARE
from railgrip.control.conventional_state import (
    ACCELERATION,
    DECELERATION,
    FREED_AXLE,
    IS_FAULTY,
    PRESSURE_GAIN,
    REFERENCE,
    SAFETY_FILL,
    SETTLED_CLOCK,
    SPEED,
    axle_base,
)
from railgrip.control.slip_band import threshold
from railgrip.control.slip_ranges import range_place
from railgrip.control.train_observer import braking_pressure

RELEASED_AFTER: Final = 1.0  # s without brake and without gain of speed: released or cut out


def weigh_axles(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    dt: float,
) -> None:
    """Update F0, FB and slid distance of every axle and the sums over both ranges.

    Parameters
    ----------
    parameters, axle_setup, state, measured : ndarray
        As in the controller contract.
    dt : float
        Time since the last call, [s].

    Notes
    -----
    Only axles count that brake, whose sensor is believed, that have broken away once, and that have
    been in their range for `restart_after`.
    """
    n_axles = measured.shape[0]
    system = system_place(n_axles)
    mean_blend = dt / (parameters[MEAN_TIME] + dt)
    force_blend = dt / (parameters[F0_FILTER] + dt)
    inertia = 0.0
    if parameters[SIGNAL] == RAIL_FORCE:
        inertia = parameters[ROTATING_SHARE] / state[PRESSURE_GAIN]
    breaking = threshold(parameters[BREAKAWAY_SLIP], parameters[BREAKAWAY_FLOOR], state[REFERENCE])
    adhering = parameters[ADHESION_SHARE] * breaking
    n_lead = 0.0
    n_macro = n_micro = macro_force = micro_force = macro_f0 = macro_slid = 0.0
    leader_force = follower_force = leader_slid = 0.0
    for axle in range(n_axles):
        base = axle_base(axle)
        block = axle_place(axle, n_axles)
        state[block + IS_LEAD] = 0.0
        if not has_brake(axle_setup, state, base, axle):
            state[block + RANGE_CLOCK] = 0.0
            continue
        is_lead = n_lead < parameters[LEAD_AXLES]
        if is_lead:
            n_lead += 1.0
            state[block + IS_LEAD] = 1.0
        if state[FREED_AXLE] == axle + 1.0:
            state[block + RANGE_CLOCK] = 0.0
            continue
        slip_speed = state[REFERENCE] - state[base + SPEED]
        pressure = braking_pressure(parameters, measured, axle)
        signal = (pressure + inertia * state[base + ACCELERATION]) * state[block + FACTOR]
        force = state[block + FORCE] + force_blend * (signal - state[block + FORCE])
        state[block + FORCE] = force
        if slip_speed < adhering:
            state[block + IS_ARMED] = 1.0
        elif slip_speed > breaking and state[block + IS_ARMED] > 0.0:
            relative = state[base + ACCELERATION] + state[DECELERATION]
            if relative < -parameters[BREAKAWAY_GROWTH]:
                state[block + F0] = max(force, 0.0)
                state[block + IS_ARMED] = 0.0
        clock = state[block + RANGE_CLOCK] + dt
        state[block + RANGE_CLOCK] = clock
        if clock <= parameters[RESTART_AFTER]:
            state[block + MEAN] = force
            state[block + SLID] = 0.0
            continue
        mean = state[block + MEAN] + mean_blend * (signal - state[block + MEAN])
        slid = state[block + SLID] + abs(slip_speed) * dt
        state[block + MEAN] = mean
        state[block + SLID] = slid
        if is_lead:
            if n_lead == 1.0:
                leader_force = mean
                leader_slid = slid
            if n_lead == parameters[LEAD_AXLES]:
                follower_force = mean
        f0 = state[block + F0]
        if f0 > 0.0:
            if state[range_place(axle, n_axles)] > MICRO:
                n_macro += 1.0
                macro_force += mean
                macro_f0 += f0
                macro_slid += slid
            else:
                n_micro += 1.0
                micro_force += mean
    state[system + N_MACRO] = n_macro
    state[system + N_MICRO] = n_micro
    state[system + MACRO_FORCE] = macro_force
    state[system + MICRO_FORCE] = micro_force
    state[system + MACRO_F0] = macro_f0
    state[system + MACRO_SLID] = macro_slid
    state[system + LEADER_FORCE] = leader_force
    state[system + FOLLOWER_FORCE] = follower_force
    state[system + LEADER_SLID] = leader_slid


def has_brake(axle_setup: FloatArray, state: FloatArray, base: int, axle: int) -> bool:
    """Return whether an axle brakes and its speed is believed: not faulty, released or cut out."""
    is_equipped = axle_setup[axle, BRAKED] > 0.0 or axle_setup[axle, MOTORED] > 0.0
    is_sound: bool = (
        state[base + IS_FAULTY] == 0.0
        and state[base + SAFETY_FILL] == 0.0
        and state[base + SETTLED_CLOCK] <= RELEASED_AFTER
    )
    return is_equipped and is_sound
