"""Measurements of pads in all formats, and everything that can be wrong with them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.io.measured.pad_channels import read_pad_channels
from railgrip.io.measured.pad_reading import PadMeasurement, read_pad_stops
from railgrip.laboratory.pad_fit.synthetic import Programme, organic, synthetic_stops

NAMES = ("stop", "time", "mu", "T", "v", "F")


def table(stops: int = 6) -> dict[str, np.ndarray]:
    made = synthetic_stops(
        organic, Programme(stops=stops, samples=60, outliers=0.0, clamp_force=(20e3, 40e3)), seed=3
    )
    columns = dict(zip(NAMES, map(np.array, made), strict=True))
    columns["time"] = columns["time"] + 1000.0 * columns["stop"]
    return columns


def channels(**more: Any) -> dict[str, Any]:
    return {
        "channel": [
            {"column": "stop", "signal": "stop"},
            {"column": "mu", "signal": "pad_friction"},
            {"column": "T", "signal": "disc_temperature", "unit": "degC"},
            {"column": "v", "signal": "rubbing_speed", "unit": "m/s"},
            {"column": "F", "signal": "clamp_force", "unit": "N"},
        ],
        **more,
        "stops": {"least_speed": 0.0, **more.get("stops", {})},
    }


def write(path: Path, columns: dict[str, np.ndarray]) -> Path:
    rows = zip(*columns.values(), strict=True)
    lines = [",".join("" if np.isnan(x) else f"{x:.9g}" for x in row) for row in rows]
    path.write_text("\n".join([",".join(columns), *lines]) + "\n", encoding="utf-8")
    return path


def read(folder: Path, columns: dict[str, np.ndarray], **more: Any) -> PadMeasurement:
    path = write(folder / "stops.csv", columns)
    return read_pad_stops(path, read_pad_channels(channels(**more)))


def said(measured: PadMeasurement) -> str:
    return "\n".join(map(str, measured.problems))


def test_csv(tmp_path: Path) -> None:
    columns = table()
    measured = read(tmp_path, columns)
    assert measured.labels == [f"stop {k}" for k in range(6)]
    assert measured.problems == []
    np.testing.assert_allclose(measured.stops.friction, columns["mu"], rtol=1e-8)


def test_parquet(tmp_path: Path) -> None:
    pa = pytest.importorskip("pyarrow")
    parquet = pytest.importorskip("pyarrow.parquet")
    columns = table()
    parquet.write_table(pa.table({**columns, "unused": columns["mu"]}), tmp_path / "s.parquet")
    measured = read_pad_stops(tmp_path / "s.parquet", read_pad_channels(channels()))
    np.testing.assert_array_equal(measured.stops.friction, columns["mu"])


def test_mdf4_and_its_units(tmp_path: Path) -> None:
    asammdf = pytest.importorskip("asammdf")
    columns = table()
    units = {"T": "degC", "v": "m/s", "F": "kN"}
    signals = [
        asammdf.Signal(columns[n], columns["time"], name=n, unit=units.get(n, ""))
        for n in ("stop", "mu", "T", "v", "F")
    ]
    with asammdf.MDF(version="4.10") as file:
        file.append(signals, common_timebase=True)
        file.save(tmp_path / "s.mf4")
    with pytest.raises(RailgripError, match="clamp_force: the file says 'kN', the map 'N'"):
        read_pad_stops(tmp_path / "s.mf4", read_pad_channels(channels()))
    wanted = channels()
    wanted["channel"][4]["unit"] = "kN"
    columns["F"] /= 1e3
    signals[4] = asammdf.Signal(columns["F"], columns["time"], name="F", unit="kN")
    with asammdf.MDF(version="4.10") as file:
        file.append(signals, common_timebase=True)
        file.save(tmp_path / "t.mf4")
    measured = read_pad_stops(tmp_path / "t.mf4", read_pad_channels(wanted))
    np.testing.assert_allclose(measured.stops.clamp_force, 1e3 * columns["F"])


def test_tdms_with_clocks_of_their_own(tmp_path: Path) -> None:
    nptdms = pytest.importorskip("nptdms")
    columns = table(4)
    columns["time"] = np.arange(len(columns["mu"])) * 0.1
    made = [
        nptdms.ChannelObject("rig", name, columns[name], properties={"wf_increment": 0.1})
        for name in ("stop", "mu", "v", "F")
    ]
    slow = columns["T"][::2]
    made.append(nptdms.ChannelObject("rig", "T", slow, properties={"wf_increment": 0.2}))
    with nptdms.TdmsWriter(tmp_path / "s.tdms") as writer:
        writer.write_segment(made)
    measured = read_pad_stops(tmp_path / "s.tdms", read_pad_channels(channels()))
    assert measured.labels == [f"stop {k}" for k in range(4)]
    np.testing.assert_allclose(measured.stops.temperature[:100:2], columns["T"][:100:2])


def test_torque_and_speed_of_the_train(tmp_path: Path) -> None:
    columns = table()
    columns["M"] = columns["mu"] * columns["F"] * 0.25
    columns["v"] = columns["v"] * 3.6 * 0.9 / 0.5
    del columns["mu"]
    wanted = channels(pad={"friction_radius": "250 mm", "wheel_diameter": "0.9 m"})
    wanted["channel"][1] = {"column": "M", "signal": "brake_torque", "unit": "N*m"}
    wanted["channel"][3] = {"column": "v", "signal": "train_speed", "unit": "km/h"}
    path = write(tmp_path / "s.csv", columns)
    measured = read_pad_stops(path, read_pad_channels(wanted))
    np.testing.assert_allclose(measured.stops.friction, table()["mu"], rtol=1e-6)
    np.testing.assert_allclose(measured.stops.speed, table()["v"], rtol=1e-6)


def test_rate_and_filter_thin_the_samples(tmp_path: Path) -> None:
    step = float(np.median(np.diff(table()["time"][:60])))
    measured = read(tmp_path, table(), stops={"rate": 0.25 / step, "least_samples": 10})
    assert 60 <= len(measured.stops.time) <= 240  # the stops last unequally long
    smooth = read(tmp_path, table(), stops={"low_pass": 0.05 / step})
    assert np.diff(smooth.stops.friction).std() < np.diff(table()["mu"]).std()


def test_missing_channel_names_the_nearest(tmp_path: Path) -> None:
    columns = table()
    columns["mue"] = columns.pop("mu")
    with pytest.raises(RailgripError, match=r"has no channel 'mu'.*did you mean 'mue'"):
        read(tmp_path, columns)


def test_mixed_units_cost_one_stop(tmp_path: Path) -> None:
    columns = table()
    columns["F"][columns["stop"] == 2] /= 1e3
    measured = read(tmp_path, columns, stops={"least_force": 0})
    assert "stop 2" not in measured.labels
    assert "stop 2: the clamp force cannot be right" in said(measured)
    columns = table()
    columns["mu"][columns["stop"] == 1] *= 3.0
    columns["v"][columns["stop"] == 4] = 3.6 * 20.0 + np.arange(60) * 0.1
    for k in (0, 1, 2, 3, 5):
        columns["v"][columns["stop"] == k] = 18.0 + np.arange(60) * 0.1
    assert "stop 4: the speed looks like km/h where the others have m/s" in said(
        read(tmp_path, columns)
    )


def test_kelvin_among_celsius(tmp_path: Path) -> None:
    columns = table()
    for k in range(6):
        columns["T"][columns["stop"] == k] = 60.0 + 5 * k + np.arange(60)
    columns["T"][columns["stop"] == 3] += 273.15
    assert "stop 3: the temperature looks like K" in said(read(tmp_path, columns))


def test_wrong_sign_is_said(tmp_path: Path) -> None:
    columns = table()
    columns["mu"][columns["stop"] == 5] *= -1.0
    measured = read(tmp_path, columns)
    assert "stop 5: the friction is negative while braking" in said(measured)
    assert len(measured.labels) == 5


def test_a_rig_that_turns_the_other_way_is_fine(tmp_path: Path) -> None:
    columns = table()
    for name in ("mu", "v"):
        columns[name][columns["stop"] == 5] *= -1.0
    measured = read(tmp_path, columns)
    np.testing.assert_allclose(measured.stops.friction, table()["mu"], rtol=1e-8)


def test_gaps_are_left_out_and_told(tmp_path: Path) -> None:
    columns = table()
    columns["T"][10:15] = np.nan
    measured = read(tmp_path, columns)
    assert "disc_temperature: has gaps; they were left out; got 5 of 360 samples" in said(measured)
    assert len(measured.stops.time) == 355


def test_clock_that_jumps_back_cuts_the_stop(tmp_path: Path) -> None:
    columns = table()
    columns["time"][30:60] -= 500.0
    measured = read(tmp_path, columns)
    assert "the clock jumps back after row 30" in said(measured)
    assert "stop 0 part 2" in measured.labels


def test_signals_that_stand_still(tmp_path: Path) -> None:
    columns = table()
    columns["T"][columns["stop"] == 1] = 87.0
    columns["mu"][columns["stop"] == 2] = 0.35
    measured = read(tmp_path, columns)
    assert "stop 1: the temperature stands still; got 87 °C" in said(measured)
    assert "stop 2: the friction stands still" in said(measured)
    columns["T"][:] = 20.0
    assert "disc_temperature: stands still throughout" in said(read(tmp_path, columns))


def test_stops_without_braking_and_nothing_left(tmp_path: Path) -> None:
    columns = table()
    columns["F"][columns["stop"] == 3] = 40.0
    assert "stop 3: has no braking; got at most 40 N" in said(read(tmp_path, columns))
    columns["F"][:] = 0.0
    with pytest.raises(RailgripError, match="holds no stop that can be used"):
        read(tmp_path, columns)


def test_a_bad_cell_is_named_with_its_line(tmp_path: Path) -> None:
    path = write(tmp_path / "stops.csv", table())
    lines = path.read_text(encoding="utf-8").splitlines()
    lines[7] = lines[7].replace(lines[7].split(",")[2], "abc")
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(RailgripError, match="line 8: column 'mu' is no number; got 'abc'"):
        read_pad_stops(path, read_pad_channels(channels()))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"channel": [{"column": "F", "signal": "clamp_force", "unit": "N"}]}, "has no friction"),
        ({"channel": [{"column": "a", "signal": "pad_fricton"}]}, "did you mean 'pad_friction'"),
        ({"channel": [{"column": "a", "signal": "pad_friction", "unit": "bar"}]}, "is no unit of"),
        ({"channel": [{"column": "a", "signal": "pad_friction", "lag": "fit"}]}, "cannot be found"),
    ],
)
def test_bad_maps(change: dict[str, Any], sentence: str) -> None:
    with pytest.raises(RailgripError, match=sentence):
        read_pad_channels(change)


@pytest.mark.parametrize("suffix", ["csv", "parquet", "mf4", "tdms", "xls"])
def test_files_that_are_none(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"stops.{suffix}"
    path.write_bytes(b"\x00\x01 nothing of use \xff")
    with pytest.raises(RailgripError):
        read_pad_stops(path, read_pad_channels(channels()))
    with pytest.raises(RailgripError):
        read_pad_stops(tmp_path / f"missing.{suffix}", read_pad_channels(channels()))
