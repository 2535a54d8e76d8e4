"""Temperature-controlled adhesion: does it keep its limit, and what is that worth?

Judged by the plant's own flash temperature above 3 m/s, on the four-car unit without sanders, with
electro-mechanical brakes ("continuous") or cylinders behind dump valves ("valves"). "Known speed"
means that the last axle is not braked and so shows the train's speed; otherwise the ordinary
reference speed serves.

    python studies/temperature_control.py [--quick] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import math
import platform
from pathlib import Path
from typing import Any, Final

import numpy as np

import railgrip as rg

TUNING_SEED: Final = 11
SEED: Final = 2026
FIELDS: Final = 200
QUICK_FIELDS: Final = 25
CHUNK: Final = 25
"""Fields that run side by side with their traces; each chunk has the next seed."""
LIMIT: Final = 200.0  # K
JUDGED_ABOVE: Final = 3.0  # m/s: at 1.4 m/s the slide protection ends, and wheels may stand
SET_POINTS: Final = (0.65, 0.60, 0.55, 0.50, 0.45, 0.40, 0.35, 0.30, 0.25, 0.20)
CHOSEN_BELOW: Final = 0.90
"""Greatest rise over the limit on the tuning seeds with which a set point is chosen."""
UNIFORM_SET_POINT: Final = 0.975
VALVE_SET_POINT: Final = 0.90
TRAINS: Final = {"continuous": "emu_four_car_emb", "valves": "emu_four_car"}
BANDS: Final = {"3-6 %": (0.03, 0.06), "8-16 %": (0.08, 0.16), "5-20 %": (0.05, 0.20)}
TEMPERATURE: Final = "temperature_controlled"


def train(name: str, *, known_speed: bool = False) -> dict[str, Any]:
    """Return a shipped train without sanders, if wanted with an unbraked last axle."""
    table: dict[str, Any] = rg.load("leaves_160").with_({"train": name}).train.model_dump()
    table["sander"] = None
    for vehicle in table["vehicle"]:
        for bogie in vehicle["bogie"]:
            for axle in bogie["axle"]:
                axle["sander"] = False
    if known_speed:
        last = table["vehicle"][-1]["bogie"][-1]["axle"][-1]
        last["brake"], last["motor"] = None, False
    return table


def rail(adhesion: float, *, falling: bool) -> dict[str, Any]:
    """Return a rail that sliding does not change, with or without friction falling with slip."""
    ratio, decay = (0.4, 0.2) if falling else (1.0, 0.0)
    state = {
        "static_friction": adhesion, "friction_ratio": ratio, "friction_decay": decay,
        "adhesion_reduction": 1.0, "slip_reduction": 0.4,
    }  # fmt: skip
    return {"contaminated": state, "clean": state, "cleaning": 0.0}


def scenario(
    kind: str, condition: Any, *, known_speed: bool = False, **changes: Any
) -> rg.Scenario:
    """Return an emergency stop from 160 km/h with a trace at every tick."""
    return (
        rg.load("leaves_160")
        .with_({"rail": {"condition": condition}})
        .with_(
            {
                "train": train(TRAINS[kind], known_speed=known_speed),
                "run.trace": 0.01,
                "run.time_limit": "500 s",
                "wsp": {"controller": TEMPERATURE},
                **changes,
            }
        )
    )


def under(stop: rg.Scenario, name: str, **parameters: float) -> rg.Scenario:
    """Return the same stop under another controller."""
    return stop.with_({"wsp": {"controller": name, "parameters": parameters}})


def rises(result: rg.Result) -> np.ndarray:
    """Return flash temperatures over the limit, [run, axle, time]; NaN below the judged speed."""
    fast = result["train_speed"].values > JUDGED_ABOVE
    return np.where(fast[:, None, :], result["flash_temperature"].values, np.nan) / LIMIT


def uniform() -> dict[str, Any]:
    """Return how far the limit is used on uniform rail with known ground speed."""
    found = {}
    rails = {
        "0.06 constant": rail(0.06, falling=False),
        "0.08 falling": rail(0.08, falling=True),
        "0.10 falling": rail(0.10, falling=True),
    }
    for kind, aim in (("continuous", UNIFORM_SET_POINT), ("valves", VALVE_SET_POINT)):
        for name, condition in rails.items():
            stop = scenario(kind, condition, known_speed=True)
            result = rg.simulate(under(stop, TEMPERATURE, set_point=aim))
            rise = rises(result)[0, :-1]
            built = (result["time"].values > 6.0) & (result["train_speed"].values[0] > 7.0)
            means = np.nanmean(rise[:, built], axis=1)
            found[f"{kind}, {name}"] = {
                "set_point": aim,
                "greatest": _round(np.nanmax(rise)),
                "mean": _round(means.mean()),
                "mean_of_the_hottest_axle": _round(means.max()),
                "distance": _round(result["stopping_distance"].values[0], 1),
            }
    return found


def step_of_adhesion() -> dict[str, Any]:
    """Return how long and how far the limit is passed when adhesion triples."""
    found = {}
    place = 1500.0
    way = {"run.speed": "140 km/h", "line": {"use": "level", "start": 600.0}}
    better = {"from": f"{place} m", "to": "90 km", "condition": rail(0.15, falling=False)}
    for kind, aim in (("continuous", 0.95), ("valves", VALVE_SET_POINT)):
        stop = scenario(kind, rail(0.05, falling=False), known_speed=True, **way)
        stop = stop.with_({"rail.patch": [better]})
        result = rg.simulate(under(stop, TEMPERATURE, set_point=aim))
        rise = rises(result)[0]
        front = result["train_position"].values[0]
        times, peaks = [], []
        for axle, at in enumerate(result.scenario.train.axles()[:-1]):
            enters = int(np.argmax(front - at.behind_front >= place))
            after = rise[axle, enters : enters + 100]
            times.append(0.01 * (1 + np.flatnonzero(after > 1.0).max(initial=-1)))
            peaks.append(float(np.nanmax(after)))
        found[kind] = {
            "set_point": aim,
            "longest": _round(max(times), 2),
            "median": _round(float(np.median(times)), 2),
            "greatest": _round(max(peaks)),
        }
    return found


def random_stops(stop: rg.Scenario, seed: int, fields: int) -> dict[str, np.ndarray]:
    """Return what many random fields give: arrays over fields."""
    parts: list[dict[str, np.ndarray]] = []
    for i in range(fields // CHUNK):
        result = rg.simulate(stop.with_({"rail.random.seed": seed + i}), runs=CHUNK, traces=True)
        distance = result["stopping_distance"].values
        if np.isnan(distance).any():
            raise SystemExit(f"{np.isnan(distance).sum()} trains did not stop")
        parts.append(
            {
                "distance": distance,
                "greatest": np.nanmax(rises(result), axis=(1, 2)),
                "energy": result["axle_slid_energy"].values.sum(axis=1),
                "lock": result["axle_longest_fast_lock"].values.max(axis=1),
                "air": result["air_used"].values,
            }
        )
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def random_field(mean: float, spread: float) -> dict[str, Any]:
    """Return a lognormal field over the rail."""
    return {"rail.random": {"mean": mean, "spread": spread, "correlation_length": "100 m"}}


def random_rail(fields: int) -> dict[str, Any]:
    """Choose a set point on one set of seeds, judge it on another."""
    found = {}
    for name, kind, known in (
        ("continuous, known speed", "continuous", True),
        ("continuous", "continuous", False),
        ("valves", "valves", False),
    ):
        stop = scenario(kind, "low", known_speed=known, **random_field(0.07, 0.02))
        tried: dict[float, float] = {}
        for aim in SET_POINTS:
            one = under(stop, TEMPERATURE, set_point=aim)
            tried[aim] = float(random_stops(one, TUNING_SEED, fields)["greatest"].max())
            if tried[aim] <= CHOSEN_BELOW:
                break
        judged = random_stops(under(stop, TEMPERATURE, set_point=aim), SEED, fields)
        found[name] = {
            "set_point": aim,
            "greatest_when_chosen": {f"{a:g}": _round(g) for a, g in tried.items()},
            "greatest": _round(judged["greatest"].max()),
            "median_greatest": _round(float(np.median(judged["greatest"]))),
            "fields_over": int((judged["greatest"] > 1.0).sum()),
            "distance": _round(judged["distance"].mean(), 1),
        }
        print(name, found[name], flush=True)
    return found


def comparison(fields: int, set_points: dict[str, float], kinds: tuple[str, ...]) -> dict[str, Any]:
    """Temperature control against the ordinary protection in three bands, on two rails."""
    table: dict[str, Any] = {}
    for kind in kinds:
        for condition in ("water_detergent", "leaves"):
            plain = scenario(kind, condition)
            mean = plain.rail.condition.contaminated.static_friction
            stop = plain.with_(random_field(mean, 0.3 * mean))
            strategies = {
                f"temperature, set point {aim:g}": under(stop, TEMPERATURE, set_point=aim)
                for aim in (set_points[kind], 0.95)
            }
            for name, (low, high) in BANDS.items():
                band = {"slip_lower": low, "slip_upper": high}
                strategies[f"conventional {name}"] = under(stop, "conventional", **band)
            for name, one in strategies.items():
                row = _summary(random_stops(one, SEED, fields))
                table.setdefault(kind, {}).setdefault(condition, {})[name] = row
                print(kind, condition, name, row, flush=True)
    return table


def _summary(stops: dict[str, np.ndarray]) -> dict[str, float]:
    return {
        "distance": _round(stops["distance"].mean(), 1),
        "distance_spread": _round(stops["distance"].std(ddof=1), 1),
        "greatest_rise": _round(stops["greatest"].mean() * LIMIT, 0),
        "greatest_rise_of_all": _round(stops["greatest"].max() * LIMIT, 0),
        "slid_energy": _round(stops["energy"].mean() / 1e6, 2),
        "longest_lock": _round(stops["lock"].max(), 2),
        "air": _round(stops["air"].mean(), 3),
    }


def emergency_step() -> dict[str, Any]:
    """Return what it gives when an emergency may use twice the rise."""
    found = {}
    limits = {"emergency_factor": 2.0, "rise_wheel": 150.0, "rise_rail": 150.0}
    stop = under(scenario("continuous", "water_detergent"), TEMPERATURE, **limits)
    for demand in ("service", "emergency"):
        result = rg.simulate(stop.with_({"run.demand": demand}))
        found[demand] = {
            "greatest_rise": _round(np.nanmax(rises(result)) * LIMIT, 0),
            "slid_energy": _round(float(result["axle_slid_energy"].values.sum()) / 1e6, 2),
            "distance": _round(result["stopping_distance"].values[0], 1),
        }
    return found


def two_laws() -> dict[str, Any]:
    """Return the rise under the linear law over that under the physical one, at some speeds.

    At a small slip, because the linear law reckons with the slower wheel alone.
    """
    stop = scenario("continuous", rail(0.08, falling=False), known_speed=True)
    course = {}
    for name, law in (("physical", 0.0), ("linear", 1.0)):
        one = under(stop, TEMPERATURE, heat_law=law, rise_wheel=60.0, rise_rail=60.0)
        result = rg.simulate(one)
        course[name] = (result["train_speed"].values[0], result["flash_temperature"].values[0, 6])
    found = {}
    for speed in (10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0):
        ratio = _at(*course["linear"], speed) / _at(*course["physical"], speed)
        found[f"{speed:g}"] = {"ratio": _round(ratio), "expected": _round(math.sqrt(speed / 20.0))}
    return found


def _at(train_speed: np.ndarray, rise: np.ndarray, speed: float) -> float:
    return float(np.nanmean(rise[np.abs(train_speed - speed) < 0.4]))


def _round(value: float, digits: int = 3) -> float:
    return round(float(value), digits)


def markdown(found: dict[str, Any]) -> str:
    """Return the comparison as tables."""
    lines = []
    for kind, rails in found["comparison"].items():
        for condition, rows in rails.items():
            lines += [
                f"{kind}, {condition}, 160 km/h, {found['fields']} random fields:",
                "",
                "| controller | distance m | greatest rise K, mean (of all) | slid energy MJ |",
                "|---|---|---|---|",
            ]
            lines += [
                f"| {name} | {row['distance']:.0f} ± {row['distance_spread']:.0f} | "
                f"{row['greatest_rise']:.0f} ({row['greatest_rise_of_all']:.0f}) | "
                f"{row['slid_energy']:.1f} |"
                for name, row in rows.items()
            ]
            lines.append("")
    return "\n".join(lines)


def main() -> None:
    """Run the study, print what it finds and write it where --out says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="few fields, no choice of set points")
    parser.add_argument("--out", type=Path, help="folder for the results")
    chosen = parser.parse_args()
    fields = QUICK_FIELDS if chosen.quick else FIELDS
    found: dict[str, Any] = {
        "command": "python studies/temperature_control.py" + (" --quick" if chosen.quick else ""),
        "seed": SEED,
        "tuning_seed": TUNING_SEED,
        "fields": fields,
        "limit": LIMIT,
        "railgrip": rg.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}",
        "uniform": uniform(),
        "step": step_of_adhesion(),
        "emergency": emergency_step(),
        "two_laws": two_laws(),
    }
    print(json.dumps(found, indent=1), flush=True)
    points = {"continuous": 0.45, "valves": 0.35}
    if not chosen.quick:
        found["random"] = random_rail(fields)
        points = {kind: found["random"][kind]["set_point"] for kind in TRAINS}
    kinds = ("continuous",) if chosen.quick else tuple(TRAINS)
    found["comparison"] = comparison(fields, points, kinds)
    if chosen.out is None:
        return
    chosen.out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(found, indent=1) + "\n"
    (chosen.out / "temperature_control.json").write_text(text, encoding="utf-8")
    (chosen.out / "temperature_control.md").write_text(markdown(found), encoding="utf-8")


if __name__ == "__main__":
    main()
