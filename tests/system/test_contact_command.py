"""`railgrip contact` from end to end: what it prints, writes, and refuses."""

from __future__ import annotations

import csv
import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Command = Callable[..., "subprocess.CompletedProcess[str]"]


def found(railgrip: Command, *arguments: str) -> dict[str, Any]:
    done = railgrip("contact", *arguments, "--json")
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    content: dict[str, Any] = json.loads(done.stdout)
    return content


def test_a_case_prints_patch_slopes_and_forces(railgrip: Command, tmp_path: Path) -> None:
    done = railgrip("contact", "--creepage", "1 %", "--speed", "20 m/s", "--laws", "polach_2005")
    assert done.returncode == 0, done.stderr
    for told in ("7.1920 mm", "1227.2 MPa", "4.5505", "14523.7", "35.940", "polach_2005"):
        assert told in done.stdout
    assert done.stderr == ""
    assert list(tmp_path.iterdir()) == []


def test_json_is_in_si_and_holds_published_figures(railgrip: Command) -> None:
    case = found(railgrip, "--pair", "cap_2000", "--creepage", "0.01", "--load", "100 kN")
    assert case["contact"]["load"] == 100e3
    assert case["slopes"]["cap_2000"] == pytest.approx(16605e3)
    assert case["points"]["longitudinal"] == [0.01]
    assert case["exit_code"] == 0
    base = found(railgrip, "--creepage", "1 %", "--speed", "20 m/s", "--rail", "wet")
    assert base["laws"]["polach_2005"]["longitudinal"] == pytest.approx([16138.10], rel=1e-6)


def test_braking_is_negative(railgrip: Command) -> None:
    case = found(railgrip, "--creepage", "-0.2 %", "--lateral", "-0.1 %", "--spin", "-0.5/m")
    assert case["laws"]["polach_2005"]["longitudinal"][0] < 0
    assert case["laws"]["polach_2005"]["lateral"][0] < 0


def test_all_laws_stand_beside_the_exact_theory(railgrip: Command) -> None:
    case = found(railgrip, "--laws", "all", "--friction", "0.3", "--creepage", "0.1 %")
    assert case["reference"] == "exact"
    assert {"exact", "polach_2005", "fastsim_1982", "kalker_linear"} <= set(case["laws"])
    assert case["laws"]["exact"]["difference"] == [0.0]
    assert 0.005 < case["laws"]["fastsim_1982"]["difference"][0] < 0.02
    done = railgrip("contact", "--laws", "all", "--friction", "0.3", "--creepage", "1 %")
    assert "kalker_linear*" in done.stdout
    assert "* beyond what the law declares itself good for" in done.stdout


def test_a_sweep_writes_table_data_and_figures(railgrip: Command, tmp_path: Path) -> None:
    done = railgrip(
        *("contact", "--sweep", "creepage", "--from", "-5 %", "--to", "5 %", "--points", "41"),
        *("--laws", "polach_2005,shen_hedrick_elkins_1983", "--over", "slip-speed"),
        *("--show", "force", "--out", "here", "--figures", "svg,png"),
    )
    assert done.returncode == 0, done.stderr
    assert "Slip speed, m/s" in done.stdout
    names = {path.name for path in (tmp_path / "here").iterdir()}
    assert names == {"contact.json", "forces.csv", "curves.svg", "curves.png"}
    with (tmp_path / "here" / "forces.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 2 * 41
    first = rows[0]
    assert float(first["longitudinal_creepage"]) == -0.05
    assert float(first["slip_speed_m_s"]) == pytest.approx(1.0)
    share = float(first["longitudinal_force_N"]) / float(first["load_N"])
    assert share == pytest.approx(float(first["longitudinal_adhesion"]), rel=1e-6)
    kept = json.loads((tmp_path / "here" / "contact.json").read_text(encoding="utf-8"))
    assert kept["swept"] == "longitudinal"


@pytest.mark.parametrize("variable", ["lateral", "spin", "speed", "load"])
def test_every_variable_can_be_swept(railgrip: Command, variable: str) -> None:
    case = found(railgrip, "--sweep", variable, "--points", "3")
    assert len(set(case["points"][variable])) == 3
    adhesion = case["laws"]["polach_2005"]["adhesion"]
    assert len(adhesion) == 3
    assert adhesion[-1] > 0.0


def test_a_map_is_drawn(railgrip: Command, tmp_path: Path) -> None:
    done = railgrip("contact", "--map", "--friction", "0.3", "--spin", "0.5 1/m")
    assert done.returncode == 0, done.stderr
    folder = tmp_path / "out" / "contact"
    assert (folder / "map.png").stat().st_size > 10_000
    assert {path.name for path in folder.iterdir()} == {
        "map.png", "map.csv", "forces.csv", "contact.json"
    }  # fmt: skip


def test_temperatures_and_their_limits(railgrip: Command) -> None:
    arguments = ("--creepage", "-20 %", "--rail", "wet", "--wheel-temperature", "150 degC")
    law = found(railgrip, *arguments)["laws"]["polach_2005"]
    touch = law["surface_temperature"][0] - law["flash_rise"][0]
    assert 75.0 < touch < 85.0  # equal steels meet near the middle of 150 and 20 °C
    done = railgrip("contact", *arguments)
    assert "short-time austenitisation (850 °C) passed by" in done.stdout  # the gravest


def test_a_locked_wheel_has_a_map_without_temperature(railgrip: Command, tmp_path: Path) -> None:
    done = railgrip("contact", "--map", "--creepage", "-100 %", "--rail", "wet")
    assert done.returncode == 0, done.stderr
    with (tmp_path / "out" / "contact" / "map.csv").open(encoding="utf-8", newline="") as file:
        assert {row["wheel_rise_K"] for row in csv.DictReader(file)} == {"nan"}


def test_geometry_by_numbers_and_by_place_on_s1002(railgrip: Command) -> None:
    own = found(
        railgrip, "--wheel-radius", "500 mm", "--wheel-transverse-radius", "-0.8 m",
        "--rail-transverse-radius", "0.5 m", "--young", "200 GPa", "--poisson", "0.3",
    )  # fmt: skip
    assert own["geometry"]["wheel_transverse_radius"] == -0.8
    assert own["geometry"]["young"] == 200e9
    place = found(railgrip, "--position", "8 mm")
    assert place["geometry"]["wheel_transverse_radius"] == pytest.approx(-0.601525, abs=1e-6)
    assert place["slopes"]["cap_2000"] is None
    round_tread = found(railgrip, "--pair", "s1002_new", "--wheel-transverse-radius", "1 m")
    assert round_tread["geometry"]["wheel_transverse_radius"] == 1.0


def test_creepage_beyond_validity_is_flagged_not_refused(railgrip: Command) -> None:
    case = found(railgrip, "--laws", "kalker_linear", "--creepage", "5 %")
    assert case["laws"]["kalker_linear"]["is_valid"] == [False]


BAD: dict[str, tuple[tuple[str, ...], str]] = {
    "unknown law": (("--law", "polach"), "--laws: law of rolling contact 'polach' unknown"),
    "unknown reference": (("--reference", "exakt"), "did you mean 'exact'?"),
    "no law": (("--laws", ","), "--laws: no law is given"),
    "unknown pair": (("--pair", "s1002_nw"), "did you mean 's1002_new'?"),
    "unknown rail": (("--rail", "dri"), "did you mean 'dry'?"),
    "zero load": (("--load", "0 N"), "--load: is out of range; got 0 N"),
    "tension": (("--load", "-5 kN"), "--load: is out of range; got -5000 N"),
    "zero speed": (("--speed", "0 km/h"), "--speed: is out of range; got 0 km/h"),
    "not a number": (("--creepage", "nan"), "--creepage: must be a finite number"),
    "infinite": (("--load", "inf"), "--load: must be a finite number"),
    "wrong unit": (("--speed", "3 bar"), "--speed: has a unit that is not known or does not fit"),
    "no unit": (("--spin", "0.5 x"), "--spin: has a unit that is not known"),
    "hollow on a round head": (("--position", "-3 mm"), "Hertz has no solution on a rail"),
    "off the profile": (("--position", "90 mm"), "--position: is out of range"),
    "flat on flat": (("--pair", "worn_on_worn", "--rail-transverse-radius", "0 m"), "zero"),
    "more hollow than the head": (("--wheel-transverse-radius", "-0.2 m"), "do not touch"),
    "rectangle": (("--pair", "cone_on_worn_rail"), "--pair: the patch of this pair is a rectangle"),
    "too hot": (("--wheel-temperature", "2000 degC"), "--wheel-temperature: is out of range"),
    "soft": (("--poisson", "0.9"), "--poisson: is out of range"),
    "unknown variable": (("--sweep", "spn"), "--sweep: variable 'spn' unknown"),
    "one point": (("--sweep", "spin", "--points", "1"), "--points: is out of range; got 1"),
    "negative points": (("--sweep", "spin", "--points", "-4"), "--points: is out of range"),
    "backwards": (("--sweep", "spin", "--from", "2/m", "--to", "1/m"), "--to: must be above"),
    "range without sweep": (("--from", "1 %"), "--from: needs --sweep"),
    "sweep of standstill": (("--sweep", "speed", "--from", "0 m/s"), "--from: is out of range"),
    "unknown form": (("--show", "froce"), "did you mean 'force'?"),
    "slip speed of a case": (("--over", "slip-speed"), "--over: slip speed belongs to a sweep"),
    "map without a patch": (("--map", "--law", "polach_2005"), "--map: none of the laws"),
    "unknown format": (("--figures", "jpeg"), "--figures"),
    "too much friction": (("--friction", "-0.1"), "--friction: is out of range"),
    "unknown option": (("--lod", "1 kN"), "--lod"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_gets_one_sentence(railgrip: Command, tmp_path: Path, name: str) -> None:
    arguments, told = BAD[name]
    done = railgrip("contact", *arguments)
    assert done.returncode == 2, done.stdout
    assert told in done.stderr
    assert len(done.stderr.splitlines()) == 1, done.stderr
    assert done.stdout == ""
    assert list(tmp_path.iterdir()) == []


def test_all_bad_quantities_at_once(railgrip: Command) -> None:
    done = railgrip("contact", "--load", "0 N", "--speed", "-1 km/h", "--creepage", "x", "--json")
    assert [error["where"] for error in json.loads(done.stdout)["errors"]] == [
        "--load",
        "--speed",
        "--creepage",
    ]


def test_an_unwritable_folder_leaves_nothing(railgrip: Command, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    for out in ("file", "file/below"):
        done = railgrip("contact", "--out", out)
        assert done.returncode == 2
        assert "cannot write here" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_lists_of_laws(railgrip: Command) -> None:
    assert (
        "fastsim_1982"
        in json.loads(railgrip("list", "rolling-laws", "--json").stdout)["rolling-laws"]
    )
    assert "friction-laws" in json.loads(railgrip("list", "--json").stdout)
