"""`railgrip drive` and `railgrip import` as a user meets them."""

import json
from pathlib import Path

import pytest

from railgrip import data
from railgrip.app.cli import execute
from railgrip.campaign.driving import driven
from railgrip.report.journey_page import page
from railgrip.scenario.journey import Journey

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
    written = (folder / told["report"]).read_text(encoding="utf-8")
    assert written.count("<img") == 2
    assert not any(
        outside in written for outside in ('src="http', 'href="http', "url(http", "<script")
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
    written = Path(told["report"]).read_text(encoding="utf-8")
    assert "Indicators, coasting" in written


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
    assert [one["is_acting"] for one in behind["coasting"]["log"]].count(True) >= 2


def test_pads_wear_by_the_friction_work(folder):
    """A train of 200 t from 144 km/h gives 160 MJ to its pads at 0.5 cm³/MJ, less with motors."""
    table = {
        "train": {
            "mass": "200 t", "rotating": 0.0, "max_speed": "144 km/h", "max_deceleration": 0.5,
            "effort": {"force": "200 kN", "power": "100 MW"}, "pad_wear": "0.5 cm^3/MJ",
        },
        "line": {"length": "20 km", "speed_limit": [{"at": 0, "value": "144 km/h"}]},
    }  # fmt: skip
    found = driven(Journey.model_validate(table))
    assert found.pad_wear(found.ways[0]) == pytest.approx(80e-6, rel=1e-3)
    assert "Wear of pads, at 0.5 cm³/MJ" in page(found)
    table["train"]["regeneration"] = {"force": "100 kN", "power": "100 MW"}
    found = driven(Journey.model_validate(table))
    assert found.pad_wear(found.ways[0]) < 1e-6
    assert found.as_table()["flat_out"]["pad_wear"] == found.pad_wear(found.ways[0])


SUPERVISION = """
braking = "1.1 m/s^2"

[supervision]
mode = "MODE"

[supervision.train]
length = "75 m"
emergency = [{ value = "1 m/s^2" }]
service = [{ value = "0.8 m/s^2" }]
emergency_time = "2 s"
service_time = "2.5 s"
service_brake_interface = true
"""


def test_a_supervised_journey_says_where_it_was_braked(folder, capsys):
    text = JOURNEY + SUPERVISION
    Path("b.toml").write_text(text.replace("MODE", "intervene"), encoding="utf-8")
    assert execute(["drive", "b.toml", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    own = told["flat_out"]["supervision"]
    assert [one["brake"] for one in own["interventions"]] == ["service"]
    stop = own["approaches"][-1]
    assert stop["target"] == 8550.0
    assert stop["margin"]["sbi"] < 0.0 < stop["margin"]["ebi"]
    assert "service brake" in [one["status"] for one in own["log"]]
    written = Path(told["report"]).read_text(encoding="utf-8")
    assert "Braked by the supervision, flat out" in written
    assert "Limits and run, optimum" in written
    Path("b.toml").write_text(text.replace("MODE", "drive"), encoding="utf-8")
    assert execute(["drive", "b.toml"]) == 0
    assert "Supervision, flat out: metres left" in capsys.readouterr().out


def test_factors_of_a_campaign_make_the_supervision_stricter(folder, capsys):
    row = {"speed": 60.0, "ebcl": 9, "k_dry_low": 0.8, "k_wet_low": 0.7,
           "a_brake_emergency": 1.0, "build_up_time": 2.0}  # fmt: skip
    Path("factors.json").write_text(json.dumps({"rows": [row]}), encoding="utf-8")
    Path("b.toml").write_text(JOURNEY + SUPERVISION.replace("MODE", "report"), encoding="utf-8")
    found = []
    for more in ([], ["--factors", "factors.json"]):
        assert execute(["drive", "b.toml", "--json", *more]) == 0
        told = json.loads(capsys.readouterr().out)
        found.append(told["flat_out"]["supervision"]["approaches"][-1]["passed"]["indication"])
    assert found[1] > found[0] + 50.0
    assert execute(["drive", "a.toml", "--factors", "factors.json"]) == 2
    assert "--factors: is for a journey under supervision" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('"MODE"', '"brake"', "supervision.mode"),
        ('"MODE"', '"drive"\npast_stop = 0', "supervision.past_stop: so near the stop"),
        ('"75 m"', '"30 m"', "supervision.train.length: is less than that of the train itself"),
        ("service_time", "service_tme", "did you mean 'service_time'?"),
    ],
)
def test_a_bad_supervision_is_explained(folder, capsys, old, new, sentence):
    text = (JOURNEY + SUPERVISION).replace(old, new).replace("MODE", "report")
    Path("b.toml").write_text(text, encoding="utf-8")
    assert execute(["drive", "b.toml"]) == 2
    assert sentence in capsys.readouterr().err
    assert not (folder / "out").exists()
