"""Journeys: 100 km without slip, and the optimum on 20 to 50 km.

python benchmarks/bench_journey.py [--quick] [--out FILE]
"""

from __future__ import annotations

from _common import best_of, options, report

from railgrip.campaign.optimum.timetable import optimum
from railgrip.engine.journey.drive import drive
from railgrip.scenario.journey import Journey

FAST = (("local", "realworld"), ("longdistance", "realworld"), ("flirt_tpf", "realworld"))
BEST = (
    ("virm6", "var_speed_limit_100", 0.06),
    ("flirt_tpf", "st_gallen_wil", 0.02),
    ("flirt_tpf", "st_gallen_wil", 0.001),
    ("kiss_sbb", "fribourg_bern", 0.05),
)


def main() -> None:
    """Time fast journeys of 102 km and optima at several supplements."""
    given = options(__doc__)
    times = 3 if given.quick else 10
    rows = {}
    for train, line in FAST:
        journey = Journey(train=train, line=line)
        drive(journey)
        rows[f"drive {train}, 102 km"] = best_of(times, lambda j=journey: drive(j))
    for train, line, share in BEST:
        journey = Journey(train=train, line=line, supplement=share)
        optimum(journey)
        name = f"optimum {train}, {line}, +{share:.1%}"
        rows[name] = best_of(times, lambda j=journey: optimum(j))
    demands = {"drive": "under 20 ms", "optimum": "under 300 ms"}
    report(
        "Journeys, best CPU time of several",
        [
            (name, 1e3 * timing.cpu, "ms", demands[name.partition(" ")[0]])
            for name, timing in rows.items()
        ],
        given.out,
    )


if __name__ == "__main__":
    main()
