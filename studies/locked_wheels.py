"""Does any wheel lock? Every braking controller over low, changing and random rail.

Rails, chosen before the comparison, none with less adhesion than 0.02: constant 0.02, 0.03, 0.05,
0.08 and 0.15; steps between 0.03 and 0.15 every 50 to 100 m; lognormal random fields (mean 0.05,
spread 30 %, correlation 100 m); a run that meets less than 0.02 somewhere is left out. "Adhesion"
is the friction without slip; it falls with slip, to 0.4 of it, with a decay of 0.2 s/m.
Speeds 60, 100, 140, 160 km/h; valves nominal, and slow: every delay and time at the slow end of the
usual range. Four-car unit, emergency brake, no sanders (sand would hide what the controller does).

A wheel is locked below 5 % of the train's speed; it counts above 30 km/h and for longer than 0.4 s.

    python studies/locked_wheels.py [--quick] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import platform
from pathlib import Path
from typing import Any, Final

import numpy as np

import railgrip as rg
from railgrip.core.status import RunStatus

CONTROLLERS: Final = (
    "conventional", "macro_slip", "micro_slip", "mixed_slip", "adaptive", "temperature_controlled",
)  # fmt: skip
SEED: Final = 2026
FIELDS: Final = 24
QUICK_FIELDS: Final = 8
SPEEDS: Final = (60, 100, 140, 160)
QUICK_SPEEDS: Final = (100,)
CONSTANT: Final = (0.02, 0.03, 0.05, 0.08, 0.15)
LEAST: Final = 0.02
LOCK_LIMIT: Final = 0.4  # s
COUNTS_ABOVE: Final = 30.0 / 3.6  # m/s
LINE: Final = 14.0e3  # m
SLOW: Final = {
    "train.dump_valve.vent_delay": "120 ms",
    "train.dump_valve.fill_delay": "120 ms",
    "train.dump_valve.vent_time": "1.2 s",
    "train.dump_valve.fill_time_valve": "2.0 s",
}
"""Slow end of the usual, unverified ranges: 30 to 120 ms, 0.4 to 1.2 s, 0.6 to 2 s."""
VALVES: Final[dict[str, dict[str, str]]] = {"nominal": {}, "slow": SLOW}


def condition(friction: float) -> dict[str, Any]:
    """Return a rail condition that stays as it is, whatever slides over it."""
    return {
        "title": f"adhesion {friction:g}",
        "contaminated": {"static_friction": friction, "friction_ratio": 0.4, "friction_decay": 0.2},
    }


def rails() -> dict[str, dict[str, Any]]:
    """Return every rail: constant, steps, random."""
    found: dict[str, dict[str, Any]] = {f"{mu:g}": {"condition": condition(mu)} for mu in CONSTANT}
    generator = np.random.default_rng(SEED)
    place, patch = 0.0, []
    while place < LINE:
        end = place + float(generator.uniform(50.0, 100.0))
        mu = (0.03, 0.15)[len(patch) % 2]
        patch.append({"from": f"{place} m", "to": f"{end} m", "condition": condition(mu)})
        place = end
    found["steps 0.03-0.15"] = {"condition": condition(0.03), "patch": patch}
    found["random"] = {
        "condition": condition(0.05),
        "random": {"mean": 0.05, "spread": 0.015, "correlation_length": "100 m", "seed": SEED},
    }
    return found


def stop(rail: dict[str, Any], speed: int, valves: str, controller: str) -> rg.Scenario:
    """Return one stop of the study."""
    scenario = rg.load("leaves_160").with_(
        {
            "rail": rail,
            "line": {"use": "level", "start": 1000.0},
            "run.speed": f"{speed} km/h",
            "run.time_limit": "900 s",
            "run.trace": "50 ms",
            "wsp": {"controller": controller, "parameters": {}},
            **VALVES[valves],
        }
    )
    train = scenario.train.model_dump(by_alias=True)
    for axle in (a for v in train["vehicle"] for b in v["bogie"] for a in b["axle"]):
        axle["sander"] = False
    train["sander"] = None
    return scenario.with_({"train": train})


def cell(rail: str, speed: int, valves: str, controller: str, fields: int) -> dict[str, Any]:
    """Return the longest fast lock of any wheel, how long any slid deeper than half, the distance.

    "deep" is the time in which at least one wheel had a slip above 0.5 while the train ran faster
    than 30 km/h, in the worst run, s; "distance" is the mean over the runs, m.
    """
    runs = fields if rail == "random" else 1
    result = rg.simulate(stop(rails()[rail], speed, valves, controller), runs=runs, traces=True)
    if not (result["status"].values == int(RunStatus.STOPPED)).all():
        raise SystemExit(f"{rail}, {speed} km/h, {valves}, {controller}: a train did not stop")
    train = result["train_speed"].values[:, None, :]
    with np.errstate(invalid="ignore"):
        deep = (result["wheel_speed"].values < 0.5 * train) & (train > COUNTS_ABOVE)
    time = result["time"].values
    lowest = np.nanmin(result["rail_friction"].values, axis=(1, 2))
    counts = lowest >= LEAST if rail == "random" else np.full(runs, True)
    lock = result["axle_longest_fast_lock"].values.max(axis=1)[counts]
    return {
        "lock": round(float(lock.max()), 3),
        "locked_runs": int((lock > LOCK_LIMIT).sum()),
        "runs": int(counts.sum()),
        "deep": round(float(deep.any(axis=1)[counts].sum(axis=1).max() * (time[1] - time[0])), 2),
        "distance": round(float(result["stopping_distance"].values[counts].mean()), 1),
    }


def study(
    controllers: tuple[str, ...], speeds: tuple[int, ...], fields: int, valves: tuple[str, ...]
) -> dict[str, Any]:
    """Return every cell: controller → valves → rail → speed."""
    table: dict[str, Any] = {}
    for controller in controllers:
        for valve in valves:
            for rail in rails():
                row = {str(v): cell(rail, v, valve, controller, fields) for v in speeds}
                table.setdefault(controller, {}).setdefault(valve, {})[rail] = row
                told = ", ".join(f"{v}: {c['lock']} s, deep {c['deep']} s" for v, c in row.items())
                print(f"{controller}, {valve}, {rail}: {told}", flush=True)
    return table


def judged(table: dict[str, Any]) -> list[str]:
    """Return a sentence for every cell in which a wheel was locked for too long."""
    return [
        f"{controller}, {valve} valves, {rail}, {speed} km/h: a wheel locked for {one['lock']:g} s"
        f" ({one['locked_runs']} of {one['runs']} runs)"
        for controller, valves in table.items()
        for valve, found in valves.items()
        for rail, row in found.items()
        for speed, one in row.items()
        if one["lock"] > LOCK_LIMIT
    ]


def markdown(table: dict[str, Any]) -> str:
    """Return the worst over the speeds: longest lock above 30 km/h, and time with a deep slip."""
    names = list(rails())
    lines = [
        "Longest lock above 30 km/h, worst speed of 60 to 160 km/h, s; in brackets the time in"
        " which any wheel had a slip above 0.5, worst run, s. (!) marks more than 0.4 s.",
        "",
        f"| controller | valves | {' | '.join(names)} |",
        "|---" * (len(names) + 2) + "|",
    ]
    for controller, valves in table.items():
        for valve, found in valves.items():
            cells = []
            for rail in names:
                lock = max(one["lock"] for one in found[rail].values())
                deep = max(one["deep"] for one in found[rail].values())
                cells.append(f"{lock:.2f} ({deep:.1f})" + (" (!)" if lock > LOCK_LIMIT else ""))
            lines.append(f"| {controller} | {valve} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Run the study, print what it finds and write it where --out says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="slow valves, one speed, few fields")
    parser.add_argument("--out", type=Path, help="folder for the results")
    chosen = parser.parse_args()
    if chosen.quick:
        table = study(CONTROLLERS, QUICK_SPEEDS, QUICK_FIELDS, ("slow",))
    else:
        table = study(CONTROLLERS, SPEEDS, FIELDS, tuple(VALVES))
    locked = judged(table)
    print("\n".join(locked) if locked else "no wheel locked for longer than 0.4 s")
    if chosen.out is None:
        return
    result = {
        "command": "python studies/locked_wheels.py" + (" --quick" if chosen.quick else ""),
        "seed": SEED,
        "fields": QUICK_FIELDS if chosen.quick else FIELDS,
        "railgrip": rg.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}",
        "locked": locked,
        "cells": table,
    }
    chosen.out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(result, indent=1) + "\n"
    (chosen.out / "locked_wheels.json").write_text(text, encoding="utf-8")
    if not chosen.quick:
        (chosen.out / "locked_wheels.md").write_text(markdown(table), encoding="utf-8")


if __name__ == "__main__":
    main()
