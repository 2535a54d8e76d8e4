"""The limit: what the same machine does with the least program that deserves the name.

Sixteen axles on one speed, sixteen runs side by side, 1 ms semi-implicit Euler, Polach's creep law
with falling friction, a two-threshold valve rule every 10 ms, a first-order brake cylinder, one
disc temperature, and rail that the axles in front have cleaned. Every shortcut is taken that
railgrip does not take: fastmath, true speeds in place of sensors, all axles alike, rail without
places, no load transfer, no dynamic brake, no reservoir, no energy account, no runs that end and
are replaced.
"""

from __future__ import annotations

import numba
import numpy as np

import railgrip.compiler  # noqa: F401  the same vector width for both, set before compiling
from railgrip.core.formulas.elementary import arctangent, exp_decay

LANES = 16
AXLES = 16
STEP = 1e-3
TICKS_PER_CONTROL = 10

# handed down from block to block, then the axle's own; block 0 is the train's
SPEED, PER_SPEED, FORCE, PASSED_ON = (np.uint64(i) for i in range(4))
WHEEL, CYLINDER, DISC, FRICTION, IS_VENT, IS_FILL, N_VARS = (np.uint64(i) for i in range(4, 11))
L, BLOCK = np.uint64(LANES), N_VARS * np.uint64(LANES)
LAST = np.uint64(AXLES) * BLOCK

AXLE_LOAD, AXLE_MASS, ROTATING_MASS = 13.75e3 * 9.81, 13.75e3, 1.0e3
SLOPE = 20e6  # N per unit creepage, two wheels
FULL_FORCE = 17e3  # N at the tread, adhesion 0.13
CYLINDER_TIME, DISC_HEAT, DISC_COOLING = 0.3, 6.0e4, 0.01
RATIO, DECAY, STICK, SLIDE, CLEANING = 0.4, 0.2, 1.0, 0.4, 1.9e-4
CLEAN, AMBIENT = 0.28, 20.0
QUARTER_PI, TWO_OVER_PI = 0.25 * np.pi, 2.0 / np.pi

_fast = numba.njit(fastmath=True, error_model="numpy", _nrt=False, forceinline=True)
_exp_decay = _fast(exp_decay)
_arctangent = _fast(arctangent)


@_fast
def _adhesion(friction, slip_speed, creepage):
    """Polach 2005, as in `railgrip.contact.polach_2005`."""
    limit = AXLE_LOAD * friction * (RATIO + (1.0 - RATIO) * _exp_decay(DECAY * slip_speed))
    stress = QUARTER_PI * SLOPE * creepage / limit
    stick = STICK * stress
    return TWO_OVER_PI * limit * (stick / (1.0 + stick * stick) + _arctangent(SLIDE * stress))


@_fast
def _axle_pass(S, b, h):
    """One axle of all lanes over one step."""
    front = b - BLOCK
    for k in range(L):
        speed = S[front + SPEED * L + k]
        per_speed = S[front + PER_SPEED * L + k]
        found = S[front + PASSED_ON * L + k]
        wheel = S[b + WHEEL * L + k]
        cylinder = S[b + CYLINDER * L + k]
        friction = S[b + FRICTION * L + k]
        friction = CLEAN + _exp_decay(CLEANING * found) * (friction - CLEAN)
        slip_speed = max(abs(wheel - speed), 1e-6)
        chord = _adhesion(friction, slip_speed, slip_speed * per_speed) / slip_speed
        brake = FULL_FORCE * cylinder
        inertia = ROTATING_MASS / h
        after = max((inertia * wheel + chord * speed - brake) / (inertia + chord), 0.0)
        contact = chord * (after - speed)
        filling = S[b + IS_FILL * L + k] * (1.0 - cylinder) - S[b + IS_VENT * L + k] * cylinder
        disc = S[b + DISC * L + k]
        heat = brake * after / DISC_HEAT - DISC_COOLING * (disc - AMBIENT)
        S[b + SPEED * L + k] = speed
        S[b + PER_SPEED * L + k] = per_speed
        S[b + FORCE * L + k] = S[front + FORCE * L + k] + contact
        S[b + PASSED_ON * L + k] = found + abs(contact) * slip_speed * per_speed
        S[b + WHEEL * L + k] = after
        S[b + CYLINDER * L + k] = cylinder + h / CYLINDER_TIME * filling
        S[b + DISC * L + k] = disc + h * heat


@_fast
def _train_pass(S, h):
    for k in range(L):
        speed = S[SPEED * L + k] + h / (AXLES * AXLE_MASS) * S[LAST + FORCE * L + k]
        S[SPEED * L + k] = speed
        S[PER_SPEED * L + k] = 1.0 / max(speed, 1.0)


@_fast
def _control_pass(S, b):
    """Vent above the upper slip, fill below the lower one, hold in between."""
    for k in range(L):
        slip = (S[b + SPEED * L + k] - S[b + WHEEL * L + k]) * S[b + PER_SPEED * L + k]
        S[b + IS_VENT * L + k] = 1.0 if slip > 0.16 else 0.0
        S[b + IS_FILL * L + k] = 1.0 if slip < 0.08 else 0.0


@numba.njit(fastmath=True, error_model="numpy", _nrt=False, nogil=True)
def _run(S, ticks):
    for tick in range(ticks):
        if tick % TICKS_PER_CONTROL == 0:
            for axle in range(AXLES):
                _control_pass(S, np.uint64(axle + 1) * BLOCK)
        for axle in range(AXLES):
            _axle_pass(S, np.uint64(axle + 1) * BLOCK, STEP)
        _train_pass(S, STEP)


def limit_program(groups: int, seconds: float = 20.0) -> tuple[float, float]:
    """Brake so many groups of runs for a while; return axle-seconds and mean deceleration."""
    ticks = round(seconds / STEP)
    speeds = []
    for group in range(groups):
        table = np.zeros((1 + AXLES, int(N_VARS), LANES))
        table[:, SPEED] = 160 / 3.6
        table[:, PER_SPEED] = 3.6 / 160
        table[1:, WHEEL] = 160 / 3.6
        table[1:, DISC] = AMBIENT
        table[1:, FRICTION] = 0.04 + 0.06 * (np.arange(LANES) + group / groups) / LANES
        S = table.ravel()
        _run(S, ticks)
        speeds.append(S[:LANES].copy())
    mean = (160 / 3.6 - float(np.mean(speeds))) / seconds
    return groups * LANES * AXLES * ticks * STEP, mean
