"""A saved result comes back as it was; a broken file is told in one sentence."""

import json

import numpy as np
import pytest
import xarray as xr

from railgrip.core.errors import RailgripError
from railgrip.core.signals import attributes
from railgrip.io.netcdf import open_result, save


@pytest.fixture
def result() -> xr.Dataset:
    time = np.arange(0, 20, 0.02)
    speed = np.where(time < 18, 40 - 2 * time, np.nan)
    valve = np.where(np.isnan(speed), np.nan, (time * 3).astype(int) % 3)
    return xr.Dataset(
        {
            "train_speed": (("run", "time"), speed[None], attributes("train_speed")),
            "dump_valve": (
                ("run", "axle", "time"),
                np.stack([[valve, valve]]),
                attributes("dump_valve"),
            ),
            "stopping_distance": (("run",), [1007.0387], attributes("stopping_distance")),
            "status": (("run",), np.array([1], np.int8), attributes("status")),
        },
        coords={"axle": ["C1-V1-B1-A1", "C1-V1-B1-A2"], "time": ("time", time, {"units": "s"})},
        attrs={
            "title": "Bremsweg, naß",
            "seed": 7,
            "version": "0.1.0",
            "scenario_json": json.dumps({"title": "ß"}),
        },
    )


def test_round_trip(result, tmp_path):
    found = open_result(save(result, tmp_path / "stop.nc"))
    assert found.equals(result)  # values and dims, NaN after the stop included
    assert found.attrs == result.attrs
    for name in result.variables:
        assert found[name].attrs == result[name].attrs, name
    assert [str(label) for label in found.axle.values] == ["C1-V1-B1-A1", "C1-V1-B1-A2"]


def test_valves_take_one_byte(result, tmp_path):
    import h5py

    with h5py.File(save(result, tmp_path / "stop.nc")) as file:
        assert file["dump_valve"].dtype == np.int8
        assert file["dump_valve"].compression == "gzip"
        assert file["train_speed"].dtype == np.float64
        assert file["train_speed"].attrs["units"] == b"m/s" or (
            file["train_speed"].attrs["units"] == "m/s"
        )


def test_whole_valves_stay_whole(result, tmp_path):
    result["dump_valve"] = result.dump_valve.fillna(0).astype(np.int8)
    assert open_result(save(result, tmp_path / "stop.nc")).dump_valve.dtype == np.int8


def test_attributes_that_netcdf_does_not_know(result, tmp_path):
    result.attrs.update(flag=True, nothing=None, table={"a": [1, 2]})
    found = open_result(save(result, tmp_path / "stop.nc")).attrs
    assert found["flag"] == 1
    assert "nothing" not in found
    assert json.loads(found["table"]) == {"a": [1, 2]}
    assert result.attrs["nothing"] is None  # the user's own dataset is left alone


def test_a_saved_result_can_be_saved_again(result, tmp_path):
    again = open_result(save(result, tmp_path / "stop.nc"))
    assert open_result(save(again, tmp_path / "stop.nc")).equals(result)


def test_a_result_object(result, tmp_path):
    class Result:
        data = result

    assert open_result(save(Result(), tmp_path / "stop.nc")).equals(result)


def test_nothing_half_written(result, tmp_path):
    result["odd"] = ("run", np.array([object()], dtype=object))
    with pytest.raises(Exception, match="object"):
        save(result, tmp_path / "stop.nc")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("content", [b"", b"not a file", b"\x89HDF\r\n\x1a\n" + b"\0" * 64])
def test_broken_files(tmp_path, content):
    path = tmp_path / "broken.nc"
    path.write_bytes(content)
    with pytest.raises(RailgripError, match=r"is no NetCDF-4 file, or not a whole one"):
        open_result(path)


def test_truncated_file(result, tmp_path):
    path = save(result, tmp_path / "stop.nc")
    path.write_bytes(path.read_bytes()[:-2000])
    with pytest.raises(RailgripError, match="not a whole one"):
        open_result(path)


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(RailgripError, match="there is no such file"):
        open_result(tmp_path / "none.nc")
    with pytest.raises(RailgripError, match="is a folder"):
        open_result(tmp_path)


def test_a_foreign_netcdf_file(tmp_path):
    path = tmp_path / "weather.nc"
    xr.Dataset({"rain": ("hour", [1.0])}).to_netcdf(path, engine="h5netcdf")
    with pytest.raises(RailgripError, match="no result of railgrip"):
        open_result(path)
