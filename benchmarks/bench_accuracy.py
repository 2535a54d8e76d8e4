"""Stopping distance at the default step against a step of 1 ms, protection at work.

The four-car train stops from 144 to 160 km/h on rails of one friction each, from "no valve
works" to "slides most of the time"; they were chosen after a first look at which friction does
which, so no single row proves the demand: `bench_mild_rail.py` has a rail of its own. The
controller keeps its period of 10 ms. A threshold controller makes a closed loop chaotic: where it
works hard, two correct computations part, and the difference no longer falls with the step. So
beside the median of the errors stands their mean with its sign (a step that is too long would show
there) and how often the valves worked.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

import railgrip as rg

RAILS = (0.15, 0.14, 0.13, 0.12, 0.11)
STEPS = (0.010, 0.005, 0.0025)
CONVERGED = 0.001


def stops(friction: float, step: float, runs: int) -> tuple[Any, float]:
    """Return the stopping distances and the mean number of vents of a train."""
    scenario = rg.load("leaves_160").with_(
        {
            "run.step": step,
            "run.trace": 0.02,
            "rail.condition": {
                "contaminated": {"static_friction": friction, "friction_ratio": 1.0}
            },
        }
    )
    speeds = np.linspace(0.9, 1.0, runs) * scenario.run.speed
    result = rg.simulate(
        scenario, runs=runs, variations={"INITIAL_SPEED": speeds}, traces=False, threads=2
    )
    vents = result["axle_valve_cycles"].values.sum(axis=1).mean()
    return result["stopping_distance"].values, float(vents)


def main() -> None:
    """Print the errors of every rail and step."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="two rails, few runs")
    quick = parser.parse_args().quick
    runs, rails = (16, RAILS[:3:2]) if quick else (64, RAILS)
    steps = STEPS[:1] if quick else STEPS
    print(f"relative error of the stopping distance against 1 ms, {runs} runs a rail")
    print("  friction   step, ms   median |error|   mean error   vents a stop")
    for friction in rails:
        converged, _ = stops(friction, CONVERGED, runs)
        for step in steps:
            found, vents = stops(friction, step, runs)
            error = found / converged - 1
            print(
                f"  {friction:8.2f}   {step * 1e3:8.1f}   {np.median(np.abs(error)):14.1e}"
                f"   {error.mean():+10.1e}   {vents:12.0f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
