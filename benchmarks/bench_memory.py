"""Memory of a batch: it grows by one line of outcomes a run, and by nothing else.

Each batch runs in a process of its own, whose greatest resident memory is read at its end. The
runs are short (5 km/h on dry rail): memory does not depend on how far a run goes.

    python benchmarks/bench_memory.py [--quick] [--out FILE]
"""

from __future__ import annotations

import subprocess
import sys

from _common import options, report

CHANGES = {"run.speed": "5 km/h", "rail.condition": "dry"}


def peak(runs: int) -> float:
    """Run a batch in a process of its own and return its greatest resident memory, bytes."""
    code = f"import bench_memory; bench_memory.child({runs})"
    path = [sys.path[0]]
    child = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path[:0] = {path!r}; {code}"],
        capture_output=True,
        text=True,
        check=True,
    )
    return float(child.stdout)


def child(runs: int) -> None:
    """Run one batch and print the greatest resident memory of this process."""
    import resource

    import railgrip as rg

    rg.simulate(rg.load("detergent_160").with_(CHANGES), runs=runs)
    unit = 1 if sys.platform == "darwin" else 1024
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit)


def main() -> None:
    chosen = options(__doc__)
    if sys.platform == "win32":
        print("memory is not measured on Windows (no getrusage)")
        return
    counts = (16, 4096) if chosen.quick else (16, 256, 4096, 65536)
    peak(counts[0])  # compiles, which takes memory of its own
    peaks = [peak(runs) for runs in counts]
    rows = [
        (f"greatest memory, {runs} runs", size / 2**20, "MiB", "")
        for runs, size in zip(counts, peaks, strict=True)
    ]
    grown = (peaks[-1] - peaks[0]) / (counts[-1] - counts[0])
    rows.append(("growth a run", grown / 1024, "KiB", ""))
    rows.append(("line of outcomes a run", outcome_bytes() / 1024, "KiB", ""))
    report("Memory of a batch without curves, four-car train", rows, chosen.out)


def outcome_bytes() -> int:
    """Return the bytes of what is kept of a run."""
    import railgrip as rg

    result = rg.simulate(rg.load("detergent_160").with_(CHANGES), runs=16)
    return (
        sum(
            variable.nbytes for variable in result.data.data_vars.values() if "run" in variable.dims
        )
        // 16
    )


if __name__ == "__main__":
    main()
