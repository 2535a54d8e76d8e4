"""The optimum of every leg of the shipped TTOBench lines with every train, at many times.

    python studies/optimum/every_line.py

writes `every_line.csv` beside this script: energies, seconds off the asked time, and a column that
says whether the run was found by Newton's method itself. No random numbers.
"""

from __future__ import annotations

import csv
from itertools import pairwise
from pathlib import Path

import numpy as np

from railgrip import __version__, data
from railgrip.campaign.optimum.leg import LegProblem
from railgrip.core.errors import RailgripError
from railgrip.scenario.journey import Journey

TRAINS = ("flirt_tpf", "kiss_sbb", "beijing_subway", "virm6")
SHARES = (1e-6, 1e-5, 1e-4, 1e-3, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)
HERE = Path(__file__).parent


def lines() -> list[str]:
    """Return the lines of TTOBench."""
    return [name for name in data.names("lines") if data.path("lines", name).suffix == ".json"]


def main() -> None:
    """Solve all and write the table."""
    rows = []
    for train in TRAINS:
        for line in lines():
            journey = Journey(train=train, line=line)
            for here, there in pairwise(journey.stops()[:5]):
                try:
                    leg = LegProblem(journey, here.at, there.at, 0.0, 0.0)
                except RailgripError as error:
                    rows.append([train, line, here.at, there.at, "", "", str(error), "", ""])
                    continue
                for share in SHARES:
                    time = leg.least_time * (1 + share)
                    run = leg.for_time(time)
                    off = leg.time_of(run.square) - time
                    price = "" if np.isnan(run.price) else f"{run.price:.0f}"
                    energy = leg.energy_of(run) / 3.6e6
                    rows.append([
                        train, line, here.at, there.at, f"{leg.least_time:.4f}", share,
                        f"{energy:.4f}", f"{off:.1e}", price,
                    ])  # fmt: skip
            print(train, line, len(rows), flush=True)
    with (HERE / "every_line.csv").open("w", encoding="utf-8", newline="") as file:
        file.write(f"# railgrip {__version__}, python studies/optimum/every_line.py, no seed\n")
        table = csv.writer(file)
        table.writerow(["train", "line", "from", "to", "least_time", "share", "energy_kwh",
                        "seconds_off", "price_w"])  # fmt: skip
        table.writerows(rows)


if __name__ == "__main__":
    main()
