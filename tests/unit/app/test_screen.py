"""What goes to which stream, and in which form."""

from __future__ import annotations

import json

import pytest

from railgrip.app.screen import print_json, print_problems, print_table, working
from railgrip.core.errors import Problem

PROBLEM = Problem("run.speed", "is out of range", got="700 km/h", allowed="0 to 600 km/h")


def test_problems_are_one_line_each_on_the_standard_error(
    capsys: pytest.CaptureFixture[str],
) -> None:
    print_problems([PROBLEM, Problem("", "two\nlines")], as_json=False, exit_code=2)
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.splitlines() == [f"railgrip: {PROBLEM}", "railgrip: two lines"]


def test_problems_as_json_are_one_object_on_the_standard_output(
    capsys: pytest.CaptureFixture[str],
) -> None:
    print_problems([PROBLEM], as_json=True, exit_code=2)
    found = json.loads(capsys.readouterr().out)
    assert found["exit_code"] == 2
    assert found["errors"][0]["where"] == "run.speed"


def test_json_has_no_nan(capsys: pytest.CaptureFixture[str]) -> None:
    print_json({"a": [float("nan"), float("inf"), 1.5], "b": {"c": -float("inf")}})
    assert json.loads(capsys.readouterr().out) == {"a": [None, None, 1.5], "b": {"c": None}}


def test_a_table_in_a_pipe_is_not_cut_to_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    print_table("Title", ["name", "value"], [["x" * 50, "y" * 50]])
    assert "x" * 50 + "  " in capsys.readouterr().out


def test_nothing_is_shown_while_working_without_a_terminal(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with working("braking"):
        pass
    assert capsys.readouterr() == ("", "")
