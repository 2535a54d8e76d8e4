"""Campaigns on Dask: two workers against one, on chunks of about a second.

A scheduler and workers are processes of their own; each worker has one thread, and on Linux one
core. Rounds alternate between one worker and two, all warmed up; the median of the ratios counts.
On a machine that others use too the wall clock measures them: so it is also said how many cores the
workers got, and what a second of a worker's CPU time yields, alone and beside another.

    python benchmarks/bench_cluster.py [--quick] [--out FILE]
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import psutil
from _common import options, report

from railgrip.campaign.batch import Batches
from railgrip.campaign.campaign_file import CampaignFile, read_campaign_file
from railgrip.campaign.running import run_campaign

CHUNK = 256
"""Runs of the four-car train on dry rail that take a core about a second."""
PATIENCE = 120
ONE_THREAD = {"NUMBA_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


class Round(NamedTuple):
    """Wall seconds of a campaign without its set-up, and CPU seconds of its workers."""

    wall: float
    cpu: float


class Workers(NamedTuple):
    """Where a scheduler answers, and its workers' processes."""

    address: str
    processes: list[psutil.Process]

    def cpu(self) -> float:
        times = [process.cpu_times() for process in self.processes]
        return sum(one.user + one.system for one in times)


@contextmanager
def workers(number: int, place: Path) -> Iterator[Workers]:
    """Start a scheduler and so many workers; end them all."""
    place.mkdir()
    file = place / "scheduler.json"
    dask, where = [sys.executable, "-m", "dask"], ["--scheduler-file", str(file)]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": place}
    local = ["--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
    worker = [*dask, "worker", *where, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
    started = [subprocess.Popen([*dask, "scheduler", *where, *local], **quiet)]
    try:
        for core in range(number):
            one = subprocess.Popen(worker, env={**os.environ, **ONE_THREAD}, **quiet)
            started.append(one)
            if hasattr(os, "sched_setaffinity"):
                allowed = sorted(os.sched_getaffinity(0))
                os.sched_setaffinity(one.pid, {allowed[core % len(allowed)]})
        deadline = time.monotonic() + PATIENCE
        while not file.exists() or not file.read_text():
            if time.monotonic() > deadline:
                raise SystemExit("the scheduler does not start; try: dask scheduler")
            time.sleep(0.05)
        address = json.loads(file.read_text())["address"]
        yield Workers(address, [psutil.Process(one.pid) for one in started[1:]])
    finally:
        for one in reversed(started):
            one.kill()
            one.wait()


def timed(asked: CampaignFile, there: Workers, folder: Path) -> Round:
    begun = time.perf_counter()
    Batches(asked)
    set_up = time.perf_counter() - begun
    wall, cpu = time.perf_counter(), there.cpu()
    run_campaign(asked, folder, address=there.address)
    return Round(time.perf_counter() - wall - set_up, there.cpu() - cpu)


def main() -> None:
    chosen = options(__doc__)
    chunks, rounds = (4, 1) if chosen.quick else (16, 5)
    shipped = read_campaign_file("dry_emergency")
    asked = shipped.model_copy(update={"runs": CHUNK * chunks, "chunk": CHUNK})
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        with workers(1, place / "one") as one, workers(2, place / "two") as two:
            for label, there in (("one", one), ("two", two)):
                timed(asked, there, place / f"warm {label}")
            pairs = [
                (timed(asked, one, place / f"one {i}"), timed(asked, two, place / f"two {i}"))
                for i in range(rounds)
            ]
    ratios = [alone.wall / both.wall for alone, both in pairs]
    yields = [alone.cpu / both.cpu for alone, both in pairs]
    rows = [
        ("two workers, median", statistics.median(ratios), "times one", "at least 1.8"),
        ("two workers, least", min(ratios), "times one", ""),
        ("two workers, greatest", max(ratios), "times one", ""),
        ("a chunk, CPU of one worker", pairs[0][0].cpu / chunks, "s", "about 1"),
        ("cores that one worker got", statistics.median(a.cpu / a.wall for a, _ in pairs), "", ""),
        ("cores that two workers got", statistics.median(b.cpu / b.wall for _, b in pairs), "", ""),
        ("yield of CPU time beside another", statistics.median(yields), "times alone", ""),
    ]
    title = f"Dask: {chunks} chunks of {CHUNK} runs, {rounds} rounds, set-up left out"
    report(title, rows, chosen.out)


if __name__ == "__main__":
    main()
