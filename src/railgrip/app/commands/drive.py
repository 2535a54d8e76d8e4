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
    tune: bool = False,
    seed: int = 1,
    factors: Path | None = None,
    out: Path | None = None,
    as_json: Json = False,
) -> int:
    """Drive a journey without slip: flat out, with coasting, and with the least energy.

    Coasting is driven where the file has a table [coasting], or with --tune. A scenario with a
    table [trip] is driven on the plant, axle by axle, beside the same trip without slip.

    Parameters
    ----------
    file
        The journey (TOML): train, line, stops; or a scenario with a table [trip].
    supplement
        Share of time beyond the least possible, e.g. 0.05, instead of the file's.
    time
        Running time in seconds without dwells, instead of the file's.
    tune
        Search the coasting parameters of least energy for that time.
    seed
        Of the search.
    factors
        Emergency brake, Kdry and Kwet of the supervision as `railgrip campaign safety` found them
        (factors.json), instead of the file's.
    out
        Folder for the report; ./out/FILE if not given.
    as_json
        Print one JSON object instead of the tables.
    """
    from railgrip.io.toml_file import read_toml

    if "trip" in read_toml(file):
        from railgrip.app.commands.drive_trip import drive_on_plant

        _only_journeys(supplement, time, tune, factors)
        return drive_on_plant(file, out, as_json)
    with working("driving"):
        from railgrip.app.files import folder_of_results
        from railgrip.campaign.driving import driven
        from railgrip.io.journey_toml import read_journey
        from railgrip.report.journey_page import energy_rows, leg_rows, page
        from railgrip.report.supervised_journey import supervision_tables

        journey = _asked(read_journey(file), supplement, time)
        if factors is not None:
            journey = _with_factors(journey, factors)
        found = driven(journey, tune=tune, seed=seed)
    folder = out or Path("out") / file.stem
    with folder_of_results(folder) as aside:
        (aside / _PAGE).write_text(page(found), encoding="utf-8")
    if as_json:
        print_json({**found.as_table(), "report": str(folder / _PAGE)})
        return 0
    head, *rows = found.summary()
    print_table(found.title, head, rows)
    for remark in found.remarks():
        print(remark)
    times = {way.name: way.running_times for way in found.ways}
    print_table("Running times", ["from – to", *times], leg_rows(found.journey, times))
    print_table("Energy, kWh", ["", *(way.name for way in found.ways)], energy_rows(found))
    for title, (head, *rows) in supervision_tables(found):
        print_table(title, head, rows)
    if found.tuned is not None:
        print_table("Coasting, tuned", ["", ""], found.tuned_rows())
    print(f"Report: {folder / _PAGE}")
    return 0


def _with_factors(journey: Journey, factors: Path) -> Journey:
    from railgrip.io.safety_factors import with_factors

    if journey.supervision is None:
        what = "is for a journey under supervision"
        raise RailgripError(Problem("--factors", what, cure="a table [supervision]"))
    return journey.model_copy(update={"supervision": with_factors(journey.supervision, factors)})


def _only_journeys(
    supplement: float | None, time: float | None, tune: bool, factors: Path | None
) -> None:
    given = {
        "--supplement": supplement,
        "--time": time,
        "--tune": tune or None,
        "--factors": factors,
    }
    problems = [
        Problem(name, "is for journeys without slip", cure="a table [coasting] in [trip]")
        for name, value in given.items()
        if value is not None
    ]
    if problems:
        raise RailgripError(problems)


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
