"""`railgrip etcs`: table, files, JSON, and a sentence for every bad input."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from railgrip.app.cli import execute

GAMMA = """
[train]
length = "300 m"
emergency = [{ value = "1.1 m/s^2" }, { from = "100 km/h", value = "0.9 m/s^2" }]
service = [{ value = "0.8 m/s^2" }]
normal_service = [{ value = "0.5 m/s^2" }]
kwet = [{ value = 0.85 }]
kdry = [{ confidence_level = 9, steps = [{ value = 0.9 }] }]
emergency_time = "3 s"
service_time = "4 s"
[target]
at = "5 km"
"""
LAMBDA = '[train]\nlength = "400 m"\nbraked_weight = 120\n[target]\nat = "5 km"\n'

BAD = {
    "no brake": ('[train]\nlength = "1 m"\n[target]\nat = "1 km"', "train.emergency: is missing"),
    "two brakes": (LAMBDA.replace("120", '120\nservice_time = "1 s"'), "contradicts braked_weight"),
    "weak": (LAMBDA.replace("120", "20"), "allowed: 30 to 250 %"),
    "too long": (LAMBDA.replace("400 m", "1 km"), "900 m for passenger P"),
    "steps in order": (GAMMA.replace('value = "0.9', 'from = 0, value = "0.9').replace(
        'from = "100 km/h", from = 0', "from = 0"), "emergency[1]: must begin above"),
    "percentage": (LAMBDA.replace("120", '"heavy"'), "150 %"),
    "unknown key": (LAMBDA + "sped = 1", "did you mean 'speed'?"),
    "speed at an end": (LAMBDA + 'speed = "20 km/h"', 'kind = "speed limit"'),
    "location before": (LAMBDA + 'supervised_location = "4 km"', "must not lie before"),
    "gradient order": (LAMBDA + '[[gradient]]\nat = 9\nvalue = 0\n[[gradient]]\nat = 3\nvalue = 0',
                       "gradient[1].at"),
    "too steep": (LAMBDA + '[[gradient]]\nat = 0\nvalue = "-200 ‰"', "does not slow the train"),
    "confidence": (GAMMA + "[national]\nconfidence_level = 4", "has no steps for"),
    "no file": ("", "missing.toml"),
}  # fmt: skip


@pytest.fixture
def case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path / "case.toml"


def test_writes_table_and_figure(case: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case.write_text(GAMMA + "[national]\nguidance = true\n", encoding="utf-8")
    assert execute(["etcs", str(case), "--figures", "png,svg"]) == 0
    printed = capsys.readouterr().out
    assert "GUI" in printed
    folder = case.parent / "out" / "case_etcs"
    assert sorted(path.name for path in folder.iterdir()) == [
        "curves.csv", "curves.png", "curves.svg",
    ]  # fmt: skip
    with (folder / "curves.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    by_speed = {float(row["speed_kmh"]): row for row in rows}
    # 0.9·0.85·1.1 m/s² up to 100 km/h: v²/2b; guidance 0.5 m/s²
    expected = (100 / 3.6) ** 2 / 2 / (0.9 * 0.85 * 1.1)
    assert float(by_speed[100.0]["ebd_m"]) == pytest.approx(expected, abs=2e-3)
    assert float(by_speed[100.0]["gui_m"]) == pytest.approx((100 / 3.6) ** 2, abs=2e-3)


@pytest.mark.parametrize("percentage", ["120", '"120 %"'])
def test_json(percentage: str, case: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case.write_text(LAMBDA.replace("120", percentage), encoding="utf-8")
    assert execute(["etcs", str(case), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert len(found["permitted"]) == len(found["speed"]) == 41
    assert found["gui"][5] is None


@pytest.mark.parametrize("name", BAD)
def test_bad_input(name: str, case: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text, word = BAD[name]
    if text:
        case.write_text(text, encoding="utf-8")
    file = case if text else case.with_name("missing.toml")
    assert execute(["etcs", str(file)]) == 2
    told = capsys.readouterr()
    assert word in told.err
    assert told.out == ""
    assert not (case.parent / "out").exists()


def factors(**changes):
    """A table as `railgrip campaign safety` writes it: two speed steps, two levels."""
    return {
        "rows": [
            {
                "speed": speed / 3.6, "ebcl": level, "k_dry_low": k, "k_wet_low": 0.9,
                "a_brake_emergency": a, "build_up_time": 2.0, **changes,
            }
            for speed, a, ks in ((80, 1.2, (1.0, 0.7)), (160, 1.0, (0.99, 0.6)))
            for level, k in zip((0, 9), ks, strict=True)
        ]
    }  # fmt: skip


def test_factors_of_a_safety_case_become_the_trains(tmp_path, monkeypatch, capsys):
    """The same as a file that says so: K 0.7 up to 80 km/h, 0.6 beyond, Kwet 0.9."""
    monkeypatch.chdir(tmp_path)
    Path("factors.json").write_text(json.dumps(factors()), encoding="utf-8")
    Path("a.toml").write_text(GAMMA, encoding="utf-8")
    said = GAMMA.replace(
        'emergency = [{ value = "1.1 m/s^2" }, { from = "100 km/h", value = "0.9 m/s^2" }]',
        'emergency = [{ value = "1.2 m/s^2" }, { from = "80 km/h", value = "1 m/s^2" }]',
    ).replace("kwet = [{ value = 0.85 }]", "kwet = [{ value = 0.9 }]").replace(
        "steps = [{ value = 0.9 }]", 'steps = [{ value = 0.7 }, { from = "80 km/h", value = 0.6 }]'
    ).replace('emergency_time = "3 s"', 'emergency_time = "2 s"')  # fmt: skip
    Path("b.toml").write_text(said, encoding="utf-8")
    assert execute(["etcs", "a.toml", "--factors", "factors.json", "--json"]) == 0
    fed = json.loads(capsys.readouterr().out)
    assert execute(["etcs", "b.toml", "--json"]) == 0
    written = json.loads(capsys.readouterr().out)
    assert execute(["etcs", "a.toml", "--json"]) == 0
    plain = json.loads(capsys.readouterr().out)
    for curve in ("ebd", "ebi", "sbi2"):
        assert fed[curve] == pytest.approx(written[curve], rel=1e-9)
    assert fed["ebd"][-1] > 1.2 * plain["ebd"][-1]


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (None, "cannot be read"),
        ("[1, 2]", "is no table of railgrip campaign safety"),
        (json.dumps({"rows": []}), "is no table of railgrip campaign safety"),
        (json.dumps(factors(k_dry_low=None)), "EBCL 9 is not resolved"),
        (json.dumps(factors(a_brake_emergency=-1)), "train.emergency"),
    ],
)
def test_bad_factors_are_explained(tmp_path, monkeypatch, capsys, content, sentence):
    monkeypatch.chdir(tmp_path)
    Path("a.toml").write_text(GAMMA, encoding="utf-8")
    if content is not None:
        Path("factors.json").write_text(content, encoding="utf-8")
    assert execute(["etcs", "a.toml", "--factors", "factors.json"]) == 2
    assert sentence in capsys.readouterr().err
    assert not Path("out").exists()
