"""Every bad input of a user gets one clear sentence a problem, exit code 2, and leaves nothing."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

Command = Callable[..., "subprocess.CompletedProcess[str]"]

TRAIN = """
[train]
[[train.vehicle]]
length = "26.4 m"
tare = "44 t"
pivot_distance = "19 m"
[[train.vehicle.bogie]]
count = 2
wheelbase = "2.5 m"
mass = "6 t"
[[train.vehicle.bogie.axle]]
count = 2
rotating_mass = "700 kg"
wheel_radius = "0.46 m"
"""

BAD: dict[str, tuple[str, str]] = {
    "unknown key": ('train = "emu_four_car"\n[run]\nspede = "1 m/s"', "did you mean 'speed'?"),
    "unknown name": ('train = "emu_four_cra"', "did you mean 'emu_four_car'?"),
    "unknown unit": ('train = "emu_four_car"\nrun.speed = "160 furlong"', "run.speed: "),
    "wrong dimension": ('train = "emu_four_car"\nrun.speed = "3 bar"', "160 km/h"),
    "unit missing": ('train = "emu_four_car"\nrun.speed = "160"', "has no unit"),
    "negative mass": (TRAIN.replace("44 t", "-44 t"), "train.vehicle[0].tare: "),
    "empty train": ("[train]\nvehicle = []", "train.vehicle: "),
    "no train": ('title = "nothing"', "train: "),
    "not a number": ('train = "emu_four_car"\nrun.speed = nan', "run.speed: "),
    "infinite": ('train = "emu_four_car"\nrun.speed = inf', "run.speed: "),
    "truncated": ('train = "emu_four_car"\n[run', "is not valid TOML"),
    "binary": ("\0\1\2", "is not a text file"),
    "too fast": ('train = "emu_four_car"\nrun.speed = "700 km/h"', "allowed: "),
    "contradictory limits": (
        'train = "emu_four_car"\n[limits]\nstopping_distance = "100 m"\n'
        'stopping_distance_least = "200 m"',
        "contradicts stopping_distance",
    ),
    "unknown controller": (
        'train = "emu_four_car"\nwsp.controller = "conventionl"',
        "did you mean 'conventional'?",
    ),
    "unknown parameter": (
        'train = "emu_four_car"\nwsp.parameters.no_such_thing = 1',
        "wsp.parameters.no_such_thing: ",
    ),
    "missing controller file": (
        'train = "emu_four_car"\nwsp.controller = "gone.py"',
        "gone.py",
    ),
    "unknown law": ('train = "emu_four_car"\nrun.creep_law = "polach"', "polach_2005"),
    "circle": ('extends = "circle.toml"', "circle"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_scenarios(railgrip: Command, tmp_path: Path, name: str) -> None:
    text, told = BAD[name]
    path = tmp_path / f"{name.split()[0]}.toml"
    path.write_text(text, encoding="utf-8")
    done = railgrip("run", path.name)
    assert done.returncode == 2, done.stdout
    assert told in done.stderr
    assert all(line.startswith("railgrip: ") for line in done.stderr.splitlines()), done.stderr
    assert done.stdout == ""
    assert [found.name for found in tmp_path.iterdir()] == [path.name]


def test_all_problems_of_a_file_at_once(railgrip: Command, tmp_path: Path) -> None:
    (tmp_path / "many.toml").write_text(
        'train = "emu_four_cra"\n[run]\nspeed = "160 kmh"\ndemnd = 1\n', encoding="utf-8"
    )
    assert len(railgrip("check", "many.toml").stderr.splitlines()) == 3


def test_missing_folder_and_huge_files(railgrip: Command, tmp_path: Path) -> None:
    with (tmp_path / "huge.toml").open("wb") as file:
        file.truncate(200_000_000)
    for word, told in (
        ("nowhere.toml", "there is no such file"),
        (str(tmp_path), "is a folder"),
        ("huge.toml", "is too large"),
    ):
        done = railgrip("run", word)
        assert done.returncode == 2
        assert told in done.stderr
        assert len(done.stderr.splitlines()) == 1


def test_odd_but_valid_scenarios_end_with_a_sentence(railgrip: Command, tmp_path: Path) -> None:
    slippery = TRAIN + (
        '[line]\nuse = { length = "300 m" }\n[run]\nspeed = "20 km/h"\ntime_limit = "30 s"\n'
        "[rail.condition.contaminated]\nstatic_friction = 0\n"
    )
    (tmp_path / "slippery.toml").write_text(slippery, encoding="utf-8")
    done = railgrip("run", "slippery.toml", "--no-report")
    assert done.returncode == 1, done.stderr
    assert "before the train stood; try" in done.stdout


def test_bad_records_of_a_measured_stop(railgrip: Command, tmp_path: Path) -> None:
    (tmp_path / "stop.csv").write_text("t,v\n0,10\n1,abc\n", encoding="utf-8")
    (tmp_path / "map.toml").write_text(
        'time = { column = "t" }\nalign = { brake_command = "0 s" }\n'
        '[[channel]]\ncolumn = "v"\nsignal = "train_speed"\nunit = "km/h"\n',
        encoding="utf-8",
    )
    scenario = ("compare", "coach_120", "--no-report", "--measured")
    bad = railgrip(*scenario, "stop.csv", "--map", "map.toml")
    gone = railgrip(*scenario, "gone.csv", "--map", "map.toml")
    lonely = railgrip(*scenario, "stop.csv")
    assert [done.returncode for done in (bad, gone, lonely)] == [2, 2, 2]
    assert "stop.csv line 3: column 'v' is no finite number; got 'abc'" in bad.stderr
    assert "there is no such file" in gone.stderr
    assert "--map channels.toml" in lonely.stderr
