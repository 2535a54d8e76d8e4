"""A measured stop: what is read, what is refused, and what differs."""

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from railgrip.core.errors import RailgripError
from railgrip.io.measured import (
    MeasuredStop,
    compare_measured,
    read_channel_map,
    read_measured,
)

MAP = {
    "title": "Test 7",
    "time": {"column": "t"},
    "channel": [
        {"column": "v", "signal": "train_speed", "unit": "km/h"},
        {"column": "n3", "signal": "wheel_speed", "unit": "km/h", "axle": "C1-V1-B1-A2"},
    ],
}
GOOD = "t,v,n3\n0,72,72\n1,36,32.4\n2,0,0\n"


def with_(**changes):
    return read_channel_map({**MAP, **changes})


def read(tmp_path, text, **changes):
    path = tmp_path / "stop.csv"
    path.write_text(text, encoding="utf-8")
    return read_measured(path, with_(**changes))


def simulated():
    """20 m/s, brake from 1 s on with 1 m/s²; the second axle runs 1 m/s slower."""
    time = np.arange(0, 22.001, 0.1)
    speed = np.clip(21 - np.maximum(time, 1.0), 0, None)
    position = np.where(time < 1, 20 * time, 20 + 20 * (time - 1) - (time - 1) ** 2 / 2)
    position = np.minimum(position, 220.0)
    wheels = np.stack([speed, np.maximum(speed - 1, 0)])
    return xr.Dataset(
        {
            "train_speed": (("run", "time"), speed[None]),
            "train_position": (("run", "time"), 5000 + position[None]),
            "brake_demand": (("run", "time"), (time >= 1.0)[None].astype(float)),
            "wheel_speed": (("run", "axle", "time"), wheels[None]),
        },
        coords={"axle": ["C1-V1-B1-A1", "C1-V1-B1-A2"], "time": time},
    )


def stop_with(deceleration, start=20.0, command=10.0, **more):
    """A measured stop that begins to brake at `command`."""
    time = np.arange(0.0, command + start / deceleration + 0.05, 0.05)
    speed = np.clip(start - deceleration * np.maximum(time - command, 0), 0, None)
    return MeasuredStop("Test 7", time, {"train_speed": speed}, brake_command=command, **more)


# reading


def test_units_offset_and_scale(tmp_path):
    stop = read(tmp_path, GOOD)
    assert stop.title == "Test 7"
    assert stop.train["train_speed"] == pytest.approx([20, 10, 0])
    assert stop.axles["wheel_speed"]["C1-V1-B1-A2"] == pytest.approx([20, 9, 0])
    channels = [{"column": "v", "signal": "train_speed", "unit": "km/h", "scale": 2, "offset": 36}]
    stop = read(tmp_path, GOOD, channel=channels, time={"column": "t", "unit": "ms"})
    assert stop.train["train_speed"] == pytest.approx([50, 30, 10])
    assert stop.time == pytest.approx([0, 1e-3, 2e-3])


def test_degrees_bar_and_per_cent(tmp_path):
    channels = [
        {"column": "v", "signal": "train_speed", "unit": "m/s"},
        {"column": "a", "signal": "disc_temperature", "unit": "degF", "axle": "C1"},
        {"column": "b", "signal": "brake_cylinder_pressure", "unit": "bar", "axle": "C1"},
        {"column": "c", "signal": "brake_demand", "unit": "%"},
    ]
    stop = read(tmp_path, "t,v,a,b,c\n0,1,212,3.8,0\n1,0,32,0,100\n", channel=channels)
    assert stop.axles["disc_temperature"]["C1"] == pytest.approx([100, 0])
    assert stop.axles["brake_cylinder_pressure"]["C1"] == pytest.approx([3.8e5, 0])
    assert stop.train["brake_demand"] == pytest.approx([0, 1])


def test_german_file(tmp_path):
    text = '\ufeffRecorder 5\nt;v;n3;"Bemerkung; lang"\ns;km/h;km/h;-\n'
    text += "0,0;72,0;72,0;x\n\n1,5;36;36;y\n"
    stop = read(tmp_path, text, delimiter=";", decimal=",", skip_lines=1, units_line=True)
    assert stop.time.tolist() == [0.0, 1.5]
    assert stop.train["train_speed"] == pytest.approx([20, 10])


def test_a_map_from_a_file(tmp_path):
    path = tmp_path / "map.toml"
    path.write_text(
        'title = "A"\n[time]\ncolumn = "t"\n[[channel]]\ncolumn = "v"\nsignal = "train_speed"\n'
        'unit = "km/h"\n[align]\nspeed_crossing = "36 km/h"\n'
    )
    assert read_channel_map(path).align.speed_crossing == pytest.approx(10.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "has no column 't'"),
        ("t;v;n3\n0;1;2\n", "has no column 't'; known: t;v;n3.*another delimiter"),
        ("t,V,n3\n0,1,2\n1,2,3\n", "has no column 'v'; known: t, V, n3; did you mean 'V'?"),
        ("t,v,v,n3\n0,1,2,3\n", "more than one column 'v'"),
        ("t,v,n3\n0,72,72\n", "too few rows; got 1"),
        ("t,v,n3\n0,72,72\n1,abc,3\n", "line 3: column 'v' is no finite number; got 'abc'"),
        ("t,v,n3\n0,72,72\n1,1e999,3\n", "line 3: column 'v' is no finite number; got '1e999'"),
        ('t,v,n3\n0,"7,2",72\n1,2,3\n', "line 2: column 'v' is no finite number.*decimal"),
        ("t,v,n3\n0,72,72\n1,,3\n2,0,0\n", "line 3: column 'v' has a gap; got ''.*fill the gap"),
        ("t,v,n3\n0,72,72\n1,NaN,3\n2,0,0\n", "line 3: column 'v' has a gap; got 'NaN'"),
        ("t,v,n3\n0,72,72\n1,36\n2,0,0\n", "line 3: column 'n3' has a gap"),
        ("t,v,n3\n0,72,72\n2,36,3\n1,0,0\n", "line 4: the time does not ascend; got 1 s after 2 s"),
        ("t,v,n3\n0,72,72\n0,36,3\n", "line 3: the time does not ascend"),
        ("t,v,n3\n\n0,72,72\n\n0,36,3\n", "line 5: the time does not ascend"),
    ],
)
def test_bad_files(tmp_path, text, words):
    with pytest.raises(RailgripError, match=words):
        read(tmp_path, text)


def test_all_bad_cells_are_told_but_not_thousands(tmp_path):
    with pytest.raises(RailgripError) as caught:
        read(tmp_path, "t,v,n3\n" + "0,x,y\n" * 1000)
    assert 10 <= len(caught.value.problems) <= 12


def test_files_that_cannot_be_read(tmp_path, monkeypatch):
    with pytest.raises(RailgripError, match="there is no such file"):
        read_measured(tmp_path / "none.csv", with_())
    with pytest.raises(RailgripError, match="cannot be read"):
        read_measured(tmp_path, with_())
    path = tmp_path / "old.csv"
    path.write_bytes("t,v,n3,Gerät\n0,1,2,3\n1,2,3,4\n".encode("latin-1"))
    with pytest.raises(RailgripError, match="is no utf-8 text; try: save it as UTF-8"):
        read_measured(path, with_())
    assert len(read_measured(path, with_(encoding="latin-1")).time) == 2
    monkeypatch.setattr("railgrip.io.measured.reading.MOST_BYTES", 10)
    with pytest.raises(RailgripError, match="is too large"):
        read_measured(path, with_())


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"channel": []}, "channel: must not be empty"),
        ({"titel": "x"}, "titel: unknown key; did you mean 'title'"),
        ({"channel": [{"column": "v", "signal": "trainspeed", "unit": "m/s"}]},
         r"channel\[0\].signal: signal 'trainspeed' unknown.*did you mean 'train_speed'"),
        ({"channel": [{"column": "v", "signal": "train_speed", "unit": "bar"}]},
         r"channel\[0\].unit: 'bar' is no unit of train_speed; allowed: m/s"),
        ({"channel": [{"column": "v", "signal": "wheel_speed", "unit": "m/s"}]},
         r"channel\[0\].axle: is missing"),
        ({"channel": [{"column": "v", "signal": "train_speed", "unit": "m/s", "axle": "C1"}]},
         r"channel\[0\].axle: does not fit"),
        ({"channel": [MAP["channel"][1]]}, "channel: has no 'train_speed'"),
        ({"channel": [MAP["channel"][0], MAP["channel"][0]]}, r"channel\[1\].*is channel\[0\]"),
        ({"time": {"column": "t", "unit": "m"}}, "time.unit: 'm' is no unit of time"),
        ({"decimal": ","}, "decimal: is the delimiter too"),
        ({"align": {"brake_command": "1 s", "speed_crossing": "1 m/s"}}, "contradicts"),
        ({"align": {"brake_command": "1 km"}}, "align.brake_command: .*does not fit"),
        ({"channel": [{**MAP["channel"][0], "scale": 0}]}, "scale: must not be 0"),
    ],
)  # fmt: skip
def test_bad_maps(changes, words):
    with pytest.raises(RailgripError, match=words):
        with_(**changes)


@given(st.text(alphabet="tvn3,;.0123456789-eE\n\"' \0äx", max_size=200))
def test_no_text_ends_in_a_traceback(tmp_path_factory, text):
    path = tmp_path_factory.mktemp("fuzz") / "stop.csv"
    path.write_text("t,v,n3\n" + text, encoding="utf-8", newline="")
    try:
        stop = read_measured(path, with_())
    except RailgripError:
        return
    assert np.isfinite(stop.train["train_speed"]).all()
    assert (np.diff(stop.time) > 0).all()


# comparing


def rows_of(comparison):
    return {row.name: row for row in comparison.rows}


def test_the_same_stop_does_not_differ():
    rows = rows_of(compare_measured(simulated(), stop_with(1.0)))
    assert rows["stopping_distance"].simulated == pytest.approx(200.0, abs=0.1)
    assert rows["stopping_distance"].difference == pytest.approx(0.0, abs=0.1)
    assert rows["stopping_time"].measured == pytest.approx(20.0, abs=0.2)
    assert rows["train_speed_greatest"].difference == pytest.approx(0.0, abs=1e-6)


def test_a_weaker_stop_takes_longer():
    rows = rows_of(compare_measured(simulated(), stop_with(0.8)))
    assert rows["stopping_distance"].measured == pytest.approx(250.0, abs=0.1)
    assert rows["stopping_distance"].difference == pytest.approx(-50.0, abs=0.2)
    assert rows["mean_deceleration"].measured == pytest.approx(0.8, abs=1e-3)
    assert rows["mean_deceleration"].difference == pytest.approx(0.2, abs=2e-3)
    # after 20 s the simulated train stands and the measured one still runs at 4 m/s
    assert rows["train_speed_greatest"].difference == pytest.approx(-4 * 3.6, abs=0.05)


def test_a_constant_difference_is_its_own_rms():
    measured = stop_with(1.0, axles={"wheel_speed": {}})
    speed = measured.train["train_speed"]
    measured.axles["wheel_speed"]["C1-V1-B1-A2"] = np.maximum(speed - 1.0, 0) + 0.5
    rows = rows_of(compare_measured(simulated(), measured))
    assert rows["wheel_speed:C1-V1-B1-A2_rms"].difference == pytest.approx(1.8)
    assert rows["wheel_speed:C1-V1-B1-A2_greatest"].difference == pytest.approx(-1.8)
    assert rows["wheel_speed:C1-V1-B1-A2_rms"].unit == "km/h"


def test_laid_together_at_a_speed():
    measured = stop_with(1.0, start=25.0)
    laid = compare_measured(simulated(), measured, speed_crossing=15.0)
    rows = rows_of(laid)
    assert rows["start_speed"].measured == pytest.approx(54.0)
    assert rows["stopping_distance"].measured == pytest.approx(112.5, abs=0.1)
    assert rows["stopping_distance"].difference == pytest.approx(0.0, abs=0.1)
    at = np.interp(6.0, laid.time, laid.train["train_speed"])  # simulated: 15 m/s at 6 s
    assert at == pytest.approx(15.0)
    # at that moment the simulated train has run 20 + 20·5 − 12.5 m
    assert np.interp(6.0, laid.time, laid.distance) == pytest.approx(107.5, abs=0.01)


def test_a_record_that_ends_early_is_compared_until_there():
    whole = stop_with(1.0)
    kept = whole.time < 20.0  # at 10 m/s
    short = MeasuredStop(
        "a", whole.time[kept], {"train_speed": whole.train["train_speed"][kept]}, brake_command=10.0
    )
    row = rows_of(compare_measured(simulated(), short))["stopping_distance"]
    assert row.label.startswith("Distance down to 36.")
    assert row.measured == pytest.approx(150.0, abs=1.0)
    assert row.difference == pytest.approx(0.0, abs=0.1)


def test_a_measured_brake_demand_tells_the_moment():
    measured = stop_with(1.0)
    demand = (measured.time >= 10.0).astype(float)
    told = MeasuredStop("a", measured.time, {**measured.train, "brake_demand": demand})
    laid = compare_measured(simulated(), told)
    assert laid.time[0] == pytest.approx(-9.0, abs=1e-6)


def test_resampling():
    stop = stop_with(1.0, axles={"dump_valve": {"C1": np.zeros(605)}})
    stop.axles["dump_valve"]["C1"] = np.where(stop.time < 5, 0.0, 2.0)
    at = np.array([-1.0, 4.99, 5.01, 15.0, 99.0])
    few = stop.resampled(at)
    assert few.train["train_speed"] == pytest.approx([np.nan, 20, 20, 15, np.nan], nan_ok=True)
    assert few.axles["dump_valve"]["C1"] == pytest.approx([np.nan, 0, 2, 2, np.nan], nan_ok=True)


@pytest.mark.parametrize(
    ("measured", "more", "words"),
    [
        (stop_with(1.0), {"speed_crossing": 50.0}, "does not fall through this .*got 180 km/h"),
        (stop_with(1.0), {"brake_command": 1e3}, "brake_command: is not in the record"),
        (stop_with(1.0, axles={"wheel_speed": {"C1-V1-B1-A9": np.zeros(601)}}), {},
         "axle 'C1-V1-B1-A9' unknown; known: .*did you mean"),
        (MeasuredStop("a", np.array([0.0, 1]), {"train_speed": np.array([1.0, 0])}), {},
         "nothing says where the stops are laid together; try: .align."),
    ],
)  # fmt: skip
def test_stops_that_cannot_be_compared(measured, more, words):
    with pytest.raises(RailgripError, match=words):
        compare_measured(simulated(), measured, **more)


def test_a_run_without_traces():
    bare = simulated()
    bare["train_speed"][:] = np.nan
    with pytest.raises(RailgripError, match=r"has no traces; try: run.trace"):
        compare_measured(bare, stop_with(1.0))
