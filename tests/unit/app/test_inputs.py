"""From the words of a command line to values."""

from __future__ import annotations

import pytest

from railgrip.app.inputs import changes_from, formats_from
from railgrip.core.errors import RailgripError


@pytest.mark.parametrize(
    ("word", "value"),
    [
        ("a.b=120 km/h", "120 km/h"),
        ('a.b="120 km/h"', "120 km/h"),
        ("a.b=0.5", 0.5),
        ("a.b=true", True),
        ("a.b=none", "none"),
        ("a.b=[1, 2]", [1, 2]),
        ("a.b={x = 1}", {"x": 1}),
        ("a.b=", ""),
        ("a.b=x=y", "x=y"),
        ("a.b=1\nc = 2", "1\nc = 2"),
    ],
)
def test_a_value_is_toml_or_else_a_text(word: str, value: object) -> None:
    assert changes_from([word]) == {"a.b": value}


@pytest.mark.parametrize("word", ["run.speed", "=3", " = 3"])
def test_a_change_needs_a_key_and_a_value(word: str) -> None:
    with pytest.raises(RailgripError, match="is not of the form key=value"):
        changes_from([word])


def test_figure_formats() -> None:
    assert formats_from("") == []
    assert formats_from("png, pdf") == ["png", "pdf"]
    with pytest.raises(RailgripError, match="did you mean 'png'"):
        formats_from("pgn")
