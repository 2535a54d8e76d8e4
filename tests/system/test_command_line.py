"""The commands from end to end: what they print, write, and end with."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

Command = Callable[..., "subprocess.CompletedProcess[str]"]
SHORT = """\
title = "Short stop"
train = "coach_disc"
[rail]
condition = "wet"
[run]
speed = "30 km/h"
"""


@pytest.fixture
def short(tmp_path: Path) -> Path:
    """A scenario that takes little time."""
    path = tmp_path / "short.toml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def names_in(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_run_prints_figures_and_names_the_report(
    railgrip: Command, short: Path, tmp_path: Path
) -> None:
    done = railgrip("run", short.name)
    assert done.returncode == 0, done.stderr
    assert "Stopping distance" in done.stdout
    assert "The train came to a stand." in done.stdout
    assert str(Path("out/short/report.html")) in done.stdout
    assert names_in(tmp_path / "out" / "short") == {"report.html", "result.nc", "traces.csv"}
    assert done.stderr == ""


def test_run_writes_figures_on_demand(railgrip: Command, short: Path, tmp_path: Path) -> None:
    assert railgrip("run", short.name, "--figures", "png,svg").returncode == 0
    names = names_in(tmp_path / "out" / "short")
    assert {"speeds_time.png", "speeds_time.svg", "pressure.png"} <= names


def test_a_missed_limit_ends_with_1(railgrip: Command, short: Path) -> None:
    missed = railgrip("run", short.name, "--no-report", "--set", "limits.stopping_distance=1 m")
    kept = railgrip("run", short.name, "--no-report", "--set", "limits.stopping_distance=1 km")
    assert (missed.returncode, kept.returncode) == (1, 0)
    assert "limit at most 1.0 m, missed" in missed.stdout
    assert "limit at most 1000.0 m, passed" in kept.stdout


def test_a_train_that_does_not_stop_ends_with_1_and_a_cure(railgrip: Command, short: Path) -> None:
    short.write_text(SHORT + '[line]\nuse = { length = "20 m" }\n', encoding="utf-8")
    done = railgrip("run", short.name, "--no-report")
    assert done.returncode == 1
    assert "The line ended before the train stood; try" in done.stdout


def test_json_is_one_object_and_nothing_else(railgrip: Command, short: Path) -> None:
    done = railgrip("run", short.name, "--no-report", "--json")
    found = json.loads(done.stdout)
    assert found["status"] == "STOPPED"
    assert found["exit_code"] == done.returncode == 0
    assert found["metrics"]["initial_speed"] == {"value": pytest.approx(30.0), "unit": "km/h"}
    assert done.stderr == ""


def test_json_errors_are_json(railgrip: Command, short: Path) -> None:
    for arguments in (["run", "nowhere.toml", "--json"], ["run", short.name, "--jsn", "--json"]):
        done = railgrip(*arguments)
        found = json.loads(done.stdout)
        assert found["exit_code"] == done.returncode == 2
        assert found["errors"][0]["message"]
        assert done.stderr == ""


def test_set_changes_the_scenario(railgrip: Command, short: Path) -> None:
    def distance(*changes: str) -> float:
        done = railgrip("run", short.name, "--no-report", "--json", "--set", *changes)
        value: float = json.loads(done.stdout)["metrics"]["stopping_distance"]["value"]
        return value

    assert distance("run.speed=20 km/h") < distance("run.speed=40 km/h", "wsp.controller=none")


def test_a_failed_run_leaves_nothing(railgrip: Command, short: Path, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    before = names_in(tmp_path)
    assert railgrip("run", short.name, "--out", "file").returncode == 2
    assert railgrip("run", short.name, "--out", "file/below").returncode == 2
    assert railgrip("run", short.name, "--set", "run.trace=3 ms").returncode == 2
    assert names_in(tmp_path) == before


@pytest.mark.parametrize(("sent", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interrupted_run_leaves_nothing(
    short: Path, tmp_path: Path, sent: signal.Signals, code: int
) -> None:
    # Figures in three formats take seconds, so the signal meets a folder that is being filled.
    command = [sys.executable, "-m", "railgrip.app", "run", short.name, "--figures", "png,svg,pdf"]
    process = subprocess.Popen(
        command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    folder = tmp_path / "out" / "short"
    until = time.monotonic() + 240
    while not any(folder.glob(".unfinished-*/*")) and time.monotonic() < until:
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    process.send_signal(sent)
    _, said = process.communicate(timeout=60)
    assert process.returncode == code
    assert "Traceback" not in said
    assert names_in(tmp_path) == {short.name}


def test_compare_puts_controllers_side_by_side(railgrip: Command, short: Path) -> None:
    done = railgrip(
        "compare", short.name, "--controllers", "conventional,none", "--no-report", "--json"
    )
    found = json.loads(done.stdout)
    assert list(found["runs"]) == ["conventional", "none"]
    assert found["runs"]["none"]["metrics"]["valve_cycles"]["value"] == 0


FAILS = """
import numpy as np
from railgrip.control.contract import Command


class WSP:
    period = 0.01

    def reset(self, setup):
        return {"left": 100, "n": setup.n_axles}

    def step(self, state, measured, dt):
        state["left"] -= 1
        if state["left"] < 0:
            raise ValueError("out of ideas")
        n = state["n"]
        return Command(np.zeros(n), np.ones(n), np.zeros(n), float(measured.wheel_speed.max()))
"""


def test_compare_writes_one_page_and_its_table(
    railgrip: Command, short: Path, tmp_path: Path
) -> None:
    """A controller that fails under way is told, and does not take the others with it."""
    (tmp_path / "hasty.py").write_text(FAILS, encoding="utf-8")
    words = ("--controllers", "conventional,hasty.py,none", "--seed", "5")
    done = railgrip("compare", short.name, *words, "--out", "both/page.html")
    assert done.returncode == 1, done.stderr
    assert "hasty: wsp.controller: WSP.step failed; got ValueError: out of ideas" in done.stdout
    assert "hasty does not come to a stand" in done.stdout
    names = sorted(path.name for path in (tmp_path / "both").iterdir())
    assert names == ["page.csv", "page.html", "page.json"]
    table = (tmp_path / "both" / "page.csv").read_text(encoding="utf-8").splitlines()
    assert table[0] == "figure,unit,conventional,hasty,none"
    found = json.loads((tmp_path / "both" / "page.json").read_text(encoding="utf-8"))
    assert found["runs"]["hasty"]["status"] == "CONTROLLER_FAILED"
    assert found["runs"]["none"]["status"] == "STOPPED"
    page = (tmp_path / "both" / "page.html").read_text(encoding="utf-8")
    assert "seed 5" in page
    assert "Shown up to 1.0" in page


def test_compare_gives_a_random_rail_another_seed(railgrip: Command) -> None:
    """Also where the field has a seed of its own; the same seed gives the same figures again."""
    words = (
        "compare",
        "random_rail",
        "--controllers",
        "conventional,none",
        "--no-report",
        "--json",
    )
    slow = ("--set", "run.speed=40km/h")
    found = [
        json.loads(railgrip(*words, "--seed", seed, *slow).stdout)["runs"]["conventional"][
            "metrics"
        ]
        for seed in ("2", "3", "2")
    ]
    assert found[0] == found[2]
    assert found[0]["stopping_distance"] != found[1]["stopping_distance"]


def test_compare_refuses_what_it_cannot_show(
    railgrip: Command, short: Path, tmp_path: Path
) -> None:
    before = sorted(tmp_path.iterdir())
    for words, told in {
        ("conventional,adaptiv",): "did you mean 'adaptive'",
        ("conventional",): "there is nothing to compare the run with",
        (",".join(["none"] * 13),): "too many runs for one page; got 13; allowed: 2 to 12",
    }.items():
        done = railgrip("compare", short.name, "--controllers", *words, "--out", "page.html")
        assert done.returncode == 2, done.stdout
        assert told in done.stderr
        assert len(done.stderr.splitlines()) == 1
    assert sorted(tmp_path.iterdir()) == before


def test_compare_lays_a_measured_stop_over_the_run(
    railgrip: Command, short: Path, tmp_path: Path
) -> None:
    ran = railgrip("run", short.name, "--out", "ran")
    assert ran.returncode == 0
    (tmp_path / "map.toml").write_text(
        'time = { column = "time_s", unit = "s" }\nalign = { speed_crossing = "25 km/h" }\n'
        '[[channel]]\ncolumn = "train_speed_m_s"\nsignal = "train_speed"\nunit = "m/s"\n',
        encoding="utf-8",
    )
    done = railgrip(
        *("compare", short.name, "--measured", "ran/traces.csv", "--map", "map.toml"),
        *("--no-report", "--json"),
    )
    assert done.returncode == 0, done.stderr
    rows = json.loads(done.stdout)["measured"]
    assert rows["stopping_distance"]["difference"] == pytest.approx(0.0, abs=0.1)


def test_check_describes_what_would_run(railgrip: Command, short: Path) -> None:
    done = railgrip("check", short.name)
    assert done.returncode == 0
    assert "from 30 km/h" in done.stdout
    assert "short.toml is in order." in done.stdout


def test_check_tells_a_bad_controller_from_a_good_one(railgrip: Command, tmp_path: Path) -> None:
    good = Path(__file__).parents[2] / "docs" / "examples" / "controllers" / "my_wsp.py"
    (tmp_path / "good.py").write_text(good.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "bad.py").write_text(
        good.read_text(encoding="utf-8").replace("reference_speed=reference", "reference_speed=0"),
        encoding="utf-8",
    )
    (tmp_path / "worse.py").write_text("class WSP:\n  def reset(self", encoding="utf-8")
    assert railgrip("check", "good.py").returncode == 0
    never_vents = (tmp_path / "bad.py").read_text(encoding="utf-8").replace("VENT,", "FILL,")
    (tmp_path / "bad.py").write_text(never_vents, encoding="utf-8")
    bad = railgrip("check", "bad.py")
    assert bad.returncode == 1
    assert "FAILED" in bad.stdout
    worse = railgrip("check", "worse.py")
    assert worse.returncode == 2
    assert "SyntaxError" in worse.stderr


def test_schema_checks_the_shipped_scenarios(railgrip: Command) -> None:
    done = railgrip("schema")
    schema = json.loads(done.stdout)
    assert {"train", "run", "wsp", "extends"} <= set(schema["properties"])
    wrong = railgrip("schema", "trane")
    assert wrong.returncode == 2
    assert "did you mean 'train'?" in wrong.stderr


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("trains", "emu_four_car"),
        ("lines", "level"),
        ("rail-conditions", "leaves"),
        ("controllers", "conventional"),
        ("laws", "polach_2005"),
        ("pads", "organic"),
        ("scenarios", "demo"),
    ],
)
def test_list_names_what_is_there(railgrip: Command, kind: str, expected: str) -> None:
    found = json.loads(railgrip("list", kind, "--json").stdout)
    assert expected in found[kind]
    assert expected in railgrip("list", kind).stdout


def test_list_answers_a_wrong_word_kindly(railgrip: Command) -> None:
    done = railgrip("list", "train")
    assert done.returncode == 2
    assert "did you mean 'trains'?" in done.stderr


def test_new_writes_a_scenario_that_runs_and_never_overwrites(
    railgrip: Command, tmp_path: Path
) -> None:
    assert railgrip("new", "my_stop").returncode == 0
    text = (tmp_path / "my_stop.toml").read_text(encoding="utf-8")
    assert 'title = "my stop"' in text
    assert railgrip("check", "my_stop.toml").returncode == 0
    again = railgrip("new", "my_stop")
    assert again.returncode == 2
    assert "is there already" in again.stderr
    assert (tmp_path / "my_stop.toml").read_text(encoding="utf-8") == text


def test_demo_does_the_main_job(railgrip: Command, tmp_path: Path) -> None:
    done = railgrip("demo")
    assert done.returncode == 0, done.stderr
    assert "conventional" in done.stdout
    assert "none" in done.stdout
    report = (tmp_path / "out" / "demo" / "report.html").read_text(encoding="utf-8")
    assert "http://" not in report.replace("http://www.w3.org/", "")


def test_usage_is_answered_in_one_line(railgrip: Command) -> None:
    for arguments in (["rum"], ["run"], ["run", "demo", "--otu", "x"], ["compare"]):
        done = railgrip(*arguments)
        assert done.returncode == 2, arguments
        assert len(done.stderr.splitlines()) == 1, done.stderr
        assert done.stdout == ""


def test_version(railgrip: Command) -> None:
    import railgrip as package

    assert railgrip("--version").stdout.strip() == package.__version__
