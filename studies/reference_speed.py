"""Rules for the reference speed: their error against the true speed, their cost in distance.

The conventional protection, in its macro and its micro band, on the rails of `locked_wheels.py`,
with four rules and with the known ground speed:

- greatest: the greatest axle speed, slewed down by at most 1.5 m/s²; no axle is let run free;
- present: dead reckoning with cylinder pressures and wheel accelerations (what is shipped);
- forces: dead reckoning with the force observed on each axle (`force_reckoning`);
- forces unlearned: the same, but the ratio of observed force to deceleration stays 1.

One axle of the train carries no brake. Its speed is the ground speed; the rules are not told it.

    python studies/reference_speed.py [--quick] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import platform
from pathlib import Path
from typing import Any, Final

import numpy as np

import railgrip as rg
from railgrip.control.adhesion_window import observe_friction
from railgrip.control.axle_protection import protect_axles
from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import (
    DECELERATION_PER_PRESSURE,
    SLIP_LOWER,
    ConventionalParameters,
)
from railgrip.control.conventional_state import DECELERATION, PRESSURE_GAIN, REFERENCE
from railgrip.control.conventional_wsp import (
    BANDS,
    ConventionalWSP,
    conventional_initial,
)
from railgrip.control.force_reckoning import reckon_with_forces
from railgrip.control.plain_form import KernelController
from railgrip.control.state_layout import state_size
from railgrip.control.temperature_controlled import temperature_initial
from railgrip.control.temperature_parameters import OBSERVER_WINDOW, TemperatureParameters
from railgrip.control.temperature_state import SAMPLE
from railgrip.control.train_observer import look_at_wheels


def _beside() -> Any:
    path = Path(__file__).with_name("locked_wheels.py")
    spec = importlib.util.spec_from_file_location("locked_wheels", path)
    if spec is None or spec.loader is None:
        raise SystemExit(f"{path}: not found")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


RAILS: Final = _beside()
SPEEDS: Final = (100, 160)
FIELDS: Final = 8
SLEW: Final = 1.5  # m/s²
GROUND_AXLE: Final = 9  # of the sixteen, from 0: a trailing axle in the third car
JUDGED_ABOVE: Final = 5.0  # m/s
RULES: Final = ("greatest", "present", "forces", "forces unlearned", "ground")


def _protect(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    protect_axles(parameters, state, command, dt)


def greatest_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Protect with the greatest axle speed, slewed down; arguments as in the contract."""
    wheels = look_at_wheels(parameters, state, measured, parameters[SLIP_LOWER], dt)
    before = state[REFERENCE]
    state[REFERENCE] = max(wheels.fastest, before - SLEW * dt)
    state[DECELERATION] = (before - state[REFERENCE]) / dt
    _protect(parameters, axle_setup, state, measured, command, dt)


def forces_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Protect with observed forces for the dead reckoning; arguments as in the contract."""
    n_axles = measured.shape[0]
    wheels = look_at_wheels(parameters, state, measured, parameters[SLIP_LOWER], dt)
    sample = int(state[SAMPLE])
    window = int(parameters[OBSERVER_WINDOW] / dt + 0.5)
    observe_friction(state, n_axles, sample, window, dt)
    reckon_with_forces(parameters, state, wheels, n_axles, parameters[SLIP_LOWER], dt)
    state[SAMPLE] += 1.0
    _protect(parameters, axle_setup, state, measured, command, dt)


def unlearned_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Protect as `forces_kernel` does, with a gain that is never learned."""
    state[PRESSURE_GAIN] = parameters[DECELERATION_PER_PRESSURE]
    forces_kernel(parameters, axle_setup, state, measured, command, dt)


class GreatestAxle(KernelController):
    """The conventional protection under the plain rule."""

    kernel = staticmethod(greatest_kernel)
    initial = staticmethod(conventional_initial)
    state_size = staticmethod(state_size)


class Forces(KernelController):
    """The conventional protection under the reckoning with observed forces."""

    kernel = staticmethod(forces_kernel)
    initial = staticmethod(temperature_initial)
    state_size = staticmethod(state_size)


class Unlearned(Forces):
    """As `Forces`, without learning."""

    kernel = staticmethod(unlearned_kernel)


def controller(rule: str, band: str) -> Any:
    """Return a protection with a rule and a band."""
    lower, upper = BANDS[band]
    limits = {"slip_lower": lower, "slip_upper": upper}
    if rule == "greatest":
        return GreatestAxle(ConventionalParameters()._replace(**limits), 0.01)
    if rule.startswith("forces"):
        kind = Forces if rule == "forces" else Unlearned
        return kind(TemperatureParameters()._replace(**limits), 0.01)
    return ConventionalWSP(band=band)


def cell(rail: str, speed: int, band: str, rule: str, fields: int) -> dict[str, float]:
    """Return error of the reference speed [m/s], distance [m] and longest fast lock [s]."""
    scenario = RAILS.stop(RAILS.rails()[rail], speed, "nominal", "conventional")
    train = scenario.train.model_dump(by_alias=True)
    axles = [a for v in train["vehicle"] for b in v["bogie"] for a in b["axle"]]
    axles[GROUND_AXLE]["brake"] = None
    label = scenario.train.axles()[GROUND_AXLE].label
    fault = [] if rule == "ground" else [{"axle": label, "kind": "sensor_lost"}]
    result = rg.simulate(
        scenario.with_({"train": train, "fault": fault}),
        runs=fields if rail == "random" else 1,
        traces=True,
        controller=controller(rule, band),
    )
    true = result["train_speed"].values
    error = (result["reference_speed"].values - true)[true > JUDGED_ABOVE]
    return {
        "above": round(float(error.max()), 3),
        "below": round(float(error.min()), 3),
        "rms": round(float(np.sqrt((error**2).mean())), 3),
        "distance": round(float(result["stopping_distance"].values.mean()), 1),
        "lock": round(float(result["axle_longest_fast_lock"].values.max()), 3),
        "stopped": float((result["status"].values == 1).mean()),
    }


def study(
    speeds: tuple[int, ...], fields: int, rails: tuple[str, ...], rules: tuple[str, ...] = RULES
) -> dict[str, Any]:
    """Return every cell: band → rail → speed → rule."""
    table: dict[str, Any] = {}
    for band in BANDS:
        for rail in rails:
            for speed in speeds:
                row = {rule: cell(rail, speed, band, rule, fields) for rule in rules}
                table.setdefault(band, {}).setdefault(rail, {})[str(speed)] = row
                told = ", ".join(
                    f"{name} {of['distance']:.0f} m {of['below']:+.2f} {of['above']:+.2f} m/s"
                    for name, of in row.items()
                )
                print(f"{band}, {rail}, {speed} km/h: {told}", flush=True)
    return table


def summary(table: dict[str, Any]) -> dict[str, dict[str, float]]:
    """Return for each band and rule the worst error, the cost over ground speed, the worst lock."""
    found: dict[str, dict[str, float]] = {}
    for band, rails in table.items():
        rows = [row for speeds in rails.values() for row in speeds.values()]
        for rule in rows[0]:
            cost = [100.0 * (row[rule]["distance"] / row["ground"]["distance"] - 1) for row in rows]
            found[f"{band}, {rule}"] = {
                "above": max(row[rule]["above"] for row in rows),
                "below": min(row[rule]["below"] for row in rows),
                "rms": float(np.sqrt(np.mean([row[rule]["rms"] ** 2 for row in rows]))),
                "mean_cost": float(np.mean(cost)),
                "greatest_cost": max(cost),
                "lock": max(row[rule]["lock"] for row in rows),
            }
    return found


def markdown(table: dict[str, Any]) -> str:
    """Return the summary, and the cost of each rule on each rail."""
    lines = [
        "| band, rule | error, m/s | rms, m/s | cost in distance, mean (worst) | longest lock, s |",
        "|---|---|---|---|---|",
    ]
    for name, of in summary(table).items():
        lines.append(
            f"| {name} | {of['below']:+.2f} … {of['above']:+.2f} | {of['rms']:.2f} |"
            f" {of['mean_cost']:+.1f} % ({of['greatest_cost']:+.1f} %) | {of['lock']:.2f} |"
        )
    lines += ["", "Stopping distance, m:", "", "| band | rail | km/h | " + " | ".join(RULES) + " |"]
    lines.append("|---" * (3 + len(RULES)) + "|")
    for band, rails in table.items():
        for rail, speeds in rails.items():
            for speed, row in speeds.items():
                cells = " | ".join(f"{row[rule]['distance']:.0f}" for rule in RULES)
                lines.append(f"| {band} | {rail} | {speed} | {cells} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Run the study, print what it finds and write it where --out says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="one speed, constant rail only")
    parser.add_argument("--out", type=Path, help="folder for the results")
    chosen = parser.parse_args()
    rails = tuple(RAILS.rails())
    table = study((100,), 1, rails[:4]) if chosen.quick else study(SPEEDS, FIELDS, rails)
    print(markdown(table))
    if chosen.out is None:
        return
    result = {
        "command": "python studies/reference_speed.py" + (" --quick" if chosen.quick else ""),
        "seed": RAILS.SEED,
        "fields": 1 if chosen.quick else FIELDS,
        "railgrip": rg.__version__,
        "machine": f"{platform.machine()}, Python {platform.python_version()}",
        "summary": summary(table),
        "cells": table,
    }
    chosen.out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(result, indent=1) + "\n"
    (chosen.out / "reference_speed.json").write_text(text, encoding="utf-8")
    if not chosen.quick:
        (chosen.out / "reference_speed.md").write_text(markdown(table), encoding="utf-8")


if __name__ == "__main__":
    main()
