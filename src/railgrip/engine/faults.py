"""Faults of single axles: what breaks between wheel and controller, or in valve and axle.

They act on few axles of few runs, so they are loops of their own beside the packed passes.
"""

from __future__ import annotations

from typing import Any

from railgrip.compiler import compiled, inlined
from railgrip.control import contract as ctl
from railgrip.engine import layout as at
from railgrip.scenario.fault import FAULT_KINDS
from railgrip.track.random_field import standard_normal

(
    SENSOR_LOST, SENSOR_DEAD, SENSOR_FROZEN, SENSOR_NOISY, SENSOR_SCALED,
    VALVE_FILLS, VALVE_HOLDS, VALVE_VENTS, VALVE_DELAYED, AXLE_LOCKED,
) = range(len(FAULT_KINDS))  # fmt: skip
"""Numbers of the kinds, in the order of `railgrip.scenario.fault.FAULT_KINDS`."""
NOISE_STREAM = 100
"""Stream of random numbers of the first axle's noise; one stream an axle."""
SEIZED = 1.0
"""Dry friction of an axle that seizes, over its static load: more than any rail gives, and little
enough that the wheel takes a few tenths of a second to stand (illustrative)."""

_normal = inlined(standard_normal)


@inlined
def _acts(faults: Any, i: int, tick: int, run: int) -> bool:
    happens = faults.happens[run if faults.happens.shape[0] > 1 else 0, i] == 1
    return bool(happens and faults.begin[i] <= tick < faults.end[i])


@compiled
def break_sensors(L: int, S: Any, faults: Any, timing: Any, moment: int, seed: int, k: int) -> None:
    """Spoil what the sensors of lane k hand over in this tick."""
    now = (at.SPEED_HISTORY + (moment & timing.kept)) * L + k
    before = (at.SPEED_HISTORY + ((moment - 1) & timing.kept)) * L + k
    tick = int(S[at.TICK * L + k])
    run, number = int(S[at.RUN * L + k]), int(S[at.NUMBER * L + k])
    for i in range(faults.axle.shape[0]):
        kind = faults.kind[i]
        if kind > SENSOR_SCALED or not _acts(faults, i, tick, run):
            continue
        b = (1 + faults.axle[i]) * at.N_VARS * L
        if kind == SENSOR_LOST:
            S[b + now] = float("nan")
        elif kind == SENSOR_DEAD:
            S[b + now] = 0.0
        elif kind == SENSOR_FROZEN:
            S[b + now] = S[b + before]
        elif kind == SENSOR_NOISY:
            normal = _normal(tick, number, NOISE_STREAM + faults.axle[i], seed)
            S[b + now] = abs(S[b + now] + faults.value[i] * normal)
        else:
            S[b + now] *= faults.value[i]


@compiled
def break_valves(
    L: int, S: Any, faults: Any, timing: Any, moment: int, axle: int, k: int
) -> None:  # fmt: skip
    """Let the dump valve of an axle do something else than it is told."""
    tick = int(S[at.TICK * L + k])
    b = (1 + axle) * at.N_VARS * L + k
    for i in range(faults.axle.shape[0]):
        kind = faults.kind[i]
        if faults.axle[i] != axle or not VALVE_FILLS <= kind <= VALVE_DELAYED:
            continue
        if not _acts(faults, i, tick, int(S[at.RUN * L + k])):
            continue
        vents = kind == VALVE_VENTS
        fills = kind == VALVE_FILLS
        if kind == VALVE_DELAYED:
            late = moment - faults.ticks[i]
            slot = at.VALVE_HISTORY + ((late - timing.vent_delay) & timing.kept)
            vents = S[b + slot * L] == ctl.VENT
            slot = at.VALVE_HISTORY + ((late - timing.fill_delay) & timing.kept)
            fills = S[b + slot * L] == ctl.FILL and not vents
        S[b + at.IS_VENT * L] = 1.0 if vents else 0.0
        S[b + at.IS_FILL * L] = 1.0 if fills else 0.0


@compiled
def seize_axles(L: int, S: Any, faults: Any, k: int) -> None:
    """Add the friction of seized bearings to the brakes of lane k."""
    tick, run = int(S[at.TICK * L + k]), int(S[at.RUN * L + k])
    for i in range(faults.axle.shape[0]):
        if faults.kind[i] == AXLE_LOCKED and _acts(faults, i, tick, run):
            b = (1 + faults.axle[i]) * at.N_VARS * L + k
            S[b + at.BRAKE_LIMIT * L] += SEIZED * S[b + at.STATIC_LOAD * L]
