import json
import math

import pytest

from railgrip.core.errors import RailgripError
from railgrip.data import names
from railgrip.io.toml_file import dump_toml, load, read_toml, schema
from railgrip.scenario import Scenario

TEXT = """
title = "A coach"
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
wheel_radius = "0.445 m"
brake = "disc"
[train.brakes.disc]
kind = "disc"
cylinder_pressure = "3.0 bar"
cylinder_area = "324 cm^2"
rigging_ratio = 5
friction_radius = "0.27 m"
pad = { law = "constant", friction = 0.35 }
[run]
speed = "36 km/h"
"""


def refused(source):
    with pytest.raises(RailgripError) as caught:
        load(source)
    lines = str(caught.value).splitlines()
    assert all(len(line) < 1000 for line in lines)
    return lines


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "base.toml").write_text(TEXT)
    return tmp_path


def test_text_file_dict_and_scenario_are_the_same(folder):
    from_text = load(TEXT)
    assert load(folder / "base.toml") == from_text
    assert load(str(folder / "base.toml")) == from_text
    assert load(read_toml(folder / "base.toml")) == from_text
    assert load(from_text) is from_text


def test_extends_lays_over(folder):
    (folder / "child.toml").write_text(
        'extends = "base.toml"\nrun.demand = 0.5\ntrain.max_speed = "160 km/h"\n'
    )
    (folder / "deep").mkdir()
    (folder / "deep" / "grandchild.toml").write_text(
        'extends = "../child.toml"\nrun.speed = "72 km/h"\n'
    )
    scenario = load(folder / "deep" / "grandchild.toml")
    assert scenario.run.speed == 20.0
    assert scenario.run.demand[0].level == 0.5
    assert scenario.train.n_axles == 4


def test_extends_in_a_circle(folder):
    (folder / "a.toml").write_text('extends = "b.toml"')
    (folder / "b.toml").write_text('extends = "a.toml"')
    assert refused(folder / "a.toml") == [
        "extends: the files extend each other in a circle; got a.toml → b.toml → a.toml"
    ]


def test_files_are_named_from_the_file_that_names_them(folder):
    (folder / "parts").mkdir()
    (folder / "parts" / "pad.toml").write_text('law = "constant"\nfriction = 0.2\n')
    (folder / "parts" / "train.toml").write_text(
        'extends = "emu_en14531"\nbrakes.disc.pad = "pad.toml"\n'
    )
    (folder / "run.toml").write_text('train = "parts/train.toml"')
    assert load(folder / "run.toml").train.brakes["disc"].pad.friction == 0.2


def test_problem_in_a_file_that_is_named(folder):
    (folder / "run.toml").write_text('train = "no_such_train.toml"')
    (line,) = refused(folder / "run.toml")
    assert line.startswith("train: ")
    assert line.endswith("no_such_train.toml: there is no such file")


def test_unknown_scenario_name():
    (line,) = refused("no_such_scenario")
    assert "scenario 'no_such_scenario' unknown" in line


@pytest.mark.parametrize(
    ("raw", "message"),
    [
        (b"", "train: is missing"),
        (TEXT.encode()[:300], "is not valid TOML"),
        (b"[run]\nspeed = \n", "Invalid value (at line 2, column 9)"),
        (b"\x89PNG\r\n\x1a\n\0\0\0", "is not a text file"),
        ("speed = 'Straße'".encode("latin-1"), "is not UTF-8 text (at line 1, column 14)"),
        (b"a = " + b"[" * 100_000, "is nested too deeply"),
        (b"a." * 50_000 + b"a = 1", "has a key of very many parts"),
        (b"a = " + b"{b=" * 60 + b"1" + b"}" * 60, "is nested too deeply"),
        (b"a = " + b"9" * 10_000, "is not valid TOML"),
        (b"a = 0x" + b"f" * 10_000, "a: unknown key"),
        (b"a = 1979-13-45", "is not valid TOML"),
        (b"a = 1\na = 2", "Cannot overwrite a value"),
    ],
)
def test_broken_file_is_one_sentence(tmp_path, raw, message):
    path = tmp_path / "run.toml"
    path.write_bytes(raw)
    assert any(message in line for line in refused(path)), refused(path)


def test_missing_file_folder_and_unreadable_name(tmp_path):
    assert refused(tmp_path / "run.toml")[0].endswith("run.toml: there is no such file")
    assert "is a folder" in refused(tmp_path)[0]
    assert refused("x" * 5000 + ".toml")
    assert refused("a\0b.toml")
    assert refused("")


def test_200_gb_file_is_refused_unread(tmp_path):
    """Sparse, so that it costs no disk; no memory would hold what reading it gives."""
    path = tmp_path / "huge.toml"
    with path.open("wb") as file:
        file.truncate(200_000_000_000)
    (line,) = refused(path)
    assert line.endswith(
        "huge.toml: is too large to be a description; got 200000.0 MB; allowed: up to 5 MB"
    )


def test_problem_stays_on_one_line():
    (line,) = refused({**read(TEXT), "rail": {"condition": "wet\nleaves"}})
    assert r"rail condition 'wet\nleaves' unknown" in line


def test_values_of_the_wrong_kind():
    table = {"train": 5, "run": [], "title": 3, "rail": True, "line": 1.5, "limits": "x"}
    lines = refused(table)
    assert len(lines) == 6
    assert "run: must be a table; got a list of 0" in lines


def test_thousands_of_problems_are_cut_short():
    lines = refused({**read(TEXT), **{f"key{i}": i for i in range(5000)}})
    assert len(lines) == 51
    assert lines[-1] == "and 4950 more problems"


def read(text):
    import tomllib

    return tomllib.loads(text)


def test_dump_loads_back():
    scenario = load(TEXT).with_(
        {"wsp.parameters": {"slip": "20 %"}},
        rail={
            "condition": "leaves",
            "patch": [{"from": 100, "to": "0.2 km", "condition": "oil"}],
            "random": {"mean": 0.07, "spread": 0.02, "correlation_length": 100},
        },
        run={"demand": [{"at": 0, "level": "service"}, {"at": 5, "level": "emergency"}]},
        limits={"stopping_distance": 900},
    )
    assert load(dump_toml(scenario)) == scenario
    assert Scenario.model_validate(json.loads(scenario.model_dump_json())) == scenario


def test_dump_writes_what_is_alike_once():
    text = dump_toml(load(TEXT))
    assert text.count("[[train.vehicle.bogie]]") == 1
    assert text.count("wheelbase") == 1


@pytest.mark.parametrize("name", names("trains"))
def test_every_shipped_train_loads_and_dumps_back(name):
    scenario = load({"train": name})
    assert load(dump_toml(scenario)) == scenario


@pytest.mark.parametrize("kind", ["scenario", "train", "line", "rail_condition"])
def test_schema_is_json_and_knows_units_and_ranges(kind):
    found = json.loads(json.dumps(schema(kind)))
    assert found["$schema"].endswith("2020-12/schema")
    assert "extends" in found["properties"]
    assert all(
        math.isfinite(node.get("maximum", 0)) and "description" in node
        for definition in [found, *found.get("$defs", {}).values()]
        for node in definition.get("properties", {}).values()
        if "const" not in node
    )


def test_schema_of_a_length():
    length = schema("line")["properties"]["length"]
    assert length["type"] == ["number", "string"]
    assert length["exclusiveMinimum"] == 0
    assert length["description"] == "Length of the line. [m, or a text with a unit]"


def test_unknown_schema():
    with pytest.raises(RailgripError, match="did you mean 'train'"):
        schema("trian")
