"""What brake control costs beside the plant: one batch without it, with it, with the estimator.

Four-car unit on dry rail, no wheel-slide protection, so that the plant is what is left. The
estimator's share is the batch with it less the one with brake control alone, over the batch without
any; the heat model of the discs is counted for itself.

    python benchmarks/bench_brake_control.py [--quick] [--out FILE]
"""

from __future__ import annotations

import time
from typing import Any

from _common import options, report

import railgrip as rg
from railgrip.engine.simulate import prepare

LAYERS: dict[str, Any] = {
    "none": None,
    "central unit and controller": {"deceleration": {}},
    "and estimator": {"deceleration": {}, "estimator": {}},
    "and heat model": {"deceleration": {}, "estimator": {"temperature": "model"}},
}


def main() -> None:
    chosen = options(__doc__)
    runs, repeats = (64, 1) if chosen.quick else (512, 5)
    scenarios = {
        name: rg.load("dry_emergency").with_({"wsp.controller": "none", "brake_control": layer})
        for name, layer in LAYERS.items()
    }
    best = dict.fromkeys(scenarios, float("inf"))
    for scenario in scenarios.values():
        prepare(scenario)
        rg.simulate(scenario, runs=16)
    # in turn, so that a machine that is slow for a while is slow for all of them
    for _ in range(repeats):
        for name, scenario in scenarios.items():
            start = time.process_time()
            data = rg.simulate(scenario, runs=runs).data
            spent = time.process_time() - start
            ticks = 16 * float(data["stopping_time"].sum()) / scenario.run.step
            best[name] = min(best[name], spent / ticks)
    plant = best["none"]
    rows, before = [], plant
    for name, cost in best.items():
        rows.append((f"batch with {name}", cost * 1e9, "ns an axle-tick", ""))
        if name != "none":
            demand = "at most 5 %" if name == "and estimator" else ""
            rows.append((f"  added by it: {name}", 100 * (cost - before) / plant, "%", demand))
        before = cost
    report(f"Brake control, {runs} runs side by side", rows, chosen.out)


if __name__ == "__main__":
    main()
