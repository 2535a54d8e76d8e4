"""Throughput of a batch: the four-car train on random rail, wheel-slide protection at work.

Adhesion is lognormal along the line, 0.07 in the mean, nine tenths of it between 0.04 and 0.11;
the train stops from 160 km/h with the default step of 10 ms. Counted are simulated axle-seconds per
second of one core. Beside it stands a limit program (`_floor.py`), measured in the same run: the
least that could be called the same job, with every shortcut.

    python benchmarks/bench_batch.py [--quick] [--out FILE]
"""

from __future__ import annotations

import numpy as np
from _common import best_of, options, report
from _floor import STEP, limit_program

import railgrip as rg


def main() -> None:
    chosen = options(__doc__)
    runs, groups, times = (64, 2, 1) if chosen.quick else (2048, 16, 3)
    scenario = rg.load("random_rail")
    rg.simulate(scenario, runs=16)  # compiles, or loads what is compiled
    limit_program(1, 0.1)

    one = best_of(times, lambda: rg.simulate(scenario, runs=runs))
    two = best_of(times, lambda: rg.simulate(scenario, runs=runs, threads=2))
    floor = best_of(max(times, 3), lambda: limit_program(groups))

    data = one.result.data
    n_axles = data.sizes["axle"]
    work = n_axles * float(data["stopping_time"].sum())
    sliding = n_axles * float(data["axle_slide_time"].mean()) * runs / work
    same = all(
        np.array_equal(data[name], two.result.data[name], equal_nan=True) for name in data.data_vars
    )
    speed, limit = work / one.cpu, floor.result[0] / floor.cpu
    report(
        f"Batch of {runs} stops, {work:,.0f} axle-seconds, "
        f"{sliding:.0%} of them sliding by more than 5 %",
        [
            ("one thread, per core", speed, "axle-s/s", "demanded: 100 000"),
            ("two threads, per core", work / two.cpu, "axle-s/s", ""),
            ("two threads, wall clock", work / two.wall, "axle-s/s", ""),
            ("speed-up of two threads", one.wall / two.wall, "", ""),
            (f"limit program, steps of {STEP * 1e3:g} ms", limit, "axle-s/s", ""),
            ("railgrip over limit program", speed / limit, "", ""),
            ("one thread and two: same bits", float(same), "(1: yes)", "demanded: 1"),
        ],
        chosen.out,
    )
    if not same:
        raise SystemExit("two threads gave other bits than one")


if __name__ == "__main__":
    main()
