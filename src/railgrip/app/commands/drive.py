"""`railgrip drive`: a journey from start to stop, its energy, and the least it could be."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from railgrip.app.options import Json
from railgrip.app.screen import print_json, print_table, working
from railgrip.core.errors import Problem, RailgripError

if TYPE_CHECKING:
    from railgrip.scenario.journey import Journey

_PAGE = "journey.html"


def drive(
    file: Path,
    /,
    *,
    supplement: float | None = None,
    time: float | None = None,
    out: Path | None = None,
    as_json: Json = False,
) -> int:
    """Drive a journey without slip, flat out and with the least energy for its time.

    Parameters
    ----------
    file
        The journey (TOML): train, line, stops.
    supplement
        Share of time beyond the least possible, e.g. 0.05, instead of the file's.
    time
        Running time in seconds without dwells, instead of the file's.
    out
        Folder for the report; ./out/FILE if not given.
    as_json
        Print one JSON object instead of the tables.
    """
    with working("driving"):
        from railgrip.app.files import folder_of_results
        from railgrip.campaign.optimum.timetable import optimum
        from railgrip.campaign.optimum.trade_off import capped_curve, optimal_curve
        from railgrip.engine.journey.drive import drive as drive_fast
        from railgrip.io.journey_toml import read_journey
        from railgrip.report.journey_page import energy_rows, leg_rows, page

        journey = _asked(read_journey(file), supplement, time)
        fast = drive_fast(journey)
        best = optimum(journey)
        curve = optimal_curve(journey)
        capped = capped_curve(journey, float(curve[0].max()))
    head = ["", "running time, s", "energy, kWh", "of flat out"]
    whole = fast.energy["pantograph"]
    rows = [
        [name, f"{seconds:.1f}", f"{energy / 3.6e6:.2f}", f"{energy / whole:.1%}"]
        for name, seconds, energy in (
            ("flat out", fast.running_time, whole),
            ("optimum", best.running_time, best.energy),
        )
    ]
    times = {"flat out": fast.running_times, "optimum": best.running_times}
    folder = out or Path("out") / file.stem
    runs = {
        "flat out": (fast.trace["position"], fast.trace["speed"]),
        "optimum": (best.position, best.speed),
    }
    curves = {"optimum": curve, "full power to a lower top speed": capped}
    with folder_of_results(folder) as aside:
        text = page(fast, runs, [head, *rows], times, curves)
        (aside / _PAGE).write_text(text, encoding="utf-8")
    if as_json:
        print_json({
            "flat_out": {"running_time": fast.running_time, "energy": fast.energy,
                         "switchings": fast.switchings},
            "optimum": {"running_time": best.running_time, "energy": best.energy,
                        "least_time": float(best.least_times.sum())},
            "report": str(folder / _PAGE),
        })  # fmt: skip
        return 0
    title = journey.title or f"{journey.train.title} on {journey.line.title}"
    print_table(title, head, rows)
    print_table("Running times", ["from – to", *times], leg_rows(journey, times))
    print_table("Energy, flat out", ["", "kWh"], [list(row) for row in energy_rows(fast)])
    print(f"Report: {folder / _PAGE}")
    return 0


def _asked(journey: Journey, supplement: float | None, time: float | None) -> Journey:
    if supplement is not None and time is not None:
        raise RailgripError(Problem("--time", "and --supplement say the same; give one of them"))
    for name, value in (("--supplement", supplement), ("--time", time)):
        if value is not None and not 0.0 <= value < 1e6:
            raise RailgripError(Problem(name, "must not be negative", got=f"{value:g}"))
    if supplement is not None:
        return journey.model_copy(update={"supplement": supplement, "time": None})
    if time is not None:
        return journey.model_copy(update={"time": time, "supplement": None})
    return journey
