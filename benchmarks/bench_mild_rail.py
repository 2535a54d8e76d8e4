"""Error of the stopping distance over the step where the protection acts but does not rule.

Mild rail: wet, with 100 m of water and detergent, on which wheels slide, are caught and recover.
The four-car train brakes from 126 to 140 km/h, speed and place drawn for each run; the protection
acts every 10 ms. The error is that of each run against its own with steps of 1 ms.

Twice: with speed sensors of the finest resolution (1 000 teeth, 1 ns), where what is left is the
error of the integration; and with the train's own sensors (100 teeth, 10 µs), whose last tooth
decides whether a valve opens one period sooner, at any step.

    python benchmarks/bench_mild_rail.py [--quick] [--out FILE]
"""

from __future__ import annotations

import numpy as np
from _common import options, report

import railgrip as rg

CONVERGED = 0.001
STEPS = (0.010, 0.005, 0.0025)
DEMANDED = 1e-4
FINE = {"train.sensor.teeth": 1000, "train.sensor.timer": 1e-9}
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
    variations = {
        "INITIAL_SPEED": 140 / 3.6 * draw.uniform(0.9, 1.0, runs),
        "START_POSITION": 1000.0 + draw.uniform(0.0, 100.0, runs),
    }

    def stops(step, sensors):
        scenario = rg.load(SCENARIO).with_({"run.step": step, **sensors})
        return rg.simulate(scenario, runs=runs, variations=variations).data

    rows = []
    for words, sensors in (("fine sensors", FINE), ("own sensors", {})):
        converged = stops(CONVERGED, sensors)
        true = converged["stopping_distance"].values
        acting = float((converged["axle_valve_cycles"].sum("axle") > 0).mean())
        rows.append((f"{words}: runs in which valves vent", 100 * acting, "%", ""))
        for step in STEPS:
            error = np.abs(stops(step, sensors)["stopping_distance"].values / true - 1.0)
            is_asked = step == STEPS[0]
            demand = f"demanded: under {DEMANDED:.0e}" if is_asked else ""
            words_of_step = f"{words}: median error at {step * 1e3:g} ms"
            rows.append((words_of_step, float(np.median(error)), "", demand))
            if step == STEPS[0]:
                tenth = float(np.quantile(error, 0.9))
                rows.append((f"{words}: nine tenths are below", tenth, "", ""))
    report(f"Stopping distance of {runs} stops against steps of 1 ms", rows, chosen.out)


if __name__ == "__main__":
    main()
