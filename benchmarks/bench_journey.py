"""Journeys: 100 km without slip, coasting, and axle by axle; the optimum on 20 to 50 km.

python benchmarks/bench_journey.py [--quick] [--out FILE]
"""

from __future__ import annotations

from _common import best_of, options, report

import railgrip as rg
from railgrip.campaign.optimum.timetable import optimum
from railgrip.engine.journey.coasting import coasting_of
from railgrip.engine.journey.drive import drive
from railgrip.engine.trip import drive_trip
from railgrip.scenario.coasting import Coasting
from railgrip.scenario.journey import Journey

FAST = (("local", "realworld"), ("longdistance", "realworld"), ("flirt_tpf", "realworld"))
BEST = (
    ("virm6", "var_speed_limit_100", 0.06),
    ("flirt_tpf", "st_gallen_wil", 0.02),
    ("flirt_tpf", "st_gallen_wil", 0.001),
    ("kiss_sbb", "fribourg_bern", 0.05),
)


TRIP = {
    "line.use": {
        "length": 102e3,
        "speed_limit": [{"at": 0, "value": "140 km/h"}, {"at": 50e3, "value": "120 km/h"}],
        "gradient": [{"at": 0, "value": 0.003}, {"at": 30e3, "value": -0.004}],
    },
    "trip": {"stop": [{"at": 0}, {"at": 30e3}, {"at": 60e3}, {"at": 100e3}]},
}
"""100 km of the four-car unit, sixteen axles, with slide protection, on dry rail."""


def main() -> None:
    """Time fast journeys of 102 km and optima at several supplements."""
    given = options(__doc__)
    times = 3 if given.quick else 10
    rows = {}
    for train, line in FAST:
        journey = Journey(train=train, line=line)
        drive(journey)
        rows[f"drive {train}, 102 km"] = best_of(times, lambda j=journey: drive(j))
        coasts = journey.model_copy(update={"coasting": Coasting()})
        law = coasting_of(coasts)
        drive(coasts, law)
        rows[f"coast {train}, 102 km"] = best_of(times, lambda j=coasts, w=law: drive(j, w))
    trip = rg.load("dry_emergency").with_(TRIP)
    drive_trip(trip)
    rows["trip emu_four_car, 100 km"] = best_of(3, lambda: drive_trip(trip))
    for train, line, share in BEST:
        journey = Journey(train=train, line=line, supplement=share)
        optimum(journey)
        name = f"optimum {train}, {line}, +{share:.1%}"
        rows[name] = best_of(times, lambda j=journey: optimum(j))
    demands = {
        "drive": "under 20 ms", "coast": "under 20 ms", "trip": "under 2000 ms",
        "optimum": "under 300 ms",
    }  # fmt: skip
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
