import contextlib
import json
import math

import pytest

from railgrip import data
from railgrip.core.errors import RailgripError
from railgrip.io.importing import read_any
from railgrip.io.line_csv import read_line_csv
from railgrip.io.osrd import read_osrd_line, read_osrd_train
from railgrip.io.railml import read_railml
from railgrip.io.railtoolkit import read_railtoolkit_train
from railgrip.io.railtoolkit_path import read_railtoolkit_path
from railgrip.io.ttobench_train import read_ttobench_journey, read_ttobench_train

RAILML_2 = """<?xml version="1.0"?>
<railml xmlns="https://www.railml.org/schemas/2018" version="2.4">
<infrastructure>
<tracks>
<track id="t1">
<trackTopology>
<trackBegin id="b" pos="100"/>
<trackEnd id="e" pos="2100"/>
</trackTopology>
<trackElements>
<speedChanges>
<speedChange id="s" pos="100" dir="up" vMax="100"/>
<speedChange id="s2" pos="900" dir="up" vMax="60"/>
<speedChange id="s3" pos="500" dir="down" vMax="30"/>
</speedChanges>
<gradientChanges>
<gradientChange id="g" pos="600" slope="-12.5"/>
</gradientChanges>
<radiusChanges>
<radiusChange id="r" pos="1100" radius="-300"/>
<radiusChange id="r2" pos="1400" radius="0"/>
</radiusChanges>
</trackElements>
</track>
</tracks>
</infrastructure>
</railml>"""

RAILML_3 = """<?xml version="1.0"?>
<railML xmlns="https://www.railml.org/schemas/3.2" version="3.2">
<infrastructure>
<topology>
<netElements>
<netElement id="ne1" length="3000"/>
</netElements>
</topology>
<functionalInfrastructure>
<speedSections>
<speedSection id="a" maxSpeed="120">
<linearLocation>
<associatedNetElement netElementRef="ne1"
posBegin="0" posEnd="1000"/>
</linearLocation>
</speedSection>
<speedSection id="b" maxSpeed="80">
<linearLocation>
<associatedNetElement netElementRef="ne1" posBegin="1000" posEnd="3000"/>
</linearLocation>
</speedSection>
</speedSections>
</functionalInfrastructure>
<geometry>
<gradientCurves>
<gradientCurve id="g"
gradient="5">
<linearLocation>
<associatedNetElement netElementRef="ne1" posBegin="500" posEnd="3000"/>
</linearLocation>
</gradientCurve>
</gradientCurves>
</geometry>
</infrastructure>
</railML>"""


@pytest.fixture
def written(tmp_path):
    def write(name, content):
        path = tmp_path / name
        text = content if isinstance(content, str) else json.dumps(content)
        path.write_text(text, encoding="utf-8")
        return path

    return write


def osrd_train(**changes):
    document = {
        "name": "unit",
        "railjson_version": "3.2",
        "mass": 200e3,
        "length": 100.0,
        "max_speed": 40.0,
        "inertia_coefficient": 1.05,
        "comfort_acceleration": 0.4,
        "const_gamma": 0.6,
        "rolling_resistance": {"type": "davis", "A": 2000.0, "B": 30.0, "C": 8.0},
        "effort_curves": {
            "default_mode": "25000V",
            "modes": {
                "25000V": {"default_curve": {"speeds": [0, 10, 40], "max_efforts": [2e5, 2e5, 5e4]}}
            },
        },
    }
    return document | changes


def osrd_infra(**changes):
    def track(name, length, **more):
        return {"id": name, "length": length, **more}

    document = {
        "version": "3.4.12",
        "track_sections": [
            track("TA", 1000, slopes=[{"begin": 0, "end": 1000, "gradient": 6}], curves=[]),
            track("TB", 500, slopes=[{"begin": 0, "end": 200, "gradient": 10}],
                  curves=[{"begin": 100, "end": 300, "radius": -400}]),
        ],
        "speed_sections": [
            {"id": "all", "speed_limit": 30.0, "track_ranges": [
                {"track": "TA", "begin": 0, "end": 1000, "applicable_directions": "BOTH"},
                {"track": "TB", "begin": 0, "end": 500, "applicable_directions": "BOTH"}]},
            {"id": "slow", "speed_limit": 15.0, "track_ranges": [
                {"track": "TA", "begin": 800, "end": 1000, "applicable_directions": "BOTH"}]},
        ],
    }  # fmt: skip
    return document | changes


def points(entries):
    return [(point.at, round(point.value, 9)) for point in entries]


def test_railml_2(written):
    line = read_railml(written("line.railml", RAILML_2))
    assert line.length == 2000.0
    assert points(line.speed_limit) == [(0.0, round(100 / 3.6, 9)), (800.0, round(60 / 3.6, 9))]
    assert points(line.gradient) == [(500.0, -0.0125)]
    assert [(c.begin, c.end, c.radius) for c in line.curve] == [(1000.0, 1300.0, 300.0)]


def test_railml_3(written):
    line = read_railml(written("line.xml", RAILML_3))
    assert line.length == 3000.0
    assert points(line.speed_limit) == [(0.0, round(120 / 3.6, 9)), (1000.0, round(80 / 3.6, 9))]
    assert points(line.gradient) == [(500.0, 0.005)]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (RAILML_2.replace("<railml", "<!DOCTYPE x [<!ENTITY a 'b'>]><railml", 1), "document type"),
        (RAILML_2.replace('"2.4"', '"1.1"'), r"version: is none that can be read .*got '1.1'"),
        (RAILML_2.replace("<railml", "<osm").replace("</railml", "</osm"), "root element 'osm'"),
        (RAILML_2[:400], "is not valid XML"),
        (RAILML_2.replace('pos="2100"', 'pos="far"'), "trackEnd.pos: must be a number; got 'far'"),
        (RAILML_2.replace('vMax="60"', 'vMax="0"'), "speed_limit"),
        ("", "is empty|is not valid XML"),
    ],
)
def test_bad_railml(written, text, sentence):
    with pytest.raises(RailgripError, match=sentence):
        read_railml(written("line.xml", text))


RAILML_31 = """<?xml version="1.0"?>
<railML xmlns="https://www.railml.org/schemas/3.1" version="3.1">
<infrastructure>
<topology>
<netElements>
<netElement id="n1" length="800">
<associatedPositioningSystem id="a1">
<intrinsicCoordinate id="i0" intrinsicCoord="0">
<linearCoordinate positioningSystemRef="km" measure="1500"/>
</intrinsicCoordinate>
<intrinsicCoordinate id="i1" intrinsicCoord="1">
<linearCoordinate positioningSystemRef="km" measure="2300"/>
</intrinsicCoordinate>
</associatedPositioningSystem>
</netElement>
<netElement id="n2"/>
</netElements>
</topology>
<functionalInfrastructure>
<speeds>
<speedSection id="s1" vMax="90">
<linearLocation id="l1" applicationDirection="normal">
<associatedNetElement netElementRef="n1">
<linearCoordinateBegin positioningSystemRef="km" measure="1500"/>
</associatedNetElement>
<associatedNetElement netElementRef="n2" fromPos="0"/>
</linearLocation>
</speedSection>
<speedSection id="s2" vMax="45">
<linearLocation id="l2" applicationDirection="both">
<associatedNetElement netElementRef="n1">
<linearCoordinateBegin positioningSystemRef="km" measure="2100"/>
</associatedNetElement>
</linearLocation>
</speedSection>
<speedSection id="s3" vMax="20">
<linearLocation id="l3" applicationDirection="reverse">
<associatedNetElement netElementRef="n1" fromPos="100"/>
</linearLocation>
</speedSection>
<speedSection id="s4" vMax="10" isTemporary="true">
<linearLocation id="l4" applicationDirection="normal">
<associatedNetElement netElementRef="n1" fromPos="200"/>
</linearLocation>
</speedSection>
</speeds>
<tracks>
<track id="t2">
<linearLocation id="l5">
<associatedNetElement netElementRef="n2"/>
</linearLocation>
<length type="physical" value="1224.45"/>
</track>
</tracks>
</functionalInfrastructure>
</infrastructure>
</railML>"""


def test_railml_3_by_linear_coordinates(written):
    """Shape of railML 3.1 exports: measures of a system, lengths at the tracks, both directions."""
    file = written("line.xml", RAILML_31)
    first, second = read_railml(file, "n1"), read_railml(file, "n2")
    assert points(first.speed_limit) == [(0.0, 25.0), (600.0, 12.5)]
    assert second.length == pytest.approx(1224.45)
    assert points(second.speed_limit) == [(0.0, 25.0)]


def test_unknown_track_names_the_known(written):
    with pytest.raises(RailgripError, match="track 't2' unknown; allowed: t1"):
        read_railml(written("line.xml", RAILML_2), "t2")


def test_osrd_train(written):
    train = read_osrd_train(written("unit.json", osrd_train()))
    assert (train.mass, train.rotating, train.max_deceleration) == (200e3, pytest.approx(0.05), 0.6)
    assert [(p.speed, p.force) for p in train.effort.table][-1] == (40.0, 5e4)


def test_osrd_line_there_and_back(written):
    file = written("infra.json", osrd_infra())
    there, back = read_osrd_line(file, ["TA", "TB"]), read_osrd_line(file, ["-TB", "-TA"])
    assert there.length == back.length == 1500.0
    assert points(there.speed_limit) == [(0.0, 30.0), (800.0, 15.0), (1000.0, 30.0)]
    assert points(back.speed_limit) == [(0.0, 30.0), (500.0, 15.0), (700.0, 30.0)]
    assert points(there.gradient) == [(0.0, 0.006), (1000.0, 0.01), (1200.0, 0.0)]
    assert points(back.gradient) == [(0.0, 0.0), (300.0, -0.01), (500.0, -0.006)]
    assert [(c.begin, c.end) for c in there.curve] == [(1100.0, 1300.0)]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"railjson_version": "2.1"}, "railjson_version: is none that can be read; got 2"),
        ({"mass": "heavy"}, "mass: must be a number; got 'heavy'"),
        ({"effort_curves": {}}, "effort_curves.modes: is missing"),
        ({"const_gamma": None}, "const_gamma: is missing"),
    ],
)
def test_bad_osrd_trains(written, change, sentence):
    with pytest.raises(RailgripError, match=sentence):
        read_osrd_train(written("unit.json", osrd_train(**change)))


def test_osrd_limits_with_gaps_and_unknown_sections(written):
    infra = osrd_infra()
    infra["speed_sections"][0]["track_ranges"].pop()
    with pytest.raises(
        RailgripError, match="speed_sections: leave a gap; got no limit from 1000 m"
    ):
        read_osrd_line(written("infra.json", infra), ["TA", "TB"])
    infra["speed_sections"] = []  # most example infrastructures have none
    assert read_osrd_line(written("infra.json", infra), ["TA"]).speed_limit == ()
    with pytest.raises(RailgripError, match="section 'TX' unknown; allowed: TA, TB"):
        read_osrd_line(written("infra.json", osrd_infra()), ["TX"])


def test_csv(written):
    text = "position_km;speed_kmh;gradient_permille;stop\n2;80;0;A\n2.5;;5;\n3;60;;\n4.2;;;B\n"
    line = read_line_csv(written("line.csv", text))
    assert line.length == pytest.approx(2200.0)
    assert points(line.speed_limit) == [(0.0, round(80 / 3.6, 9)), (1000.0, round(60 / 3.6, 9))]
    assert [stop.name for stop in line.stop] == ["A", "B"]
    with pytest.raises(RailgripError, match="line 3, speed_kmh: must be a number; got 'fast'"):
        read_line_csv(written("line.csv", "position_m,speed_kmh\n0,80\n100,fast\n"))
    with pytest.raises(RailgripError, match="needs a header with position_m"):
        read_line_csv(written("line.csv", "x,y\n0,80\n"))


def test_formation_from_rolling_stock():
    """Three loaded wagons behind a locomotive, from the vehicles' own files."""
    engine, wagon = (data.path("rolling_stock", name) for name in ("db_v90", "facs124"))
    train = read_railtoolkit_train(engine, ["DB_V90", *["Facs124"] * 3], [wagon])
    assert train.mass == pytest.approx(80e3 + 3 * 84e3)
    assert train.length == pytest.approx(14.32 + 3 * 19.04)
    expected = 9.81e-3 * (2.2 * 80e3 + 1.4 * 3 * 84e3 + 10.0 * 80e3 * 0.15**2)
    assert train.resistance.constant == pytest.approx(expected)
    with pytest.raises(RailgripError, match="vehicle 'Facs125' unknown; allowed: DB_V90"):
        read_railtoolkit_train(engine, ["DB_V90", "Facs125"])


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('"2022.05"', '"2023.01"', "schema_version: is none that can be read; got '2023.01'"),
        ("running-path.json", "timetable.json", "schema: is not that of a running-path file"),
        ("characteristic_sections", "sections", "characteristic_sections: must hold rows"),
        ("paths:", "paths: [", "is not valid YAML"),
    ],
)
def test_bad_railtoolkit_paths(written, old, new, sentence):
    text = data.path("lines", "const").read_text(encoding="utf-8")
    with pytest.raises(RailgripError, match=sentence):
        read_railtoolkit_path(written("path.yaml", text.replace(old, new)))


def test_running_path_of_2024(written):
    """Sections are tables; a speed or resistance that is left out goes on as it was."""
    text = """%YAML 1.2
---
schema: https://railtoolkit.org/schema/running-path.json
schema_version: "2024.07"
paths:
  - id: north
    characteristic_sections:
      - {position: 500.0, speed: 90, resistance: 2.0}
      - {position: 900.0, resistance: -4.0}
      - {position: 1700.0, speed: 45}
      - {position: 2500.0}
"""
    line = read_railtoolkit_path(written("path.yaml", text))
    assert line.length == 2000.0
    assert points(line.speed_limit) == [(0.0, 25.0), (1200.0, 12.5)]
    assert points(line.gradient) == [(0.0, 0.002), (400.0, -0.004)]
    with pytest.raises(RailgripError, match="characteristic_sections: must hold rows"):
        read_railtoolkit_path(written("path.yaml", text.replace("speed: 90, ", "")))


def test_ttobench_trains_and_journey(written):
    train = read_ttobench_train(data.path("point_trains", "flirt_tpf"))
    assert train.resistance.quadratic == pytest.approx(0.00093264e3 * 12.96)
    assert train.tunnel_quadratic(25.0) == pytest.approx(0.0011698e3 * 12.96)
    document = json.loads(data.path("point_trains", "virm6").read_text(encoding="utf-8"))
    document["metadata"]["library version"] = "TTOBench v2.0"
    with pytest.raises(RailgripError, match=r"library version: is none .* got 'TTOBench v2.0'"):
        read_ttobench_train(written("train.json", document))
    timed = read_ttobench_journey(data.path("journeys", "st_gallen_wil_01"))
    assert timed.track == "CH_StGallen_Wil"
    assert timed.arrival[-1] == (1400.0, 1450.0)


@pytest.mark.parametrize(
    ("kind", "name"),
    [("lines", "realworld"), ("lines", "fribourg_bern"), ("point_trains", "virm6"),
     ("point_trains", "freight"), ("journeys", "st_gallen_wil_01")],
)  # fmt: skip
def test_what_is_imported_comes_back_from_toml(kind, name, written):
    import tomli_w

    from railgrip.scenario.files import read_table
    from railgrip.scenario.line import Line
    from railgrip.scenario.point_train import PointTrain

    found = read_any(data.path(kind, name))
    table = read_table(written("it.toml", tomli_w.dumps(found.table)))
    model = {"line": Line, "point train": PointTrain}.get(found.kind)
    if model is not None:
        again = model.model_validate(table).model_dump(by_alias=True, exclude_defaults=True)
        assert again == model.model_validate(found.table).model_dump(
            by_alias=True, exclude_defaults=True
        )
    else:
        assert len(table["stop"]) == 3


def test_ttobench_passing_points(written):
    file = data.path("journeys", "st_gallen_wil_01")
    shipped = read_ttobench_journey(file).passing
    assert shipped
    assert all(0.0 < point.at < 29556.1 for point in shipped)
    document = json.loads(file.read_text(encoding="utf-8"))
    document["timing points"]["values"].insert(1, [123.0, 30.0, None, 0.0, 80.0])
    path = written("journey.json", document)
    first = read_ttobench_journey(path).passing[0]
    unit = document["timing points"]["units"]["upper speed constraint"]
    assert (first.at, first.earliest) == (123.0, 30.0)
    assert first.fastest == pytest.approx(80.0 / {"km/h": 3.6, "m/s": 1.0}[unit])
    assert math.isnan(first.latest)
    count = len(shipped) + 1
    assert read_any(path).summary.endswith(
        f"{count} passing points have no place in a journey, left out"
    )


def test_a_format_that_is_not_known(written):
    with pytest.raises(RailgripError, match="is of no known format; allowed: JSON"):
        read_any(written("notes.json", {"a": 1}))
    with pytest.raises(RailgripError, match="is of no known format; allowed: JSON"):
        read_any(written("line.kml", "x"))


JUNK = [None, True, -1.0, 1e30, float("nan"), "", "x" * 300, [], {}, [[1, 2]], {"a": 1}, "\x00"]


def leaves(value, place=()):
    """Return the places of all values below a value."""
    entries = (
        value.items()
        if isinstance(value, dict)
        else enumerate(value)
        if isinstance(value, list)
        else ()
    )
    found = [place]
    for key, below in entries:
        found += leaves(below, (*place, key))
    return found


def spoiled(document, place, junk):
    """Return a document with one value replaced."""
    if not place:
        return junk
    copy = json.loads(json.dumps(document))
    inner = copy
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = junk
    return copy


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    "source",
    ["osrd_train", "osrd_infra", "flirt_tpf", "st_gallen_wil_01", "local", "const"],
)
def test_whatever_is_spoiled_gets_a_sentence(written, source, seed):
    """One value of a correct file replaced by junk: a model, or sentences, and no other error."""
    import random

    import yaml

    made = {"osrd_train": osrd_train, "osrd_infra": osrd_infra}
    kinds = {"flirt_tpf": "point_trains", "st_gallen_wil_01": "journeys", "local": "point_trains"}
    ending = "json"
    if source in made:
        document = made[source]()
    else:
        file = data.path(kinds.get(source, "lines"), source)
        ending = file.suffix[1:]
        document = yaml.safe_load(file.read_text(encoding="utf-8"))
    draw = random.Random(seed)
    places = leaves(document)
    for k in range(60):
        bad = spoiled(document, draw.choice(places), draw.choice(JUNK))
        text = yaml.safe_dump(bad) if ending == "yaml" else json.dumps(bad)
        with contextlib.suppress(RailgripError):
            read_any(written(f"{k}.{ending}", text))
