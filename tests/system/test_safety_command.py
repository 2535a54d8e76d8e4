"""`railgrip campaign safety` from the file to the files it leaves."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from railgrip.app.cli import execute
from railgrip.campaign.safety.case import find_case


@pytest.fixture
def dry_case(tmp_path: Path) -> Path:
    text = find_case("emu_en14531").read_text(encoding="utf-8").partition("[wet]")[0]
    file = tmp_path / "dry.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_table_and_page_are_written(dry_case: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = dry_case.parent / "out"
    code = execute(["campaign", "safety", str(dry_case), "--out", str(out), "--runs", "2000"])
    assert code == 0
    assert "simulation, not an approval" in capsys.readouterr().out
    table = json.loads((out / "factors.json").read_text(encoding="utf-8"))
    assert len(table["rows"]) == 30
    assert table["notice"] == "simulation, not an approval"
    assert sorted(path.name for path in out.iterdir()) == ["factors.json", "report.html"]


def test_a_level_that_is_not_resolved_ends_with_1(dry_case: Path) -> None:
    """Five hundred runs cannot serve ten levels."""
    assert execute(["campaign", "safety", str(dry_case), "--runs", "500", "--no-report"]) == 1


@pytest.mark.parametrize("words", [["nosuch"], ["emu_en14531", "--runs", "3"],
                                   ["emu_en14531", "--method", "magic"]])  # fmt: skip
def test_bad_input_ends_with_2(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert execute(["campaign", "safety", *words]) == 2
    assert capsys.readouterr().err.startswith("railgrip: ")
