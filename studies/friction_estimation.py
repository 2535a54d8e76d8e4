"""Constant friction, friction estimate, deceleration control and both, on random stops.

The four-car unit without its dynamic brake (friction is the subject), dry level rail (no wheel
slides, so no protection runs), emergency and 80 % service, from 160 and 80 km/h. Every run draws
pads, rigging, wheels, mass, disc temperatures and sensor errors; the same draws are used for every
way of braking (common random numbers). Three reserves of cylinder pressure; what is learned from
earlier stops; and three cases for themselves, with 500 stops: one bogie without brake, wet pads,
constant friction calibrated to the mean stop.

    python studies/friction_estimation.py [--quick] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import platform
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

import railgrip as rg
from railgrip.engine.simulate import nominal_numbers

SEED: Final = 2027
STOPS: Final = 2000
SPECIAL_STOPS: Final = 500  # of the cases after "learned"
QUICK_STOPS: Final = 96
SPEEDS: Final = (160, 80)
STEP, PERIOD = 0.02, 0.04  # s
DEMANDS: Final[dict[str, Any]] = {"emergency": "emergency", "service": 0.8}
RESERVES: Final = (1.0, 1.15, 1.3)
WAYS: Final[dict[str, dict[str, Any]]] = {
    "constant": {},
    "estimator": {"estimator": {}},
    "controller": {"deceleration": {}},
    "both": {"estimator": {}, "deceleration": {}},
}
"""Way of braking → tables of the scenario's brake control."""
CASES: Final = ("as drawn", "learned", "bogie failed", "wet pads", "calibrated")

PAD_COMMON, PAD_BOGIE = 0.03, 0.06  # usual: 3 to 5 % common, 5 to 8 % between units
RIGGING = 0.02 / 0.83  # per axle, of the efficiency
MASS = 0.02
RADIUS = (0.41, 0.44)  # m, each vehicle's wheels; the train is sized for 0.425 m
TEMPERATURE_OF_BOGIE = 15.0  # K, around the train's
SENSOR_SCALE, SENSOR_OFFSET = 0.005, 0.005  # of the deceleration sensor: 0.5 %, m/s²
SENSOR_KELVIN = 5.0  # of the disc temperature sensors
RESIDUAL = 0.02  # of what is learned of a bogie
WET = (0.8, 0.9)  # of the friction at the first wet stop

BOUNDS: Final = (
    ("as drawn", 160, "both", "distance", 0.30),
    ("as drawn", 80, "both", "distance", 0.30),
    ("as drawn", 160, "estimator", "distance", 0.80),
    ("as drawn", 160, "both", "effort", 0.55),
    ("learned", 160, "both", "effort", 0.50),
    ("learned", 160, "both", "adhesion", 0.45),
    ("learned", 160, "estimator", "distance", 0.45),
)
"""Case, speed, way, quantity, greatest ratio (reserve 1.3): of the distance and the adhesion to
constant friction as drawn, of the effort to the controller alone as drawn."""


def train() -> dict[str, Any]:
    """Return the train as a table, without dynamic brake."""
    table = rg.load("dry_emergency").train.model_dump(by_alias=True)
    return {**table, "dynamic_brake": None}


def scenario(speed: int, demand: str, way: str, reserve: float) -> rg.Scenario:
    """Return the stop from a speed [km/h] with a way of braking and a reserve of pressure."""
    return rg.load("dry_emergency").with_(
        {
            "train": train(),
            "run.speed": f"{speed} km/h",
            "run.step": STEP,
            "wsp.controller": "none",
            "run.demand": DEMANDS[demand],
            "brake_control": {"period": PERIOD, "pressure_reserve": reserve, **WAYS[way]},
        }
    )


def draws(stops: int, case: str) -> dict[Any, Any]:
    """Return what differs from stop to stop."""
    axles = rg.load("dry_emergency").train.axles()
    bogies = sorted({(a.vehicle, a.bogie) for a in axles})
    shape = (STOPS, len(bogies))
    generator = np.random.default_rng(SEED)
    common = generator.normal(1.0, PAD_COMMON, STOPS)
    of_bogie = generator.normal(1.0, PAD_BOGIE, shape)
    rigging = generator.normal(1.0, RIGGING, (STOPS, len(axles)))
    mass = generator.normal(1.0, MASS, STOPS)
    radius = generator.uniform(*RADIUS, (STOPS, 4))
    # mean 120 °C, 5 to 95 % from 40 to 210 °C
    hot = np.maximum(7.84 * generator.gamma(44.0, size=STOPS) - 225.0, 20.0)
    hot_bogie = np.maximum(hot[:, None] + generator.normal(0, TEMPERATURE_OF_BOGIE, shape), 20.0)
    residual = generator.normal(1.0, RESIDUAL, shape)
    wet = generator.uniform(*WET, STOPS)
    sensor = generator.normal(0.0, SENSOR_KELVIN, shape)
    found: dict[Any, Any] = {
        "DECELERATION_SCALE": generator.normal(1.0, SENSOR_SCALE, STOPS),
        "DECELERATION_OFFSET": generator.normal(0.0, SENSOR_OFFSET, STOPS),
    }
    nominal = nominal_numbers(scenario(160, "emergency", "constant", 1.0))
    found["TRAIN_MASS"] = mass * nominal["TRAIN_MASS"]
    failed = generator.integers(0, len(bogies), STOPS)
    for i, place in enumerate(axles):
        bogie = bogies.index((place.vehicle, place.bogie))
        pad = common * of_bogie[:, bogie] * (wet if case == "wet pads" else 1.0)
        own = radius[:, place.vehicle]
        ratio = place.axle.wheel_radius / own
        known = case == "learned"
        found["PAD_FACTOR", i] = pad
        found["CLAMP_PER_PRESSURE", i] = rigging[:, i] * nominal["CLAMP_PER_PRESSURE"][i]
        found["CLAMP_OFFSET", i] = rigging[:, i] * nominal["CLAMP_OFFSET"][i]
        found["STATIC_LOAD", i] = mass * nominal["STATIC_LOAD"][i]
        found["WHEEL_RADIUS", i] = own
        found["BELIEVED_RATIO", i] = np.ones(STOPS) if known else ratio
        found["TREAD_PER_CLAMP", i] = ratio * nominal["TREAD_PER_CLAMP"][i]
        found["RUBBING_RATIO", i] = ratio * nominal["RUBBING_RATIO"][i]
        found["START_TEMPERATURE", i] = hot_bogie[:, bogie]
        found["TEMPERATURE_ERROR", i] = sensor[:, bogie]
        if known:
            mates = [j for j, a in enumerate(axles) if (a.vehicle, a.bogie) == bogies[bogie]]
            strength = pad * rigging[:, mates].mean(axis=1)
            found["LEARNED_FRICTION", i] = strength * residual[:, bogie]
        if case == "bogie failed":
            sound = np.where(failed == bogie, 1e-3, 1.0)
            found["FULL_PRESSURE", i] = sound * nominal["FULL_PRESSURE"][i]
    return {name: np.asarray(values)[:stops] for name, values in found.items()}


def cell(
    speed: int, demand: str, way: str, *, reserve: float, case: str, stops: int
) -> dict[str, float]:
    """Return what a way of braking makes of the stops.

    `distance` and `deceleration` are standard deviations over the stops [m]; `effort` the mean
    correction; `adhesion` the mean over the stops of the standard deviation over the bogies, each
    over what it uses on a nominal train.
    """
    varied = draws(stops, case)
    if case == "calibrated":
        share = calibration(speed, demand)
        varied |= {("LEARNED_FRICTION", i): np.full(stops, share) for i in range(16)}
    chosen = scenario(speed, demand, way, reserve)
    data = rg.simulate(chosen, runs=stops, variations=varied, threads=2).data
    distance = data["stopping_distance"].values
    if not np.isfinite(distance).all():
        raise SystemExit(f"{chosen}: {np.isnan(distance).sum()} trains did not stop")
    nominal = rg.simulate(chosen, runs=1, traces=False).data["axle_mean_adhesion"].values[0]
    used = data["axle_mean_adhesion"].values / nominal
    of_bogie = used.reshape(stops, -1, 2).mean(axis=2)
    return {
        "mean": float(distance.mean()),
        "distance": float(distance.std(ddof=1)),
        "greatest": float(distance.max()),
        "deceleration": float(data["deceleration_distance"].values.std(ddof=1)),
        "effort": float(data["correction_effort"].values.mean()),
        "adhesion": float(of_bogie.std(axis=1, ddof=1).mean()),
    }


def calibration(speed: int, demand: str) -> float:
    """Return the friction of the mean stop of the duty over f0: force-weighted mean of the pads."""
    chosen = scenario(speed, demand, "constant", 1.3)
    data = rg.simulate(chosen, variations={"START_TEMPERATURE": [120.0]}).data
    work = data["clamp_force"].values[0] * data["wheel_speed"].values[0]
    friction = np.average(np.nan_to_num(data["pad_friction"].values[0]), weights=work)
    return float(friction) / 0.37


def wanted(full: bool) -> list[tuple[int, str, str, float, str]]:
    """Return every cell of the study: speed, demand, way, reserve, case."""
    speeds, demands = (SPEEDS, tuple(DEMANDS)) if full else ((160,), ("emergency",))
    # with constant friction no brake is asked for more than its full pressure
    pairs = [(1.3, way) for way in WAYS]
    pairs += [(r, way) for r in RESERVES[:2] if full for way in WAYS if way != "constant"]
    found = [(v, d, way, r, "as drawn") for v in speeds for d in demands for r, way in pairs]
    found += [(160, d, way, 1.3, "learned") for d in demands for way in ("estimator", "both")]
    if full:
        found += [(160, "emergency", way, 1.3, case) for case in CASES[2:4] for way in WAYS]
        # the estimator starts from f0, so it is not calibrated
        found += [(160, "emergency", way, 1.3, CASES[4]) for way in ("constant", "controller")]
    return found


def study(stops: int, full: bool) -> dict[str, Any]:
    """Return every cell: case → demand → speed → reserve → way."""
    table: dict[str, Any] = {}
    for speed, demand, way, reserve, case in wanted(full):
        number = min(stops, SPECIAL_STOPS) if case in CASES[2:] else stops
        found = cell(speed, demand, way, reserve=reserve, case=case, stops=number)
        row = table.setdefault(case, {}).setdefault(demand, {}).setdefault(str(speed), {})
        row.setdefault(f"{reserve:g}", {})[way] = found
        numbers = ", ".join(f"{name} {value:.4g}" for name, value in found.items())
        print(f"{case}, {demand}, {speed} km/h, reserve {reserve:g}, {way}: {numbers}", flush=True)
    return table


def ratio(table: Mapping[str, Any], demand: str, bound: tuple[str, int, str, str, float]) -> float:
    """Return a way's quantity over that of what it is compared with."""
    case, speed, way, quantity, _ = bound
    base = "controller" if quantity == "effort" else "constant"
    of_base = table["as drawn"][demand][str(speed)]["1.3"][base][quantity]
    return float(table[case][demand][str(speed)]["1.3"][way][quantity] / of_base)


def judged(table: Mapping[str, Any]) -> list[str]:
    """Return a sentence for every bound that is not met."""
    return [
        f"{demand}, {bound[0]}, {bound[1]} km/h: {bound[3]} of {bound[2]} is "
        f"{ratio(table, demand, bound):.2f}, allowed {bound[4]:.2f}"
        for demand in table["as drawn"]
        for bound in BOUNDS
        if ratio(table, demand, bound) > bound[4]
    ]


def markdown(table: Mapping[str, Any]) -> str:
    """Return bounds and cells as tables."""
    lines = ["Ratios at a pressure reserve of 1.3, with their bounds.", ""]
    demands = list(table["as drawn"])
    lines += [f"| case | km/h | way | quantity | bound | {' | '.join(demands)} |"]
    lines += ["|---" * (5 + len(demands)) + "|"]
    for bound in BOUNDS:
        cells = " | ".join(f"{ratio(table, demand, bound):.2f}" for demand in demands)
        case, speed, way, quantity, most = bound
        lines.append(f"| {case} | {speed} | {way} | {quantity} | {most:.2f} | {cells} |")
    lines += [
        "",
        "Every cell: mean, standard deviation and greatest of the stopping distance, standard "
        "deviation of the deceleration distance, m; effort, spread of adhesion over the bogies, %.",
        "",
        "| case | brake | km/h | reserve | way | mean | s.d. | greatest | s.d. dec. | effort "
        "| adhesion |",
        "|---" * 11 + "|",
    ]
    for case, of_demand in table.items():
        for demand, of_speed in of_demand.items():
            for speed, of_reserve in of_speed.items():
                for reserve, ways in of_reserve.items():
                    for way, c in ways.items():
                        lines.append(
                            f"| {case} | {demand} | {speed} | {reserve} | {way} | {c['mean']:.1f} "
                            f"| {c['distance']:.2f} | {c['greatest']:.1f} "
                            f"| {_decelerated(case, c)} | {100 * c['effort']:.2f} "
                            f"| {100 * c['adhesion']:.2f} |"
                        )
    return "\n".join([*lines, ""])


def _decelerated(case: str, found: Mapping[str, float]) -> str:
    # a brake that never builds up has no equivalent build-up time
    return "–" if case == "bogie failed" else f"{found['deceleration']:.2f}"


def main() -> None:
    """Run the study, print what it finds and write it where --out says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="few stops, one speed and reserve")
    parser.add_argument("--stops", type=int, help="so many, of the full study")
    parser.add_argument("--out", type=Path, help="folder for the results")
    chosen = parser.parse_args()
    stops = chosen.stops or (QUICK_STOPS if chosen.quick else STOPS)
    table = study(stops, not chosen.quick)
    missed = [] if chosen.quick else judged(table)
    print("\n".join(missed) if missed else "no bound is missed")
    if chosen.out is None:
        return
    result = {
        "command": "python studies/friction_estimation.py",
        "seed": SEED,
        "stops": stops,
        "railgrip": rg.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}",
        "missed": missed,
        "cells": table,
    }
    chosen.out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(result, indent=1) + "\n"
    (chosen.out / "friction_estimation.json").write_text(text, encoding="utf-8")
    (chosen.out / "friction_estimation.md").write_text(markdown(table), encoding="utf-8")


if __name__ == "__main__":
    main()
