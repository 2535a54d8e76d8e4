"""`railgrip qualify` on the command line: what it writes, and what it refuses before it runs."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from railgrip.app.cli import execute


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["emu_fourcar"], "train 'emu_fourcar' unknown"),
        (["freight_20"], "no dump valves"),
        (["emu_four_car", "--controller", "conventionl"], "did you mean 'conventional'"),
        (["emu_four_car", "--controller", "nowhere.py"], "no such file"),
        (["emu_four_car", "--profile", "en_15595"], "profile 'en_15595' unknown"),
        (["emu_four_car", "--test", "W9"], "test 'W9' unknown"),
        (["emu_four_car", "--language", "fr"], "language 'fr' unknown"),
        (["emu_four_car", "--replay", "W3"], "is not of the form TEST.NUMBER"),
        (["emu_four_car", "--baseline", "nowhere.json"], "cannot be read"),
        (["emu_four_car", "--repetitions", "0"], "must be at least 1"),
    ],
)
def test_what_cannot_be_run_is_refused_with_a_sentence(
    words: list[str], sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert execute(["qualify", *words, "--out", str(tmp_path / "out")]) == 2
    told = capsys.readouterr().err
    assert sentence in told
    assert "Traceback" not in told
    assert not (tmp_path / "out").exists()


def test_a_controller_that_breaks_the_contract_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "broken.py").write_text(
        "class Broken:\n    period = 0.01\n    def reset(self, setup):\n        return None\n"
        "    def step(self, state, measured, dt):\n        raise ValueError('no')\n",
        encoding="utf-8",
    )
    words = ["qualify", "emu_four_car", "--controller", str(tmp_path / "broken.py")]
    assert execute([*words, "--out", str(tmp_path / "out")]) == 2
    assert "the controller raised ValueError" in capsys.readouterr().err


def test_a_protocol_is_written_and_serves_as_a_baseline(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    first, second = tmp_path / "first", tmp_path / "second"
    words = ["qualify", "emu_four_car", "--test", "D1", "--repetitions", "1"]
    assert execute([*words, "--pdf", "--language", "de", "--out", str(first)]) == 0
    assert (first / "protocol.pdf").read_bytes().startswith(b"%PDF")
    assert "Prüfprotokoll" in (first / "protocol.html").read_text(encoding="utf-8")
    table = json.loads((first / "protocol.json").read_text(encoding="utf-8"))
    # as if the release before had kept what is now missed
    table["tests"][0]["limits"][0]["verdict"] = "kept"
    (tmp_path / "before.json").write_text(json.dumps(table), encoding="utf-8")
    profile = tmp_path / "strict.toml"
    profile.write_text(
        'extends = "en_15595_style"\n[test.D1.limit.greatest_slip]\ngreatest = "0.01 %"\n'
        'source = "too strict"\n',
        encoding="utf-8",
    )
    capsys.readouterr()
    strict = [*words, "--profile", str(profile), "--baseline", str(tmp_path / "before.json")]
    assert execute([*strict, "--json", "--out", str(second)]) == 1
    told = json.loads(capsys.readouterr().out)
    assert [one["metric"] for one in told["newly_missed"]] == ["greatest_slip"]
