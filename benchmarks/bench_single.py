"""One stop of the four-car train, as a user waits for it.

The engine warm in a session (with and without the curves of the stop), the whole command
`railgrip run` with its report from a fresh process with a warm cache, and `railgrip --help`. The
full mode also compiles everything anew in an empty cache: what the first run on a machine costs.

    python benchmarks/bench_single.py [--quick] [--out FILE]
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from _common import best_of, options, report

import railgrip as rg

SCENARIO = "detergent_160"


def command(*words: str, folder: str, **environment: str) -> None:
    """Run the command line in a process of its own."""
    subprocess.run(
        [sys.executable, "-m", "railgrip.app", *words],
        cwd=folder,
        env={**os.environ, **environment},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        check=True,
    )


def main() -> None:
    chosen = options(__doc__)
    times = 3 if chosen.quick else 10
    scenario = rg.load(SCENARIO)
    rg.simulate(scenario)
    bare = best_of(times, lambda: rg.simulate(scenario, traces=False))
    traced = best_of(times, lambda: rg.simulate(scenario))
    seconds = float(traced.result.data["stopping_time"][0])
    rows = [
        ("engine warm, outcomes only", bare.wall * 1e3, "ms", "demanded: under 50"),
        ("engine warm, with curves every 20 ms", traced.wall * 1e3, "ms", "demanded: under 50"),
        ("the same, CPU time", traced.cpu * 1e3, "ms", ""),
    ]
    with tempfile.TemporaryDirectory() as folder:
        command("run", SCENARIO, folder=folder)  # the disk has seen everything once
        times = 1 if chosen.quick else 5
        whole = best_of(times, lambda: command("run", SCENARIO, folder=folder))
        pages = list(Path(folder).rglob("*.html"))
        assert pages, "no report was written"
        help_ = best_of(max(times, 3), lambda: command("--help", folder=folder))
        rows += [
            ("railgrip run with report, warm cache", whole.wall, "s", "demanded: under 3"),
            ("railgrip --help", help_.wall, "s", "demanded: under 0.4"),
        ]
        if not chosen.quick:
            cache = str(Path(folder) / "empty")
            first = best_of(
                1, lambda: command("run", SCENARIO, folder=folder, NUMBA_CACHE_DIR=cache)
            )
            rows.append(("railgrip run, the first ever on a machine", first.wall, "s", ""))
    report(f"One stop: {SCENARIO}, {seconds:.1f} s to the stand", rows, chosen.out)


if __name__ == "__main__":
    main()
