"""`railgrip drive` and `railgrip import` as a user meets them."""

import json
from pathlib import Path

import pytest

from railgrip import data
from railgrip.app.cli import execute

JOURNEY = """
train = "flirt_tpf"
line = "reference"
stop = [{ at = 0.0 }, { at = "8.5 km" }]
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("a.toml").write_text(JOURNEY, encoding="utf-8")
    return tmp_path


def test_drive_prints_and_writes_a_page(folder, capsys):
    assert execute(["drive", "a.toml", "--supplement", "0.05", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["optimum"]["energy"] < 0.85 * told["flat_out"]["energy"]["pantograph"]
    assert told["optimum"]["running_time"] == pytest.approx(1.05 * told["optimum"]["least_time"])
    page = (folder / told["report"]).read_text(encoding="utf-8")
    assert page.count("<img") == 2
    assert not any(
        outside in page for outside in ('src="http', 'href="http', "url(http", "<script")
    )


def test_impossible_time_says_the_least_possible(folder, capsys):
    assert execute(["drive", "a.toml", "--time", "200"]) == 2
    told = capsys.readouterr().err
    assert "is impossible on this line with this train; got 200.0 s; allowed: from 2" in told
    assert not (folder / "out").exists()


def test_import_writes_what_drive_takes_and_never_overwrites(folder, capsys):
    source = str(data.path("lines", "speed"))
    assert execute(["import", source, "--out", "b.toml"]) == 0
    assert "a line of 10.0 km: 9 speed limits" in capsys.readouterr().out
    assert execute(["import", source, "--out", "b.toml"]) == 2
    assert "is there already" in capsys.readouterr().err
    Path("c.toml").write_text('train = "local"\nline = "b.toml"\n', encoding="utf-8")
    assert execute(["drive", "c.toml", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["flat_out"]["running_time"] == pytest.approx(525.02, rel=2e-4)


def test_coasting_is_driven_tuned_and_logged(folder, capsys):
    Path("b.toml").write_text(
        JOURNEY + "\n[coasting]\ncoasting_deceleration = 0.1\n", encoding="utf-8"
    )
    assert execute(["drive", "b.toml", "--supplement", "0.1", "--tune", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    fast, rule, tuned, best = (
        told[name] for name in ("flat_out", "coasting", "coasting_tuned", "optimum")
    )
    assert tuned["running_time"] <= best["running_time"] * 1.0001
    assert fast["energy"]["pantograph"] > tuned["energy"]["pantograph"] > 0.999 * best["energy"]
    assert [one["is_acting"] for one in rule["log"]].count(True) >= 1
    assert 0.0 < tuned["parameters"]["coasting_deceleration"] < 0.5
    page = Path(told["report"]).read_text(encoding="utf-8")
    assert "Indicators, coasting" in page


@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        ("coasting_deceleration = 9", "coasting.coasting_deceleration"),
        ("coasting_deceleration = '3 m/s^2'", "must be above 0 and below braking"),
        ("shape = 'strait'", "coasting.shape"),
        ("hysteresis = '-3 km/h'", "coasting.hysteresis"),
    ],
)
def test_bad_coasting_is_explained(folder, capsys, table, sentence):
    Path("b.toml").write_text(f"{JOURNEY}\n[coasting]\n{table}\n", encoding="utf-8")
    assert execute(["drive", "b.toml"]) == 2
    assert sentence in capsys.readouterr().err
    assert not (folder / "out").exists()


def test_a_follower_coasts_behind_its_leader(folder, capsys):
    Path("b.toml").write_text(
        JOURNEY.replace("8.5 km", "15 km")
        + "\n[coasting]\ncoasting_deceleration = 0.3\n"
        + '\n[leader]\ntrain = "freight"\nheadway = "240 s"\n',
        encoding="utf-8",
    )
    assert execute(["drive", "b.toml", "--supplement", "0.05", "--json"]) == 0
    behind = json.loads(capsys.readouterr().out)
    assert (
        behind["coasting"]["energy"]["pantograph"]
        < 0.9 * (behind["flat_out"]["energy"]["pantograph"])
    )
    assert behind["coasting"]["switchings"] < behind["flat_out"]["switchings"]
    assert behind["flat_out"]["running_time"] > 1.05 * behind["optimum"]["least_time"]
    assert execute(["drive", "b.toml", "--supplement", "0.05", "--tune"]) == 2
    assert "--tune: is for a line that is free" in capsys.readouterr().err
