"""What the adaptive supervisor gives back to temperature control on leaves, and what it costs.

Emergency stops from 160 km/h of the four-car unit without sanders, random rail, with
electro-mechanical brakes ("continuous") or cylinders behind dump valves ("valves"). Set points and
rails are those of studies/temperature_control.py.

    python studies/temperature_adaptive.py [--quick] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import platform
from pathlib import Path
from typing import Any, Final

import railgrip as rg

SEED: Final = 2026
FIELDS: Final = 100
QUICK_FIELDS: Final = 8
TRAINS: Final = {"continuous": "emu_four_car_emb", "valves": "emu_four_car"}
SET_POINTS: Final = {"continuous": 0.5, "valves": 0.35}
CONDITIONS: Final = ("water_detergent", "leaves")
CONTROLLERS: Final = ("temperature_controlled", "temperature_adaptive", "adaptive", "micro_slip")


def stop(kind: str, condition: str, controller: str) -> rg.Scenario:
    """Return the stops of one controller."""
    scenario = rg.load("leaves_160").with_({"train": TRAINS[kind]})
    table = scenario.train.model_dump(by_alias=True)
    table["sander"] = None
    for axle in (a for v in table["vehicle"] for b in v["bogie"] for a in b["axle"]):
        axle["sander"] = False
    described = scenario.with_({"rail": {"condition": condition}}).rail.condition
    level = described.contaminated.static_friction
    random = {"mean": level, "spread": 0.3 * level, "correlation_length": "100 m", "seed": SEED}
    parameters: dict[str, float] = {}
    if controller.startswith("temperature"):
        parameters["set_point"] = SET_POINTS[kind]
    return scenario.with_(
        {
            "train": table,
            "rail": {"condition": condition, "random": random},
            "run.time_limit": "500 s",
            "wsp": {"controller": controller, "parameters": parameters},
        }
    )


def row(kind: str, condition: str, controller: str, fields: int) -> dict[str, float]:
    """Return distance, greatest rise and slid energy over the fields."""
    data = rg.simulate(stop(kind, condition, controller), runs=fields, traces=False).data
    distance = data["stopping_distance"].values
    rise = data["axle_greatest_flash"].values.max(axis=1)
    return {
        "distance": round(float(distance.mean()), 1),
        "distance_spread": round(float(distance.std(ddof=1)), 1),
        "rise": round(float(rise.mean()), 1),
        "slid_energy": round(float(data["axle_slid_energy"].values.sum(axis=1).mean()) / 1e6, 2),
    }


def study(fields: int) -> dict[str, Any]:
    """Return every row: kind, condition → controller."""
    table: dict[str, Any] = {}
    for kind in TRAINS:
        for condition in CONDITIONS:
            name = f"{kind}, {condition}"
            table[name] = {c: row(kind, condition, c, fields) for c in CONTROLLERS}
            print(name, {c: one["distance"] for c, one in table[name].items()}, flush=True)
    return table


def markdown(table: dict[str, Any], fields: int) -> str:
    """Return the table of the documentation."""
    lines = [
        f"160 km/h, {fields} random fields; distance in m, mean of the greatest rise in K (at any",
        "speed), slid energy in MJ.",
        "",
        f"| brakes, rail | {' | '.join(CONTROLLERS)} |",
        "|---" * (len(CONTROLLERS) + 1) + "|",
    ]
    for name, rows in table.items():
        cells = [
            f"{one['distance']:.0f} ± {one['distance_spread']:.0f}, {one['rise']:.0f},"
            f" {one['slid_energy']:.1f}"
            for one in (rows[c] for c in CONTROLLERS)
        ]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Run the study, print what it finds and write it where --out says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="fewer random fields")
    parser.add_argument("--out", type=Path, help="folder for the results")
    chosen = parser.parse_args()
    fields = QUICK_FIELDS if chosen.quick else FIELDS
    table = study(fields)
    print(markdown(table, fields))
    if chosen.out is None:
        return
    result = {
        "command": f"python studies/temperature_adaptive.py{' --quick' * chosen.quick}",
        "seed": SEED,
        "fields": fields,
        "railgrip": rg.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}",
        "stops": table,
    }
    chosen.out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(result, indent=1, ensure_ascii=False) + "\n"
    (chosen.out / "temperature_adaptive.json").write_text(text, encoding="utf-8")
    (chosen.out / "temperature_adaptive.md").write_text(markdown(table, fields), encoding="utf-8")


if __name__ == "__main__":
    main()
