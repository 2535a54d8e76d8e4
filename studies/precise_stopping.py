"""Stopping at a place: constant friction, friction estimate, deceleration control and both.

500 stops of the four-car unit from 80 km/h, with the draws of `friction_estimation.py`. The brakes
are applied 320 m before the place, and what is asked of them is v²/2s all the way; the train knows
its position exactly, so that what is left is the brakes' own error. Below 0.4 m/s the last
deceleration is kept.

    python studies/precise_stopping.py [--quick] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import platform
from pathlib import Path
from typing import Any, Final

import numpy as np
from friction_estimation import SEED, WAYS, draws, scenario

import railgrip as rg

STOPS: Final = 500
QUICK_STOPS: Final = 96
PLACE, AHEAD = 1000.0, 320.0  # m


def stops_of(way: str, stops: int) -> dict[str, float]:
    """Return mean, standard deviation and greatest amount of the error of place [m]."""
    base = scenario(80, "service", way, 1.3)
    assert base.brake_control is not None
    layer = {**base.brake_control.model_dump(by_alias=True), "stop_at": PLACE}
    varied = draws(stops, "as drawn") | {"START_POSITION": np.full(stops, PLACE - AHEAD)}
    data = rg.simulate(base.with_({"brake_control": layer}), runs=stops, variations=varied).data
    error = data["stopping_distance"].values - AHEAD
    if not np.isfinite(error).all():
        raise SystemExit(f"{way}: {np.isnan(error).sum()} trains did not stop")
    return {
        "mean": float(error.mean()),
        "spread": float(error.std(ddof=1)),
        "greatest": float(np.abs(error - error.mean()).max()),
    }


def study(stops: int) -> dict[str, dict[str, float]]:
    """Return the errors of every way of braking."""
    table = {}
    for way in WAYS:
        table[way] = stops_of(way, stops)
        numbers = ", ".join(f"{name} {value:.3f} m" for name, value in table[way].items())
        print(f"{way}: {numbers}", flush=True)
    return table


def markdown(table: dict[str, dict[str, float]]) -> str:
    """Return the errors as a table."""
    lines = [
        "Place of the stop less the place wanted, m; the greatest deviation is from the mean.",
        "",
        "| way | mean | standard deviation | greatest deviation |",
        "|---|---|---|---|",
    ]
    for way, c in table.items():
        lines.append(f"| {way} | {c['mean']:+.3f} | {c['spread']:.3f} | {c['greatest']:.3f} |")
    return "\n".join([*lines, ""])


def main() -> None:
    """Run the study, print what it finds and write it where --out says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="few stops")
    parser.add_argument("--out", type=Path, help="folder for the results")
    chosen = parser.parse_args()
    stops = QUICK_STOPS if chosen.quick else STOPS
    table = study(stops)
    if chosen.out is None:
        return
    result: dict[str, Any] = {
        "command": "python studies/precise_stopping.py",
        "seed": SEED,
        "stops": stops,
        "railgrip": rg.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}",
        "error": table,
    }
    chosen.out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(result, indent=1) + "\n"
    (chosen.out / "precise_stopping.json").write_text(text, encoding="utf-8")
    (chosen.out / "precise_stopping.md").write_text(markdown(table), encoding="utf-8")


if __name__ == "__main__":
    main()
