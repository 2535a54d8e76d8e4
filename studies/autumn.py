"""Does a train keep its timetable on leaves, with each slide protection and traction control?

St Gallen-Wil with two stops between, four-car unit, on the plant: rail is dry but for leaves over
1.5 km around every stop (adhesion as the shipped condition says). Braking curves of 0.5 m/s², as on
dry rail, and of 0.25 m/s², as in autumn; the timetable allows 7 % over the dry time of the first.

    python studies/autumn.py [--quick] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import platform
from pathlib import Path
from typing import Any, Final

import railgrip as rg
from railgrip.engine.trip import drive_trip
from railgrip.report.trip_page import figures

ROOT = Path(__file__).resolve().parents[1]
STOPS: Final = (0.0, 10_000.0, 20_000.0, 29_556.0)
LEAVES: Final = 750.0
"""So far before and behind each stop lie leaves, m."""
CONTROLLERS: Final = (
    "none", "conventional", "macro_slip", "micro_slip", "mixed_slip", "adaptive",
    "temperature_controlled", "conventional_traction", "peak_seeking_traction",
    "adaptive_traction", "temperature_adaptive",
)  # fmt: skip
BRAKING: Final = (0.5, 0.25)
SUPPLEMENT: Final = 0.07


def scenario(controller: str, braking: float, *, dry: bool = False) -> rg.Scenario:
    """Return the trip with one protection and one braking curve, m/s²."""
    patches = [
        {"from": max(0.0, at - LEAVES), "to": min(at + LEAVES, STOPS[-1]), "condition": "leaves"}
        for at in STOPS
    ]
    return rg.load("dry_emergency").with_(
        {
            "line.use": "st_gallen_wil",
            "rail": {"condition": "dry", "patch": [] if dry else patches},
            "wsp.controller": "conventional" if dry else controller,
            "trip": {
                "stop": [{"at": at} for at in STOPS],
                "braking": braking,
                "supplement": SUPPLEMENT,
            },
        }
    )


def row(controller: str, braking: float, planned: float, *, dry: bool = False) -> dict[str, Any]:
    """Return what a trip came to; delay against the timetable of the dry time at 0.5 m/s²."""
    run = drive_trip(scenario(controller, braking, dry=dry))
    found: dict[str, Any] = {name: value for name, value, _, _ in figures(run)}
    found["legs"] = [leg.time for leg in run.legs]
    found["past_stops"] = [leg.past_stop for leg in run.legs]
    found["delay"] = max(0.0, run.running_time - planned) if planned else 0.0
    return found


def study(controllers: tuple[str, ...], brakings: tuple[float, ...]) -> dict[str, Any]:
    """Return dry, and every controller at every braking curve."""
    dry = row("conventional", BRAKING[0], 0.0, dry=True)
    planned = dry["dry_time"] * (1.0 + SUPPLEMENT)
    table: dict[str, Any] = {"dry": dry, "planned": planned, "autumn": {}}
    for controller in controllers:
        rows = table["autumn"].setdefault(controller, {})
        for braking in brakings:
            rows[f"{braking:g}"] = row(controller, braking, planned)
            took = rows[f"{braking:g}"]["running_time"]
            print(f"{controller}, {braking:g} m/s²: {took:.0f} s", flush=True)
    return table


def report(table: dict[str, Any]) -> str:
    """Return the table in Markdown."""
    dry = table["dry"]
    lines = [
        f"Dry, 0.5 m/s²: {dry['running_time']:.0f} s; timetable {table['planned']:.0f} s.", "",
        "| protection | braking curve, m/s² | time, s | late, s | past the stops, m "
        "| traction, kWh | lost in contacts, kWh | sand, kg | longest lock, s |",
        "|---|---|---|---|---|---|---|---|---|",
    ]  # fmt: skip
    for controller, rows in table["autumn"].items():
        for braking, one in rows.items():
            past = ", ".join(f"{value:+.0f}" for value in one["past_stops"])
            lines.append(
                f"| {controller} | {braking} | {one['running_time']:.0f} | {one['delay']:.0f} "
                f"| {past} | {one['energy_traction'] / 3.6e6:.0f} "
                f"| {one['energy_contact'] / 3.6e6:.1f} | {one['sand']:.1f} "
                f"| {one['longest_lock']:.1f} |"
            )
    return "\n".join(lines) + "\n"


def main() -> None:
    """Study, print, and keep the results."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="two protections, one curve")
    parser.add_argument("--out", type=Path, default=ROOT / "studies/results")
    chosen = parser.parse_args()
    if chosen.quick:
        print(report(study(CONTROLLERS[7:9], BRAKING[1:])))
        return
    table = study(CONTROLLERS, BRAKING)
    text = report(table)
    print(text)
    content = {
        "command": "python studies/autumn.py", "version": rg.__version__, "seed": 1,
        "machine": platform.machine(), **table,
    }  # fmt: skip
    chosen.out.mkdir(parents=True, exist_ok=True)
    (chosen.out / "autumn.json").write_text(json.dumps(content, indent=1) + "\n", "utf-8")
    (chosen.out / "autumn.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
