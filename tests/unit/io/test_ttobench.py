import json
import math

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from railgrip import data
from railgrip.core.errors import RailgripError
from railgrip.io.ttobench import read_ttobench_track

KMH = 1 / 3.6

# tracks.csv of TTOBench v1.5: speed limits km/h, gradients ‰, least radius m, length m.
PUBLISHED = {
    "fribourg_bern": (40, 140, -16.9, 14.1, math.inf, 31240.7),
    "st_gallen_wil": (80, 125, -15.4, 15.9, 340.1, 29556.1),
    "stadelhofen_altstetten": (80, 125, -38.0, 28.0, math.inf, 5790.0),
    "songjiazhuang_yizhuang": (50, 84, -24.0, 24.0, math.inf, 22728.0),
    "vasteras_kolback": (110, 200, -16.7, 10.8, math.inf, 19305.4),
    "var_speed_limit_wind": (50, 120, 0.0, 0.0, math.inf, 20000.0),
    "var_gradient_minusplus_6": (140, 140, -6.67, 6.67, math.inf, 48531.0),
}


def track(**changes):
    """Return a small correct track with some fields replaced (None: left out)."""
    document = {
        "metadata": {"id": "XX_Test", "library version": "TTOBench v1.5", "license": "none"},
        "altitude": {"unit": "m", "value": 400.0},
        "stops": {"unit": "m", "values": [0.0, 1000.0]},
        "speed limits": {
            "units": {"position": "m", "velocity": "km/h"},
            "values": [[0.0, 90], [500.0, 36]],
        },
        "gradients": {
            "units": {"position": "m", "slope": "permil"},
            "values": [[0.0, 5.0], [300.0, -12.0]],
        },
        "curvatures": {
            "units": {"position": "m", "radius at start": "m", "radius at end": "m"},
            "values": [
                [0.0, "infinity", "infinity"],
                [200.0, "infinity", -400.0],
                [300.0, -400.0, -400.0],
                [600.0, -400.0, "infinity"],
                [700.0, "infinity", "infinity"],
            ],
        },
    }
    document.update({key.replace("_", " "): value for key, value in changes.items()})
    return {key: value for key, value in document.items() if value is not None}


@pytest.fixture
def read(tmp_path):
    def read(document):
        path = tmp_path / "track.json"
        text = document if isinstance(document, str) else json.dumps(document)
        path.write_text(text, encoding="utf-8")
        return read_ttobench_track(path)

    return read


@pytest.mark.parametrize("name", PUBLISHED)
def test_real_tracks_have_the_published_extremes(name):
    slowest, fastest, steepest_down, steepest_up, tightest, length = PUBLISHED[name]
    line = read_ttobench_track(data.path("lines", name))
    limits = [limit.value for limit in line.speed_limit]
    slopes = [point.value for point in line.gradient]
    assert line.length == length
    assert (min(limits), max(limits)) == pytest.approx((slowest * KMH, fastest * KMH))
    assert (min(slopes), max(slopes)) == pytest.approx((steepest_down / 1e3, steepest_up / 1e3))
    assert min((curve.radius for curve in line.curve), default=math.inf) == pytest.approx(tightest)


def test_units_are_those_of_the_file(read):
    line = read(
        track(
            stops={"unit": "km", "values": [0, 1.2]},
            speed_limits={
                "units": {"position": "km", "velocity": "m/s"},
                "values": [[0, 25], [0.5, 10]],
            },
            gradients={"units": {"position": "m", "slope": "%"}, "values": [[0, 1.5]]},
        )
    )
    assert line.length == 1200.0
    assert [(limit.at, limit.value) for limit in line.speed_limit] == [(0.0, 25.0), (500.0, 10.0)]
    assert line.gradient[0].value == pytest.approx(0.015)


def test_title_and_source_come_from_the_metadata(read):
    line = read(track())
    assert line.title == "XX Test"
    assert line.source == "TTOBench v1.5, none"


def test_gradients_and_curves_may_be_left_out(read):
    line = read(track(gradients=None, curvatures=None))
    assert line.gradient == ()
    assert line.curve == ()


def test_a_clothoid_keeps_the_angle_it_turns(read):
    # Curvature rises evenly over 100 m to 1/400, stays for 300 m, falls over 100 m:
    # the angle is (50 + 300 + 50)/400 = 1 rad.
    curves = read(track()).curve
    angle = sum((curve.end - curve.begin) / curve.radius for curve in curves)
    assert angle == pytest.approx(1.0, rel=1e-12)
    assert min(curve.radius for curve in curves) == pytest.approx(400.0)
    assert curves[0].begin == 200.0
    assert curves[-1].end == 700.0
    radii = [curve.radius for curve in curves[:10]]
    assert radii == sorted(radii, reverse=True)


def test_a_clothoid_may_change_hands(read):
    reverse = track()
    reverse["curvatures"]["values"] = [[0.0, 500.0, -500.0]]
    curves = read(reverse).curve
    # |curvature| goes 1/500 → 0 → 1/500 over 1 km: half of 1000/500 rad.
    assert sum((c.end - c.begin) / c.radius for c in curves) == pytest.approx(1.0, rel=1e-3)


def stops(*values, unit="m"):
    return {"stops": {"unit": unit, "values": list(values)}}


def limits(*values, position="m", velocity="km/h"):
    units = {"position": position, "velocity": velocity}
    return {"speed_limits": {"units": units, "values": list(values)}}


def gradients(*values):
    units = {"position": "m", "slope": "permil"}
    return {"gradients": {"units": units, "values": list(values)}}


def curvatures(*values):
    units = {"position": "m", "radius at start": "m", "radius at end": "m"}
    return {"curvatures": {"units": units, "values": list(values)}}


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"stops": None}, "stops: is missing, or has no values"),
        ({"stops": [0, 1]}, "stops: is missing, or has no values"),
        (stops(), "stops: is missing, or has no values"),
        (stops(0.0), "stops: must begin with 0 and ascend"),
        (stops(5.0, 9.0), "stops: must begin with 0 and ascend"),
        (stops(0.0, 900.0, 900.0), "stops: must begin with 0 and ascend"),
        (stops(0.0, "far"), r"stops.values\[1\]: must hold numbers; got 'far'"),
        (stops(0.0, "infinity"), r"stops.values\[1\]: must have a finite position"),
        (stops(0.0, True), r"stops.values\[1\]: must hold numbers; got True"),
        (stops(0.0, None), r"stops.values\[1\]: must hold numbers; got None"),
        (stops(0.0, 10**400), r"stops.values\[1\]: must hold numbers"),
        (stops(0.0, 9.0, unit="mile"), r"stops.units.position: unknown unit; got 'mile'; allowed"),
        ({"speed_limits": None}, "speed limits: is missing, or has no values"),
        (limits([0, 90], velocity="kn"), "speed limits.units.velocity: unknown unit; got 'kn'"),
        (limits([0, 90], velocity=None), "speed limits.units.velocity: unknown unit; got None"),
        (limits([10.0, 90]), r"speed limits.values\[0\]: must begin at position 0; got 10 m"),
        (limits([0.0, 90, 3]), r"speed limits.values\[0\]: must have 2 entries"),
        (limits(90), r"speed limits.values\[0\]: must have 2 entries"),
        (limits([0.0, -90]), r"speed_limit\[0\].value: is out of range; got -90 km/h"),
        (limits([0, 90], [9, 80], [8, 70]), r"speed_limit\[2\].at: must lie beyond"),
        (limits([0, 90], [9000, 80]), r"speed_limit\[1\].at: lies beyond the end of the line"),
        (gradients([0, 400.0]), r"gradient\[0\].value: is out of range; got 400 ‰"),
        (curvatures([0, 0, 0]), "curvatures: must not hold a radius of 0"),
        (curvatures([0, 3, 3]), r"curve\[0\].radius: is out of range; got 3 m"),
        (curvatures([0, 400, 400], [50, 300, 300], [20, 500, 500]), r"curve\[1\].to: must lie"),
    ],
)
def test_malformed_fields_get_one_sentence(read, change, sentence):
    with pytest.raises(RailgripError, match=sentence) as caught:
        read(track(**change))
    assert "track.json: " in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "is not valid JSON"),
        (json.dumps(track())[:-40], "is not valid JSON"),
        ("[1, 2]", "must hold a JSON object"),
        ("null", "must hold a JSON object"),
        (json.dumps(track(**stops(0.0, math.nan))), "holds a number that is none; got NaN"),
        ("[" * 100_000, "nested too deeply"),
        ('{"a":' * 60 + "1" + "}" * 60, "nested too deeply"),
        ("{}", "stops: is missing, or has no values"),
    ],
)
def test_broken_files_get_one_sentence(read, text, sentence):
    with pytest.raises(RailgripError, match=sentence) as caught:
        read(text)
    assert "\n" not in str(caught.value)


def test_missing_and_huge_files(tmp_path):
    with pytest.raises(RailgripError, match="there is no such file"):
        read_ttobench_track(tmp_path / "nowhere.json")
    huge = tmp_path / "huge.json"
    with huge.open("wb") as file:
        file.truncate(200_000_000)
    with pytest.raises(RailgripError, match="is too large"):
        read_ttobench_track(huge)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner),
    max_leaves=8,
)


@settings(
    max_examples=80, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.sampled_from(sorted(track())), st.sampled_from(["", "units", "values", "unit"]), JSON)
def test_whatever_stands_in_a_field_is_read_or_refused(read, field, inner, value):
    document = track()
    if inner:
        document[field][inner] = value
    else:
        document[field] = value
    try:
        line = read(document)
    except RailgripError as error:
        assert str(error)  # noqa: PT017 - both outcomes are right, anything else is not
    else:
        assert line.length > 0
