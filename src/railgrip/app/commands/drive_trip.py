"""`railgrip drive` for a scenario with a trip: from stop to stop on the plant."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

from railgrip.app.screen import print_json, print_table, working

_PAGE = "trip.html"


def drive_on_plant(file: Path, out: Path | None, as_json: bool) -> int:
    """Drive a trip, print its table, write its page; 1 where the train does not come to a stop."""
    with working("driving"):
        import railgrip
        from railgrip.app.files import folder_of_results
        from railgrip.engine.trip import drive_trip
        from railgrip.report.supervised_journey import supervision_tables
        from railgrip.report.trip_page import figures, leg_table, supervised_way, trip_html

        run = drive_trip(railgrip.load(file))
    folder = out or Path("out") / file.stem
    with folder_of_results(folder) as aside:
        (aside / _PAGE).write_text(trip_html(run), encoding="utf-8")
    has_arrived = all(leg.run.status.name == "STOPPED" for leg in run.legs)
    rows = figures(run)
    if as_json:
        print_json({
            **{name: value for name, value, _, _ in rows},
            "legs": [{"begin": leg.begin, "stop": leg.stop, "status": leg.run.status.name,
                      "time": leg.time, "planned": leg.planned, "past_stop": leg.past_stop}
                     for leg in run.legs],
            "report": str(folder / _PAGE),
        })  # fmt: skip
        return 0 if has_arrived else 1
    heads, cells = leg_table(run)
    print_table(run.scenario.title or "Trip", heads, cells)
    if run.journey.supervision is not None:
        found = SimpleNamespace(ways=[supervised_way(run)])
        for title, (head, *lines) in supervision_tables(found):
            print_table(title, head, lines)
    print_table("Altogether", ["", ""], [[words, text] for _, _, words, text in rows])
    print(f"Report: {folder / _PAGE}")
    return 0 if has_arrived else 1
