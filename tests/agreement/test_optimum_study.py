"""A few rows of the stored study of optima are made again."""

import csv
from pathlib import Path

import pytest

from railgrip.campaign.optimum.leg import LegProblem
from railgrip.scenario.journey import Journey

STORED = Path(__file__).parents[2] / "studies" / "results" / "optimum.csv"
ROWS = list(csv.DictReader(line for line in STORED.open(encoding="utf-8") if line[0] != "#"))
SOME = ROWS[3::137]


def test_every_time_was_met():
    assert len(ROWS) == 1100
    assert max(abs(float(row["seconds_off"])) for row in ROWS) < 1e-3


@pytest.mark.parametrize(
    "row", SOME, ids=lambda row: f"{row['train']}-{row['line']}-{row['share']}"
)
def test_energy_is_the_stored_one(row):
    begin, end = float(row["from"]), float(row["to"])
    leg = LegProblem(Journey(train=row["train"], line=row["line"]), begin, end, 0.0, 0.0)
    assert leg.least_time == pytest.approx(float(row["least_time"]), abs=1e-3)
    run = leg.for_time(leg.least_time * (1 + float(row["share"])))
    assert leg.energy_of(run) / 3.6e6 == pytest.approx(float(row["energy_kwh"]), rel=1e-4, abs=1e-3)


def test_the_search_on_random_lines_found_nothing():
    """What docs/driving.md says of `studies/optimum_stress.py`; tests/laws runs a part again."""
    file = STORED.with_name("optimum_stress.csv")
    rows = list(csv.DictReader(line for line in file.open(encoding="utf-8") if line[0] != "#"))
    assert len(rows) == 397

    def worst(field, leave_out=()):
        return max(float(row[field]) for row in rows if row["journey"] not in leave_out)

    assert worst("time_off") < 1e-8
    assert worst("rise") < 1e-8
    assert worst("price_rise") == worst("overspeed") == worst("overpull") == 0.0
    assert worst("integral_off") < 1e-3
    held = ("freight realworld 0", "freight var_gradient_plus_5 0")
    assert worst("rule_below", held) < 1e-4
