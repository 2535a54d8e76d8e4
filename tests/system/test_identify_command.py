"""`railgrip identify` on the example: the pad comes back, and a scenario brakes with it."""

from __future__ import annotations

import csv
import json
import shutil
from pathlib import Path

import pytest

import railgrip as rg
from railgrip.app.cli import execute

EXAMPLE = Path(__file__).parents[2] / "docs/examples/pad_stops"


@pytest.fixture
def example(tmp_path: Path) -> Path:
    pytest.importorskip("asammdf")
    for name in ("stops.mf4", "channels.toml"):
        shutil.copy(EXAMPLE / name, tmp_path)
    return tmp_path


def test_pad_report_and_residuals(example: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["identify", str(example / "stops.mf4"), "--map", str(example / "channels.toml")]
    assert execute([*words, "--out", str(example / "found"), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    numbers = {one["name"]: one for one in told["parameters"]}
    # true_pad.toml at its reference, 100 °C, 15 m/s, 25 kN: 0.37 · 0.97 · 0.94
    truth = {"reference_friction": 0.3374, "temperature_point_1": 80.0, "speed_point_1": 8.0,
             "speed_point_2": 22.0, "temperature_lag": 3.0}  # fmt: skip
    for name, value in truth.items():
        assert numbers[name]["low"] <= value <= numbers[name]["high"], name
    assert next(one["name"] for one in told["laws"] if one["is_chosen"]) == "III"
    page = (example / "found/report.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 5
    assert "http://" not in page
    assert "https://" not in page
    assert "prefers-color-scheme: dark" in page
    with (example / "found/residuals.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {row["stop"] for row in rows} == {f"stop {k}" for k in range(1, 31)}
    residuals = [float(row["residual"]) for row in rows]
    assert abs(sum(residuals) / len(residuals)) < 0.01

    pad = str(example / "found/pad.toml")
    true = str(EXAMPLE / "true_pad.toml")
    distance = {
        file: float(
            rg.simulate(
                rg.load({"extends": "coach_120", "train": {
                    "extends": "coach_disc", "brakes": {"disc": {"pad": file}}}})
            ).data["stopping_distance"].values[0]
        )
        for file in (pad, true)
    }  # fmt: skip
    assert distance[pad] == pytest.approx(distance[true], rel=0.02)


def test_what_is_wrong_with_the_file_is_said(
    example: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (example / "channels.toml").read_text(encoding="utf-8")
    (example / "wrong.toml").write_text(text.replace('column = "M"', 'column = "moment"'))
    words = ["identify", str(example / "stops.mf4"), "--map", str(example / "wrong.toml")]
    assert execute([*words, "--out", str(example / "found")]) == 2
    assert "has no channel 'moment'" in capsys.readouterr().err
    assert not (example / "found").exists()
