"""Every shipped braking controller through the whole test programme, and what K_wet follows.

    python studies/programme.py [--repetitions N] [--threads N]

Writes results/test_programme.json and .md, which docs/programme.md shows.
"""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path
from typing import Any

import numpy as np

import railgrip
from railgrip.campaign.programme.perform import Programme
from railgrip.campaign.programme.profile import read_profile
from railgrip.campaign.programme.records import TestRecord
from railgrip.campaign.programme.verdict import mean_interval
from railgrip.control.etcs.steps import constant
from railgrip.control.etcs.train_data import safe_deceleration
from railgrip.core.atomic import write_aside

CONTROLLERS = (
    "conventional", "macro_slip", "micro_slip", "mixed_slip", "adaptive", "temperature_controlled",
)  # fmt: skip
TRAIN, PROFILE = "emu_four_car", "en_15595_style"
RESULTS = Path(__file__).parent / "results"
SPRAYED = ("W3", "W4")
DRY = {"W3": "D1", "W4": "D2"}
K_DRY = 0.75146
"""K_dry_rst at EBCL 9 of sixteen equal units that fail with 10⁻³ and scatter by 5 %, exactly (see
docs/safety.md): stands in for the train's own, which its brake's data would give."""


def main() -> None:
    """Run all programmes and write the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--repetitions", type=int, default=10)
    parser.add_argument("--threads", type=int, default=1)
    chosen = parser.parse_args()
    found = {name: examine(name, chosen.repetitions, (), chosen.threads) for name in CONTROLLERS}
    note = {
        "command": f"python studies/programme.py --repetitions {chosen.repetitions}",
        "railgrip_version": railgrip.__version__, "train": TRAIN, "profile": PROFILE,
        "seed": read_profile(PROFILE)[0].seed, "controllers": found,
    }  # fmt: skip
    with write_aside(RESULTS / "test_programme.json") as aside:
        aside.write_text(json.dumps(note, indent=1) + "\n", encoding="utf-8")
    with write_aside(RESULTS / "test_programme.md") as aside:
        aside.write_text(page(note), encoding="utf-8")


def examine(
    controller: str, repetitions: int, tests: tuple[str, ...] = (), threads: int = 1
) -> dict[str, Any]:
    """Return what a controller's programme gave: limits by test and metric, and K_wet."""
    profile, folder = read_profile(PROFILE)
    programme = Programme(profile.with_repetitions(repetitions), folder, TRAIN, controller, threads)
    records = list(programme.perform(tests))
    for record in records:
        print(f"{controller}: {record.name}, {len(record.valid)} valid runs {record.problem}")
    return {
        "limits": {
            f"{record.name} {one.metric.name}": {
                "label": one.metric.label,
                "verdict": one.held.verdict,
                "value": plain(one.held.value * one.metric.unit.factor),
                "unit": one.metric.unit.spoken,
            }
            for record in records
            for one in record.limits
        },
        "problems": {record.name: record.problem for record in records if record.problem},
        "runs": sum(len(record.runs) for record in records),
        "invalid": sum(len(record.runs) - len(record.valid) for record in records),
        "k_wet": {record.name: k_wet(record) for record in records if record.name in SPRAYED},
        "a_emergency": {
            record.name: plain(float(record.figures("mean_deceleration").mean()))
            for record in records
            if record.name in DRY.values()
        },
    }


def k_wet(record: TestRecord) -> list[float | None]:
    """Return K_wet of the mean extension, and its 95 % interval (Student)."""
    longer = record.figures("extension")
    if not len(longer):
        return [None, None, None]
    low, high = mean_interval(longer)
    return [plain(1.0 / (1.0 + value)) for value in (float(np.mean(longer)), high, low)]


def plain(value: float) -> float | None:
    """Return six digits, or nothing where there is no figure."""
    return float(f"{value:.6g}") if math.isfinite(value) else None


def page(note: dict[str, Any]) -> str:
    """Return the tables of the documentation."""
    found = note["controllers"]
    names = list(found)
    lines = [
        f"`{note['command']}`, railgrip {note['railgrip_version']}, train `{note['train']}`, "
        f"profile `{note['profile']}`, seed {note['seed']}. **Bold**: missed. The profile's "
        "limits are illustrative or unverified, so a missed one is a question, not a verdict on a "
        "product.",
        "",
        f"| limit | {' | '.join(f'`{name}`' for name in names)} |",
        f"|---|{'---|' * len(names)}",
    ]  # fmt: skip
    keys = dict.fromkeys(key for one in found.values() for key in one["limits"])
    for key in keys:
        cells = [cell(found[name]["limits"].get(key)) for name in names]
        label = next(one["limits"][key]["label"] for one in found.values() if key in one["limits"])
        lines.append(f"| {key.split()[0]}: {label} | {' | '.join(cells)} |")
    missed = [sum(one["verdict"] == "missed" for one in found[n]["limits"].values()) for n in names]
    lines.append(f"| limits missed | {' | '.join(map(str, missed))} |")
    invalid = [f"{found[name]['invalid']} of {found[name]['runs']}" for name in names]
    lines.append(f"| invalid runs | {' | '.join(invalid)} |")
    lines += [
        "", "K_wet with the 95 % interval of the mean, from the valid runs:", "",
        "| controller | W3, 120 km/h | W4, 160 km/h |", "|---|---|---|",
    ]  # fmt: skip
    for name in names:
        cells = [interval(found[name]["k_wet"].get(test)) for test in SPRAYED]
        lines.append(f"| `{name}` | {' | '.join(cells)} |")
    lines += [
        "", "A_brake_safe = K_dry K_wet A_brake_emergency of ETCS (M_NVAVADH 0), with K_dry = "
        f"{K_DRY} at EBCL 9 (sixteen equal units, exact) and the dry mean deceleration:", "",
        "| controller | W3, m/s² | W4, m/s² |", "|---|---|---|",
    ]  # fmt: skip
    for name in names:
        cells = [safe(found[name], test) for test in SPRAYED]
        lines.append(f"| `{name}` | {' | '.join(cells)} |")
    problems = [f"- `{n}`, {t}: {p}" for n in names for t, p in found[n]["problems"].items()]
    return "\n".join([*lines, "", *problems]).rstrip() + "\n"


def cell(limit: dict[str, Any] | None) -> str:
    """Return one figure; bold where the limit is missed."""
    if limit is None:
        return "–"
    text = "never" if limit["value"] is None else f"{limit['value']:.3g} {limit['unit']}".rstrip()
    if limit["verdict"] == "not applicable":
        return "–"
    return f"**{text}**" if limit["verdict"] == "missed" else text


def interval(value: list[float | None] | None) -> str:
    """Return K_wet and its interval."""
    if not value or value[0] is None:
        return "–"
    return f"{value[0]:.3f} ({value[1]:.3f} … {value[2]:.3f})"


def safe(found: dict[str, Any], test: str) -> str:
    """Return the safe deceleration that K_wet gives, with its interval."""
    factors, nominal = found["k_wet"].get(test), found["a_emergency"].get(DRY[test])
    if not factors or factors[0] is None or nominal is None:
        return "–"
    values = [
        safe_deceleration(constant(nominal), constant(K_DRY), constant(factor)).at(0.0)
        for factor in factors
    ]
    return f"{values[0]:.3f} ({values[1]:.3f} … {values[2]:.3f})"


if __name__ == "__main__":
    main()
