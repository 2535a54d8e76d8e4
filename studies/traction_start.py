"""Starts on slippery rail: distance covered in 60 s and share of the adhesion used, per controller.

The share is what the motored axles put on the rail over what the rail would have given, summed over
the time in which the driver asks for more than that (wheels that turn faster need some of it).
"Random" has a lognormal field over leaves.

    python studies/traction_start.py [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import platform
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

import railgrip as rg

SEED: Final = 2026
FIELDS: Final = 20
CONTROLLERS: Final[dict[str, dict[str, Any]]] = {
    "none": {},
    "conventional_traction": {},
    "peak_seeking_traction": {},
    "temperature_controlled": {},
    "always macro": {"start": 2.0, "decide_distance": 1e9},
    "adaptive_traction": {},
}
"""Column of the table → parameters; "always macro" is the adaptive control that never decides.

Always micro is the peak seeker itself.
"""


class Case(NamedTuple):
    """A start: train, rail, gradient, and whether a random field lies over the rail."""

    train: str
    rail: str
    gradient: float
    is_random: bool = False


CASES: Final = {
    "unit, leaves, 5 ‰": Case("emu_four_car", "leaves", 0.005),
    "unit, low, 5 ‰": Case("emu_four_car", "low", 0.005),
    "unit, water and detergent, 10 ‰": Case("emu_four_car", "water_detergent", 0.010),
    "unit, wet, 10 ‰": Case("emu_four_car", "wet", 0.010),
    "unit, random leaves, level": Case("emu_four_car", "leaves", 0.0, True),
    "locomotive, leaves, 10 ‰": Case("locomotive_bobo", "leaves", 0.010),
    "locomotive, oil, level": Case("locomotive_bobo", "oil", 0.0),
    "locomotive, wet, 10 ‰": Case("locomotive_bobo", "wet", 0.010),
    "locomotive, dry, level": Case("locomotive_bobo", "dry", 0.0),
}


def start(name: str) -> rg.Scenario:
    """Return the start of a case, of a train without sand."""
    case = CASES[name]
    scenario = rg.load("start_leaves").with_(
        {
            "train": case.train,
            "rail.condition": case.rail,
            "line.use": {"length": 15e3, "gradient": [{"at": 0.0, "value": case.gradient}]},
        }
    )
    if case.train == "locomotive_bobo":
        scenario = scenario.with_({"run.demand": "none"})
    train = scenario.train.model_dump(by_alias=True)
    for axle in (a for v in train["vehicle"] for b in v["bogie"] for a in b["axle"]):
        axle["sander"] = False
    train["sander"] = None
    changes: dict[str, Any] = {"train": train}
    if case.is_random:
        changes["rail.random"] = {
            "mean": 0.05, "spread": 0.015, "correlation_length": "20 m", "seed": SEED,
        }  # fmt: skip
    return scenario.with_(changes)


def share_used(result: rg.Result, after: float = 0.0) -> float:
    """Return the share of the available adhesion that is used where it bounds the effort."""
    train = result.scenario.train
    traction = train.traction
    assert traction is not None
    motored = np.array([place.axle.motor for place in train.axles()])
    late = result["time"].values >= after
    offered = (result["adhesion_available"] * result["wheel_load"]).values[:, motored][..., late]
    used = result["contact_force"].values[:, motored][..., late]
    speed = np.maximum(np.abs(result["train_speed"].values[:, late]), 0.1)
    asked = np.minimum(traction.force, traction.power / speed) / motored.sum()
    # a part of the effort only turns the wheels faster
    turning = np.array([place.axle.rotating_mass for place in train.axles()])[motored]
    gain = np.maximum(
        np.gradient(result["train_speed"].values, result["time"].values, axis=-1), 0.0
    )
    bounds = asked[:, None, :] - turning[:, None] * gain[:, None, late] > offered
    return float(used[bounds].sum() / offered[bounds].sum()) if bounds.any() else float("nan")


def row(name: str, controller: str, fields: int) -> dict[str, float | None]:
    """Return what one controller reaches in one case: means over the fields, greatest error."""
    wsp: dict[str, Any] = {
        "controller": "adaptive_traction" if controller == "always macro" else controller,
        "parameters": CONTROLLERS[controller],
    }
    chosen = start(name).with_({"wsp": wsp})
    if CASES[name].is_random:
        starts = [chosen.with_({"rail.random.seed": SEED + i}) for i in range(fields)]
    else:
        starts = [chosen]
    results = [rg.simulate(one) for one in starts]
    covered = np.array([float(result["covered_distance"].values[0]) for result in results])
    whole = float(np.mean([share_used(result) for result in results]))
    late = float(np.mean([share_used(result, after=5.0) for result in results]))
    return {
        "distance": float(covered.mean()),
        "distance_spread": float(covered.std(ddof=1)) if len(covered) > 1 else 0.0,
        "share": whole if np.isfinite(whole) else None,
        "share_after_5_s": late if np.isfinite(late) else None,
        "reference_error": max(reference_error(result) for result in results),
    }


def reference_error(result: rg.Result) -> float:
    """Return the greatest error of the reference speed from 5 s on, [m/s]."""
    error = (result["reference_speed"] - result["train_speed"]).values
    return float(np.abs(error[:, result["time"].values > 5.0]).max())


def study(fields: int, cases: tuple[str, ...] = tuple(CASES)) -> Any:
    """Return every row: case → controller."""
    table: dict[str, Any] = {}
    for name in cases:
        table[name] = {controller: row(name, controller, fields) for controller in CONTROLLERS}
        told = ", ".join(f"{who} {of['distance']:.0f} m" for who, of in table[name].items())
        print(f"{name}: {told}", flush=True)
    return table


def markdown(table: Any) -> str:
    """Return the table of the documentation."""
    lines = [
        "Distance in 60 s, and share of the available adhesion used from 5 s on while it bounds",
        "the effort (in brackets: from the start). No sand; random: mean ± spread of the fields.",
        "",
        f"| start | {' | '.join(CONTROLLERS)} |",
        "|---" * (len(CONTROLLERS) + 1) + "|",
    ]
    for name, rows in table.items():
        cells = " | ".join(_cell(rows[controller]) for controller in CONTROLLERS)
        lines.append(f"| {name} | {cells} |")
    return "\n".join(lines) + "\n"


def _cell(found: Any) -> str:
    spread = f" ± {found['distance_spread']:.0f}" if found["distance_spread"] else ""
    told = f"{found['distance']:.0f}{spread} m"
    if found["share"] is None:
        return f"{told}, not bounded"
    late = found["share_after_5_s"]
    return f"{told}, {'–' if late is None else f'{late:.1%}'} ({found['share']:.1%})"


def main() -> None:
    """Run the study, print what it finds and write it where --out says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--out", type=Path, help="folder for the results")
    chosen = parser.parse_args()
    table = study(FIELDS)
    print(markdown(table))
    if chosen.out is None:
        return
    result = {
        "command": "python studies/traction_start.py",
        "seed": SEED,
        "fields": FIELDS,
        "railgrip": rg.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}",
        "starts": table,
    }
    chosen.out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(result, indent=1, ensure_ascii=False) + "\n"
    (chosen.out / "traction_start.json").write_text(text, encoding="utf-8")
    (chosen.out / "traction_start.md").write_text(markdown(table), encoding="utf-8")


if __name__ == "__main__":
    main()
