"""`railgrip drive` for a scenario with a trip, as a user meets it."""

import json
from pathlib import Path

import pytest

from railgrip.app.cli import execute

SCENARIO = """
extends = "dry_emergency"

[line]
use = "fribourg_bern"

[trip]
stop = [{ at = 0 }, { at = "3 km" }]
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("a.toml").write_text(SCENARIO, encoding="utf-8")
    return tmp_path


def test_a_trip_prints_its_legs_and_writes_a_page(folder, capsys):
    assert execute(["drive", "a.toml", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["legs"][0]["status"] == "STOPPED"
    assert abs(told["legs"][0]["past_stop"]) < 1.0
    assert told["running_time"] == pytest.approx(told["dry_time"], abs=2.0)
    page = Path(told["report"]).read_text(encoding="utf-8")
    assert page.count("<img") == 2
    assert 'src="http' not in page


def test_a_trip_under_supervision_says_how_near_it_came(folder, capsys):
    table = """
[trip.supervision]
mode = "drive"
[trip.supervision.train]
length = "105 m"
emergency = [{ value = "1 m/s^2" }]
service = [{ value = "0.8 m/s^2" }]
emergency_time = "3 s"
service_time = "3 s"
"""
    Path("a.toml").write_text(SCENARIO + table, encoding="utf-8")
    assert execute(["drive", "a.toml"]) == 0
    told = capsys.readouterr().out
    assert "Supervision, on the plant: metres left" in told
    page = Path("out/a/trip.html").read_text(encoding="utf-8")
    assert "Supervision (ETCS)" in page
    assert page.count("<img") == 3
    Path("a.toml").write_text(SCENARIO + table.replace("drive", "intervene"), encoding="utf-8")
    assert execute(["drive", "a.toml"]) == 2
    assert "trip.supervision.mode: is for journeys without slip" in capsys.readouterr().err


def test_a_train_that_gets_nowhere_says_so_and_ends_with_one(folder, capsys):
    """Ice and a steep climb: the wheels spin, the train rolls back."""
    line = """
[line.use]
length = "5 km"
speed_limit = [{ at = 0, value = "80 km/h" }]
gradient = [{ at = 0, value = 0.035 }]

[rail]
condition = "very_low"

[trip]
stop = [{ at = "500 m" }, { at = "3 km" }]
"""
    Path("b.toml").write_text(f'extends = "dry_emergency"\n{line}', encoding="utf-8")
    assert execute(["drive", "b.toml", "--json"]) == 1
    told = json.loads(capsys.readouterr().out)
    assert told["legs"][0]["status"] in ("STALLED", "TIME_LIMIT")
    assert told["legs"][0]["time"] is None
    assert Path(told["report"]).exists()


@pytest.mark.parametrize(
    ("words", "text", "sentence"),
    [
        (["--tune"], SCENARIO, "--tune: is for journeys without slip"),
        (["--time", "300"], SCENARIO, "--time: is for journeys without slip"),
        ([], SCENARIO.replace("3 km", "300 km"), "lies off the line"),
        ([], SCENARIO.replace("fribourg_bern", "level"), "line.speed_limit"),
        ([], SCENARIO.replace("stop =", "stops ="), "trip.stops"),
    ],
)
def test_what_is_wrong_is_said_and_nothing_is_left(folder, capsys, words, text, sentence):
    Path("a.toml").write_text(text, encoding="utf-8")
    assert execute(["drive", "a.toml", *words]) == 2
    assert sentence in capsys.readouterr().err
    assert not (folder / "out").exists()


@pytest.mark.parametrize("command", [["run"], ["compare", "--controllers", "none,conventional"]])
def test_other_commands_send_a_trip_where_it_belongs(folder, capsys, command):
    assert execute([command[0], "a.toml", *command[1:]]) == 2
    assert "try: railgrip drive a.toml" in capsys.readouterr().err
