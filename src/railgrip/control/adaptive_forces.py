"""What each braked axle reaches (`force_weighing`), told by its cylinder.

Any signal proportional to the brake force will do. The cylinder pressure is one; at breakaway it
runs ahead of the rail's force, because a part of it only slows the wheel. That part is known from
the wheel's deceleration and the ordinary WSP's own estimate of what a Pascal brakes, so the rail's
force is the better signal, most of all in a cylinder that is still filling.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.adaptive_parameters import RAIL_FORCE, SIGNAL
from railgrip.control.adaptive_state import TELLS
from railgrip.control.axle_protection import freed_place
from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import ROTATING_SHARE, conventional_of
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
from railgrip.control.force_weighing import ALWAYS_SETTLED, add_up, weigh_axle, weighing
from railgrip.control.state_layout import GROUP, group_base, groups
from railgrip.control.train_observer import braking_pressure
from railgrip.core.formulas.choosing import choose

RELEASED_AFTER: Final = 1.0  # s without brake and without gain of speed: released or cut out


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
    same = weighing(parameters, state[REFERENCE], ALWAYS_SETTLED, dt)
    inertia = _inertia(parameters, state)
    reference = state[REFERENCE]
    deceleration = state[DECELERATION]
    freed = freed_place(state)
    for group in range(groups(n_axles)):
        for i in range(GROUP):
            base = group_base(group) + i
            brakes = has_brake(state, base)
            acceleration = state[base + ACCELERATION]
            force = braking_pressure(own, state, base) + inertia * acceleration
            slip_speed = reference - state[base + SPEED]
            growth = -(acceleration + deceleration)
            weigh_axle(same, state, base, brakes & (base != freed), force, slip_speed, growth, dt)
            # an axle that is let run free leads all the same
            state[base + TELLS] = choose(brakes, 1.0, 0.0)
    add_up(parameters, state, n_axles)


def _inertia(parameters: FloatArray, state: FloatArray) -> float:
    """Return the pressure that slows a wheel by 1 m/s², 0 where the signal is it, [Pa s²/m]."""
    inertia = 0.0
    if parameters[SIGNAL] == RAIL_FORCE:
        inertia = parameters[ROTATING_SHARE] / state[PRESSURE_GAIN]
    return inertia


def has_brake(state: FloatArray, base: int) -> bool:
    """Return whether an axle brakes and its speed is believed: not faulty, released or cut out."""
    is_equipped = state[base + IS_BRAKED] + state[base + IS_MOTORED] > 0.0
    is_believed = state[base + IS_FAULTY] == 0.0
    is_trusted = state[base + SAFETY_FILL] == 0.0
    is_at_work = state[base + SETTLED_CLOCK] <= RELEASED_AFTER
    return bool(is_equipped & is_believed & is_trusted & is_at_work)
