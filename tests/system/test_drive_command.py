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
