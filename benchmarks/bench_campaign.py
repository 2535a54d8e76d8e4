"""Campaigns: runs a second and core, the cost beside the engine, two threads, and memory.

The shipped campaign (four-car train on dry rail, 49 draws a run), the eight-axle unit of EN 14531
without sliding, and the four-car train sliding with wheel-slide protection. The cost beside the
engine is the time of drawing, laying out, collecting and writing over that of the kernel, on one
thread. One and two threads take turns, as others may use the machine: the best of each, and the
median of the turns. Full size is one million stops of the eight-axle unit and 20 000 of the sliding
train, one turn.

    python benchmarks/bench_campaign.py [--quick] [--out FILE]
"""

from __future__ import annotations

import resource
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import Any

from _common import options, report

from railgrip.campaign import batch
from railgrip.campaign.campaign_file import CampaignFile, campaign_from, read_campaign_file
from railgrip.campaign.running import run_campaign

FRICTION = {
    "quantity": "train.vehicle[*].bogie[*].axle[*].friction_factor",
    "name": "friction",
    "scope": "axle",
    "distribution": {"kind": "normal", "mean": 1, "deviation": 0.025},
}
MASS = {
    "quantity": "train.vehicle[*].tare",
    "name": "mass",
    "apply": "factor",
    "distribution": {"kind": "normal", "mean": 1, "deviation": 0.02},
}
FULL = {"eight axles, dry": 1_000_000, "four cars, sliding": 20_000, "four cars, dry": 20_000}
QUICK = {"eight axles, dry": 4096, "four cars, sliding": 1024, "four cars, dry": 1024}
TURNS = 5
"""Of one and two threads in a quick pass."""


def asked(name: str, runs: int) -> CampaignFile:
    chunk = min(4096, max(32, runs // 4))
    if name == "four cars, dry":
        return read_campaign_file("dry_emergency").model_copy(update={"runs": runs, "chunk": chunk})
    scenario = "en14531_100" if name == "eight axles, dry" else "random_rail"
    table = {
        "scenario": scenario, "runs": runs, "chunk": chunk, "variable": [FRICTION, MASS],
    }  # fmt: skip
    return campaign_from(table, Path())


class Kernel:
    """Counts the CPU time inside the engine."""

    def __init__(self) -> None:
        self.seconds = 0.0
        self._compute = batch.compute

    def __call__(self, *arguments: Any) -> Any:
        begun = time.thread_time()
        found = self._compute(*arguments)
        self.seconds += time.thread_time() - begun
        return found


def timed(name: str, runs: int, threads: int, folder: Path) -> tuple[float, float, float]:
    """Return wall, CPU and kernel seconds of the runs; what set-up alone takes is taken off."""
    batch.Batches(asked(name, runs)).table(0, 16)
    wall_before, cpu_before = time.perf_counter(), time.process_time()
    batch.Batches(asked(name, runs))
    wall_set, cpu_set = time.perf_counter() - wall_before, time.process_time() - cpu_before
    kernel = Kernel()
    batch.compute = kernel
    try:
        wall, cpu = time.perf_counter(), time.process_time()
        run_campaign(asked(name, runs), folder / f"{name} {threads}", threads=threads)
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    finally:
        batch.compute = kernel._compute
    return wall - wall_set, cpu - cpu_set, kernel.seconds


def main() -> None:
    chosen = options(__doc__)
    sizes = QUICK if chosen.quick else FULL
    rows = []
    with tempfile.TemporaryDirectory() as place:
        for name, runs in sizes.items():
            turns = range(TURNS if chosen.quick else 1)
            one, two = zip(
                *(
                    [timed(name, runs, n, Path(place) / f"{turn}") for n in (1, 2)]
                    for turn in turns
                ),
                strict=True,
            )
            wall, cpu, kernel = (min(column) for column in zip(*one, strict=True))
            ratios = [alone[0] / both[0] for alone, both in zip(one, two, strict=True)]
            rows += [
                (f"{name}: {runs} runs, one thread", wall, "s", ""),
                (f"{name}: runs per core", runs / cpu, "1/s", ""),
                (f"{name}: beside the engine", 100 * (cpu / kernel - 1), "%", "at most 10"),
                (f"{name}: two threads, best", wall / min(two)[0], "times one", "at least 1.9"),
                (f"{name}: two threads, median of {len(ratios)}", median(ratios), "times one", ""),
                (f"{name}: CPU time of two threads", min(b[1] for b in two) / cpu, "of one", ""),
            ]
            peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
            rows.append((f"greatest memory so far, {name}", peak, "MiB", ""))
    report("Campaigns, set-up of the scenario left out", rows, chosen.out)


if __name__ == "__main__":
    main()
