"""How near does the coasting rule of 1976 come to the optimum, untuned and tuned?

St Gallen-Wil and Fribourg-Bern with the three trains of TTOBench, without slip: flat out; coasting
with the shipped parameters by each of the three actions, with and without the station rule; each
action tuned to a time of +2, 5, 10 and 20 %; and the optimum of the same time.

    python studies/coasting.py [--quick] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import platform
from pathlib import Path
from typing import Any, Final

import railgrip
from railgrip.campaign.coasting_tuning import share_of_saving, tune_coasting
from railgrip.campaign.optimum.timetable import optimum
from railgrip.engine.journey.coasting import coasting_of
from railgrip.engine.journey.drive import JourneyRun, drive
from railgrip.scenario.journey import Journey

ROOT = Path(__file__).resolve().parents[1]
LINES: Final = ("st_gallen_wil", "fribourg_bern")
TRAINS: Final = ("flirt_tpf", "kiss_sbb", "virm6")
ACTIONS: Final = ("cut", "reduced", "light braking")
SUPPLEMENTS: Final = (0.02, 0.05, 0.10, 0.20)
STATION: Final = 1000.0
"""So near a stop the station rule gives traction back, m."""
BELOW: Final = 5e-4
"""By which a run may seem to beat the optimum: what its grid is worth."""
KWH = 3.6e6


def figures(run: JourneyRun, flat_out: JourneyRun, journey: Journey) -> dict[str, float]:
    """Return what a run took, and what was possible in its time."""
    best = optimum(journey, max(run.running_time, flat_out.running_time))
    energy = run.energy
    if best.energy > energy["pantograph"] * (1.0 + BELOW):
        raise SystemExit(f"a rule beats the optimum: {energy['pantograph']} J, {best.energy} J")
    return {
        "time": run.running_time,
        "energy": energy["pantograph"],
        "optimum": best.energy,
        "saving": 1.0 - energy["pantograph"] / flat_out.energy["pantograph"],
        "share": share_of_saving(run, flat_out, best),
        "brake_work": energy["motor_brake"] + energy["friction"],
        "friction_work": energy["friction"],
        "switchings": float(run.switchings),
    }


def untuned(train: str, line: str) -> dict[str, Any]:
    """Return flat out, each action with the shipped parameters, and the station rule."""
    plain = Journey(train=train, line=line)
    flat_out = drive(plain)
    found = {"flat out": figures(flat_out, flat_out, plain)}
    found["flat out"]["share"] = 0.0
    for action in ACTIONS:
        for name, more in (
            (action, {}),
            (f"{action}, station rule", {"station_distance": STATION}),
        ):
            own = Journey(train=train, line=line, coasting={"action": action, **more})
            found[name] = figures(drive(own, coasting_of(own)), flat_out, plain)
    return found


def tuned(train: str, line: str, supplement: float, rounds: int) -> dict[str, Any]:
    """Return each action tuned to a time, with its parameters."""
    plain = Journey(train=train, line=line)
    flat_out = drive(plain)
    least = float(optimum(plain.model_copy(update={"supplement": 0.0})).least_times.sum())
    found = {}
    for action in ACTIONS:
        own = Journey(train=train, line=line, coasting={"action": action})
        result = tune_coasting(own, least * (1.0 + supplement), rounds=rounds)
        assert result.journey.coasting is not None
        found[action] = figures(result.run, flat_out, plain) | {
            "parameters": result.journey.coasting.model_dump()
        }
    return found


def study(quick: bool) -> dict[str, Any]:
    """Return every case: line → train → untuned, and tuned by supplement."""
    table: dict[str, Any] = {}
    for line in LINES:
        for train in TRAINS[: 1 if quick else None]:
            row = table.setdefault(line, {})[train] = {"untuned": untuned(train, line)}
            row["tuned"] = {
                f"{share:g}": tuned(train, line, share, 10 if quick else 60)
                for share in (SUPPLEMENTS[1:2] if quick else SUPPLEMENTS)
            }
            print(f"{train} on {line}", flush=True)
    return table


def report(table: dict[str, Any]) -> str:
    """Return the tables in Markdown."""
    lines = []
    for line, trains in table.items():
        for train, row in trains.items():
            lines += [
                f"### {train} on {line}", "",
                "| | time, s | energy, kWh | saved | optimum, kWh | of the possible saving "
                "| braked, kWh | switchings |",
                "|---|---|---|---|---|---|---|---|",
            ]  # fmt: skip
            named = dict(row["untuned"])
            for supplement, ways in row["tuned"].items():
                named |= {f"+{float(supplement):.0%}, {name}": one for name, one in ways.items()}
            for name, one in named.items():
                lines.append(
                    f"| {name} | {one['time']:.0f} | {one['energy'] / KWH:.1f} "
                    f"| {one['saving']:.0%} | {one['optimum'] / KWH:.1f} | {one['share']:.0%} "
                    f"| {one['brake_work'] / KWH:.1f} | {one['switchings']:.0f} |"
                )
            lines.append("")
    return "\n".join(lines)


def main() -> None:
    """Study, print, and keep the results."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="one train, one time, few rounds")
    parser.add_argument("--out", type=Path, default=ROOT / "studies/results")
    chosen = parser.parse_args()
    table = study(chosen.quick)
    text = report(table)
    print(text)
    if chosen.quick:
        return
    content = {
        "command": "python studies/coasting.py", "version": railgrip.__version__, "seed": 1,
        "machine": platform.machine(), "lines": table,
    }  # fmt: skip
    chosen.out.mkdir(parents=True, exist_ok=True)
    (chosen.out / "coasting.json").write_text(json.dumps(content, indent=1) + "\n", "utf-8")
    (chosen.out / "coasting.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
