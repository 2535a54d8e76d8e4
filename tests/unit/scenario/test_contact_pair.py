"""Pairs of wheel and rail: all that are shipped work, and what is wrong gets a sentence."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from railgrip.contact.rectangular_patch import rectangular_patch
from railgrip.contact.rolling_contact import rolling_contact
from railgrip.core.errors import RailgripError
from railgrip.scenario import library
from railgrip.scenario.contact_pair import contact_of_pair, contact_pair, rectangle_of_pair

RECTANGULAR = {"cone_on_worn_rail"}


@pytest.mark.parametrize("name", sorted(set(library.names("contact_pair")) - RECTANGULAR))
def test_every_shipped_pair_makes_a_contact(name: str) -> None:
    contact = contact_of_pair(name, 100e3)
    assert 2e-3 < contact.a < 20e-3
    assert 2e-3 < contact.b < 20e-3
    with pytest.raises(RailgripError, match="is an ellipse, not a rectangle"):
        rectangle_of_pair(name, 100e3)


@pytest.mark.parametrize("name", sorted(RECTANGULAR))
def test_every_pair_with_a_worn_rail_makes_a_rectangle(name: str) -> None:
    found = rectangle_of_pair(name, 100e3)
    assert found == rectangular_patch(100e3, 0.46, 0.02, 210e9, 0.28)
    with pytest.raises(RailgripError, match="is a rectangle, not an ellipse"):
        contact_of_pair(name, 100e3)


def test_the_base_case_by_name() -> None:
    base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    assert contact_of_pair("cone_on_head", 100e3) == base
    assert contact_of_pair(contact_pair("cone_on_head"), 100e3) == base


def write(folder: Path, text: str) -> Path:
    file = folder / "pair.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_a_pair_may_extend_a_shipped_one(tmp_path: Path) -> None:
    file = write(tmp_path, 'extends = "s1002_new"\nwheel.s1002_position = "10 mm"\n')
    assert contact_pair(file).wheel.s1002_position == pytest.approx(0.01)
    assert contact_of_pair(file, 100e3).b < contact_of_pair("s1002_new", 100e3).b


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ('[wheel]\nradius = "0 m"\n[rail]\nhead_radius = 0.3', r"wheel\.radius: is out of range"),
        ("[wheel]\nradius = 0.46", "rail: is missing"),
        ("[wheel]\nradius = 0.46\n[rail]", "touches along a line"),
        ("[wheel]\nradius = 0.46\n[rail]\nhead_radius = 0", "head_radius: must not be zero"),
        (
            "[wheel]\nradius = 0.46\ntransverse_radius = 0\n[rail]\nhead_radius = 0.3",
            "transverse_radius: must not be zero",
        ),
        (
            "[wheel]\nradius = 0.46\n[rail]\nhead_radius = 0.3\nworn_width = 0.02",
            r"rail\.worn_width: excludes head_radius",
        ),
        (
            "[wheel]\nradius = 0.46\ntransverse_radius = 1\ns1002_position = 0\n[rail]",
            r"wheel\.s1002_position: excludes transverse_radius",
        ),
        (
            "[wheel]\nradius = 0.46\ns1002_position = 0\n[rail]\nworn_width = 0.02",
            r"rail\.worn_width: needs a straight tread",
        ),
        (
            '[wheel]\nradius = 0.46\ns1002_position = "61 mm"\n[rail]\nhead_radius = 0.3',
            r"wheel\.s1002_position: is out of range",
        ),
        (
            '[wheel]\nradius = 0.46\n[rail]\nhead_radius = 0.3\n[x]\nyoung = "210 kN"',
            "x: unknown key",
        ),
        ('young = "210 kN"\n[wheel]\nradius = 1\n[rail]\nhead_radius = 1', "young: has a unit"),
    ],
)
def test_a_wrong_file_gets_a_sentence(tmp_path: Path, text: str, sentence: str) -> None:
    with pytest.raises(RailgripError, match=sentence):
        contact_pair(write(tmp_path, text))


def test_a_wrong_name_gets_the_nearest() -> None:
    with pytest.raises(RailgripError, match=r"contact pair 's1002_nw' unknown.*'s1002_new'\?"):
        contact_pair("s1002_nw")


def test_no_solution_names_place_and_radii(tmp_path: Path) -> None:
    file = write(tmp_path, 'extends = "s1002_new"\nwheel.s1002_position = "-8 mm"\n')
    with pytest.raises(RailgripError, match=r"S1002 at y = -8 mm is concave with 214\.2 mm"):
        contact_of_pair(file, 100e3)


@pytest.mark.parametrize("load", [0.0, -1e3, math.nan])
def test_no_load_no_contact(load: float) -> None:
    with pytest.raises(RailgripError, match="load must be positive"):
        contact_of_pair("cone_on_head", load)
    with pytest.raises(RailgripError, match="load must be positive"):
        rectangle_of_pair("cone_on_worn_rail", load)
