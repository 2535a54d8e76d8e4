"""What the benchmarks share: arguments, clocks, a table, and where results go.

The clock that counts is CPU time: on a machine that others use too, the wall clock measures them.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
import time
from collections.abc import Callable
from datetime import date
from pathlib import Path
from typing import Any, NamedTuple


class Timing(NamedTuple):
    """The best of several calls, in seconds; `cpu` is that of all threads together."""

    wall: float
    cpu: float
    result: Any


def options(description: str | None) -> argparse.Namespace:
    """Read --quick and --out."""
    parser = argparse.ArgumentParser(description=(description or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="a few seconds, as in CI")
    parser.add_argument("--out", type=Path, help="write the figures here too, as JSON")
    return parser.parse_args()


def best_of(times: int, call: Callable[[], Any]) -> Timing:
    """Return the least wall and the least CPU time of so many calls."""
    wall, cpu = [], []
    for _ in range(times):
        wall_start, cpu_start = time.perf_counter(), time.process_time()
        result = call()
        cpu.append(time.process_time() - cpu_start)
        wall.append(time.perf_counter() - wall_start)
    return Timing(min(wall), min(cpu), result)


def machine() -> str:
    """Return the machine in words: processor, cores, Python and Numba."""
    import numba

    model = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        names = [row for row in info.read_text().splitlines() if row.startswith("model name")]
        model = names[0].partition(":")[2].strip() if names else model
    versions = f"Python {platform.python_version()}, Numba {numba.__version__}"
    return f"{model}, {os.cpu_count()} cores, {versions}"


def report(
    title: str, rows: list[tuple[str, float, str, str]], out: Path | None, *, notes: str = ""
) -> None:
    """Print rows of (what, value, unit, demand) and write them where --out says."""
    print(f"{title}\n{date.today().isoformat()}, {machine()}")
    width = max(len(row[0]) for row in rows)
    for what, value, unit, demand in rows:
        print(f"  {what:{width}}  {_short(value):>10} {unit}{'   ' + demand if demand else ''}")
    if notes:
        print(notes)
    if out is not None:
        figures = {what: {"value": value, "unit": unit} for what, value, unit, _ in rows}
        text = json.dumps({"title": title, "machine": machine(), "figures": figures}, indent=2)
        aside = out.with_name(out.name + ".part")
        aside.write_text(text + "\n", encoding="utf-8")
        aside.replace(out)
    sys.stdout.flush()


def _short(value: float) -> str:
    if value != 0 and abs(value) < 1e-2:
        return f"{value:.1e}"
    return f"{value:,.0f}".replace(",", " ") if abs(value) >= 1000 else f"{value:.3g}"
