"""What the whole test programme takes: four-car train, ten repetitions, and its protocol.

python benchmarks/bench_qualify.py [--quick] [--out FILE]
"""

from __future__ import annotations

import json
import resource
import time

from _common import best_of, options, report

from railgrip.campaign.programme.perform import Programme
from railgrip.campaign.programme.profile import read_profile
from railgrip.campaign.programme.protocol import protocol
from railgrip.report.protocol.page import protocol_html


def main() -> None:
    chosen = options(__doc__)
    profile, folder = read_profile("en_15595_style")
    profile = profile.with_repetitions(1 if chosen.quick else 10)
    programme = Programme(profile, folder, "emu_four_car", "conventional", threads=2)
    list(programme.perform(("D1",)))  # the engine warm
    start = time.perf_counter(), time.process_time()
    records = list(programme.perform())
    wall, cpu = time.perf_counter() - start[0], time.process_time() - start[1]
    table = protocol(programme, records, "en_15595_style")
    page = best_of(3, lambda: protocol_html(table))
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    report(
        f"The test programme, {table['summary']['runs']} runs",
        [
            ("all tests, two threads", wall, "s", "goal: 90"),
            ("the same, CPU time", cpu, "s", ""),
            ("protocol as a page", page.wall, "s", "goal: 3"),
            ("its size", len(page.result) / 1e6, "MB", ""),
            ("its table", len(json.dumps(table)) / 1e6, "MB", ""),
            ("greatest memory", memory, "MiB", ""),
        ],
        chosen.out,
    )


if __name__ == "__main__":
    main()
