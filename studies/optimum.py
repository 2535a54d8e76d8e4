"""The optimum of every leg of the shipped TTOBench lines with every train, at many times.

    python studies/optimum.py --out studies/results

writes `optimum.csv`: least time, energy, seconds off the asked time, price of time. There are no
random numbers.
"""

from __future__ import annotations

import argparse
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


def lines() -> list[str]:
    """Return the lines of TTOBench."""
    return [name for name in data.names("lines") if data.path("lines", name).suffix == ".json"]


def main() -> None:
    """Solve all and write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("studies/results"), help="folder")
    folder = parser.parse_args().out
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
    with (folder / "optimum.csv").open("w", encoding="utf-8", newline="") as file:
        file.write(f"# railgrip {__version__}, python studies/optimum.py, no seed\n")
        table = csv.writer(file)
        table.writerow(["train", "line", "from", "to", "least_time", "share", "energy_kwh",
                        "seconds_off", "price_w"])  # fmt: skip
        table.writerows(rows)


if __name__ == "__main__":
    main()
