"""Error of the stopping distance over the step where the protection acts but does not rule.

Mild rail: wet, with 100 m of water and detergent, on which wheels slide, are caught and recover.
The four-car train brakes from 126 to 140 km/h, speed and place drawn for each run; the protection
acts every 10 ms. The error is that of each run against its own with steps of 1 ms.

With three sensors: the finest (1 000 teeth, 1 ns), where what is left is the error of the
integration; its own teeth on a timer of 1 µs; and the train's own sensor (100 teeth, 10 µs).
A coarse timer decides by a hair whether a valve opens one period sooner. How much that alone does
is measured beside it: every stop is repeated with the same step of 1 ms and an initial speed that
is larger by one part in ten million (4 µm/s). Below that, no step can be told from another.

    python benchmarks/bench_mild_rail.py [--quick] [--out FILE]
"""

from __future__ import annotations

import numpy as np
from _common import options, report

import railgrip as rg

CONVERGED = 0.001
STEPS = (0.010, 0.005, 0.0025)
DEMANDED = 1e-4
SENSORS = {
    "finest sensor": {"train.sensor.teeth": 1000, "train.sensor.timer": 1e-9},
    "own teeth, 1 us": {"train.sensor.timer": 1e-6},
    "own sensor, 10 us": {},
}
NUDGE = 1.0 + 1e-7
SCENARIO = {
    "title": "Four-car unit, 100 m of detergent on wet rail",
    "train": "emu_four_car",
    "line": {"use": "level", "start": 1000.0},
    "rail": {
        "condition": "wet",
        "patch": [{"from": 1200.0, "to": 1300.0, "condition": "water_detergent"}],
    },
    "run": {"speed": "140 km/h", "demand": "emergency"},
    "wsp": {"controller": "conventional"},
}


def main() -> None:
    chosen = options(__doc__)
    runs = 32 if chosen.quick else 512
    draw = np.random.default_rng(1)
    speed = 140 / 3.6 * draw.uniform(0.9, 1.0, runs)
    place = 1000.0 + draw.uniform(0.0, 100.0, runs)

    def stops(step, sensor, nudge=1.0):
        scenario = rg.load(SCENARIO).with_({"run.step": step, **sensor})
        variations = {"INITIAL_SPEED": nudge * speed, "START_POSITION": place}
        return rg.simulate(scenario, runs=runs, variations=variations).data

    rows = []
    for words, sensor in SENSORS.items():
        converged = stops(CONVERGED, sensor)
        true = converged["stopping_distance"].values
        acting = float((converged["axle_valve_cycles"].sum("axle") > 0).mean())
        rows.append((f"{words}: runs in which valves vent", 100 * acting, "%", ""))
        rows.append(
            (
                f"{words}: 4 um/s faster, 1 ms",
                _median(stops(CONVERGED, sensor, NUDGE), true),
                "",
                "",
            )
        )
        for step in STEPS:
            demand = f"demanded: under {DEMANDED:.0e}" if step == STEPS[0] else ""
            rows.append(
                (
                    f"{words}: median error at {step * 1e3:g} ms",
                    _median(stops(step, sensor), true),
                    "",
                    demand,
                )
            )
    report(f"Stopping distance of {runs} stops against steps of 1 ms", rows, chosen.out)


def _median(data, true):
    """Return the median relative difference of the stopping distances."""
    return float(np.median(np.abs(data["stopping_distance"].values / true - 1.0)))


if __name__ == "__main__":
    main()
