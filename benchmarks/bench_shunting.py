"""Ten million stops of a shunting train from 25 km/h, twenty normal numbers each, stepped in time.

Beside it stands a floor: the same steps of the same equation with fastmath, six wagons alike, two
normal numbers a run instead of twenty, drawn beforehand and not counted.

    python benchmarks/bench_shunting.py [--quick] [--out FILE]
"""

from __future__ import annotations

import numba
import numpy as np
from _common import best_of, options, report

from railgrip.campaign.shunting import LANES, WAGONS, ShuntingTrain, shunting_stops

STEP = 0.1


_fast = numba.njit(fastmath=True, error_model="numpy", _nrt=False, forceinline=True)
CLAMP, PER_FILL, SPEED, PLACE, DECELERATION, FORCE, N_VARS = range(7)
L = LANES


@_fast
def _wagon(S, filling):
    for k in range(L):
        grip = min(max(filling * S[PER_FILL * L + k], 0.0), 1.0) * S[CLAMP * L + k]
        S[FORCE * L + k] += 880.0 * grip * (grip + 200.0) / (grip + 50.0)


@_fast
def _move(S):
    moving = 0.0
    for k in range(L):
        speed = S[SPEED * L + k]
        middle = max(speed - 0.5 * STEP * S[DECELERATION * L + k], 0.0) * 3.6
        force = S[FORCE * L + k] * (middle + 150.0) / (middle + 75.0) + 7416.0
        after = max(speed - force * (STEP / 641.6e3), 0.0)
        S[PLACE * L + k] += 0.5 * (speed + after) * STEP
        S[SPEED * L + k] = after
        S[DECELERATION * L + k] = force * (1.0 / 641.6e3)
        S[FORCE * L + k] = 0.0
        moving += after
    return moving


@numba.njit(fastmath=True, error_model="numpy", _nrt=False, nogil=True)
def _floor(S, normals, distance):
    for group in range(0, len(distance), L):
        for k in range(L):
            S[CLAMP * L + k] = 13.85 * (1.0 + 0.03 * normals[group + k, 0])
            S[PER_FILL * L + k] = 1.0 / (4.0 + 0.33 * normals[group + k, 1])
            S[SPEED * L + k] = 25 / 3.6
            S[PLACE * L + k] = 0.0
            S[DECELERATION * L + k] = 0.0
        time, moving = 0.5 * STEP, 1.0
        while moving > 0.0:
            for w in range(WAGONS):
                _wagon(S, time - 0.25 - 0.056 * w)
            moving = _move(S)
            time += STEP
        for k in range(L):
            distance[group + k] = S[PLACE * L + k]


def main() -> None:
    chosen = options(__doc__)
    runs = 160_000 if chosen.quick else 10_000_000
    least = 160_000 if chosen.quick else 1_600_000
    shunting_stops(16)
    normals, distance = np.random.default_rng(1).standard_normal((least, 2)), np.zeros(least)
    memory = np.zeros(N_VARS * L)
    _floor(memory, normals[:16], distance[:16])
    one = best_of(1, lambda: shunting_stops(least))
    two = best_of(1, lambda: shunting_stops(runs, threads=2))
    floor = best_of(3, lambda: _floor(memory, normals, distance))
    finer = shunting_stops(10_000, step=0.01)
    error = float(np.abs(two.result[:10_000] / finer - 1.0).max())
    demand = "" if chosen.quick else "demanded: 30"
    report(
        f"{runs:,} stops from {ShuntingTrain().speed * 3.6:.0f} km/h, steps of {STEP:g} s",
        [
            ("two threads, wall clock", two.wall, "s", demand),
            ("two threads, CPU", two.cpu, "s", ""),
            ("two threads, CPU over two", two.cpu / 2, "s", "wall clock of two free cores"),
            ("one thread, per core", least / one.cpu, "runs/s", ""),
            ("floor, per core", least / floor.cpu, "runs/s", ""),
            ("railgrip over floor", floor.cpu / one.cpu, "", ""),
            ("greatest error against 0.01 s", error, "", ""),
            ("one thread and two: same bits",
             float(np.array_equal(one.result, two.result[:least])), "(1: yes)", "demanded: 1"),
        ],
        chosen.out,
    )  # fmt: skip


if __name__ == "__main__":
    main()
