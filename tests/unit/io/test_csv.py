"""Traces and outcomes as CSV, read back with the standard library."""

import csv

import numpy as np
import pytest
import xarray as xr

from railgrip.core.errors import RailgripError
from railgrip.io.csv_file import write_csv, write_outcomes_csv

TIME = np.arange(0, 5, 0.5)
SPEED = np.where(TIME < 4.2, 20 - 4 * TIME, np.nan)


@pytest.fixture
def result() -> xr.Dataset:
    wheels = np.stack([SPEED, SPEED * 0.9])
    creepage = wheels / np.where(SPEED > 5, SPEED, np.nan) - 1
    return xr.Dataset(
        {
            "wheel_speed": (("run", "axle", "time"), np.stack([wheels, wheels / 2])),
            "creepage": (("run", "axle", "time"), np.stack([creepage, creepage])),
            "acceleration": (("run", "time"), np.full((2, 10), -4.0)),
            "train_speed": (("run", "time"), np.stack([SPEED, SPEED / 2])),
            "reservoir_pressure": (("run", "vehicle", "time"), np.full((2, 1, 10), 7e5)),
            "stopping_distance": (("run",), [50.0, 25.0]),
            "axle_slid_energy": (("run", "axle"), [[0.0, 1e5], [0.0, 2e5]]),
            "rail_energy": (("run", "cell"), np.ones((2, 3))),
        },
        coords={"run": [4, 5], "axle": ["C1-V1-B1-A1", "C1-V1-B1-A2"], "time": TIME},
    )


def read(path):
    with path.open(newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    numbers = [[float(cell) if cell else np.nan for cell in row] for row in rows]
    return dict(zip(head, np.array(numbers).T, strict=True))


def test_traces_come_back(result, tmp_path):
    table = read(write_csv(result, tmp_path / "stop.csv"))
    assert list(table) == [
        "time_s", "train_speed_m_s", "acceleration_m_s2",
        "wheel_speed_m_s:C1-V1-B1-A1", "wheel_speed_m_s:C1-V1-B1-A2",
        "creepage:C1-V1-B1-A1", "creepage:C1-V1-B1-A2", "reservoir_pressure_Pa:0",
    ]  # fmt: skip
    assert table["train_speed_m_s"] == pytest.approx(SPEED[:9])  # until the stop and no further
    assert table["wheel_speed_m_s:C1-V1-B1-A2"] == pytest.approx(0.9 * SPEED[:9])
    assert np.isnan(table["creepage:C1-V1-B1-A1"][-1])


def test_another_run_and_chosen_signals(result, tmp_path):
    table = read(write_csv(result, tmp_path / "stop.csv", run=1, signals=["train_speed"]))
    assert list(table) == ["time_s", "train_speed_m_s"]
    assert table["train_speed_m_s"] == pytest.approx(SPEED[:9] / 2)


def test_outcomes_come_back(result, tmp_path):
    table = read(write_outcomes_csv(result, tmp_path / "outcomes.csv"))
    assert table["run"].tolist() == [4, 5]
    assert table["stopping_distance_m"].tolist() == [50.0, 25.0]
    assert table["axle_slid_energy_J:C1-V1-B1-A2"].tolist() == [1e5, 2e5]
    assert len(table) == 4


def test_unknown_signal(result, tmp_path):
    with pytest.raises(RailgripError, match="did you mean 'train_speed'"):
        write_csv(result, tmp_path / "stop.csv", signals=["train_sped"])
    with pytest.raises(RailgripError, match="no run 2; allowed: 0 to 1"):
        write_csv(result, tmp_path / "stop.csv", run=2)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_not_there(result, tmp_path):
    with pytest.raises(RailgripError, match="cannot be written"):
        write_csv(result, tmp_path / "none" / "stop.csv")
