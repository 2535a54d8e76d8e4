"""How surely does a train brake with friction estimation and deceleration control, and without?

The shipped safety case `emu_brake_control`: K_dry_rst at EBCL 0 to 9 from 80 and 160 km/h, stepped
in time, with both, with each alone, and with neither; and what the levels mean in metres. The brake
control itself fails in one stop of nine thousand.

    python studies/safety_brake_control.py [--runs N] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import platform
from pathlib import Path
from typing import Any, Final

import railgrip
from railgrip.campaign.rare.levels import EBCL
from railgrip.campaign.safety.case import SafetyCase, find_case, read_safety_case
from railgrip.campaign.safety.factors import safety_factors
from railgrip.campaign.safety.safe_braking import as_table, warnings

ROOT = Path(__file__).resolve().parents[1]
RUNS: Final = 6000
WAYS: Final[dict[str, dict[str, Any]]] = {
    "estimator": {"deceleration": None},
    "controller": {"estimator": None},
    "both": {},
}


def case_of(way: str, runs: int) -> SafetyCase:
    """Return the shipped case with one way of braking, or without control."""
    case = read_safety_case(find_case("emu_brake_control")).model_copy(update={"runs": runs})
    if way == "constant":
        return case.without_control()
    assert case.brake_control is not None
    return case.model_copy(
        update={"brake_control": case.brake_control.model_copy(update=WAYS[way])}
    )


def study(runs: int, threads: int) -> dict[str, Any]:
    """Return the rows of each way of braking."""
    table: dict[str, Any] = {}
    for way in (*WAYS, "constant"):
        found = safety_factors(case_of(way, runs), threads=threads, progress=print, without=False)
        table[way] = {
            "rows": as_table(found),
            "warnings": warnings(found),
            "runs": [step.dry.runs for step in found.steps],
            "nominal": [step.distance for step in found.steps],
        }
    return table


def report(table: dict[str, Any]) -> str:
    """Return the tables in Markdown."""
    lines = []
    speeds = sorted({row["speed"] for row in table["both"]["rows"]})
    ways = ("constant", *WAYS)
    for speed in speeds:
        lines += [
            f"From {speed * 3.6:.0f} km/h: K_dry_rst (95 % interval), and the safe stop, m", "",
            "| | " + " | ".join(ways) + " | " + " | ".join(f"{way}, m" for way in ways) + " |",
            "|---|" + "---|" * (2 * len(ways)),
        ]  # fmt: skip
        for level in EBCL:
            cells, stops = [], []
            for way in ways:
                row = next(r for r in table[way]["rows"] if r["speed"] == speed
                           and r["ebcl"] == level)  # fmt: skip
                cells.append(f"{row['k_dry']:.4f} ({row['k_dry_low']:.4f} … "
                             f"{row['k_dry_high']:.4f})")  # fmt: skip
                stops.append(f"{row['stopping_distance_safe']:.0f}")
            lines.append(f"| EBCL {level} | " + " | ".join([*cells, *stops]) + " |")
        lines.append("")
    return "\n".join(lines)


def main() -> None:
    """Study, print, and keep the results."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--runs", type=int, default=RUNS, help="of the final sample, each way")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--out", type=Path, default=ROOT / "studies/results")
    chosen = parser.parse_args()
    table = study(chosen.runs, chosen.threads)
    text = report(table)
    print(text)
    content = {
        "command": f"python studies/safety_brake_control.py --runs {chosen.runs}",
        "version": railgrip.__version__, "seed": 1, "runs": chosen.runs,
        "machine": platform.machine(), "ways": table,
    }  # fmt: skip
    chosen.out.mkdir(parents=True, exist_ok=True)
    (chosen.out / "safety_brake_control.json").write_text(
        json.dumps(content, indent=1) + "\n", encoding="utf-8"
    )
    (chosen.out / "safety_brake_control.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
