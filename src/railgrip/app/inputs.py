"""From the words of a command line to scenarios."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from railgrip.core.errors import Problem, RailgripError, unknown_name

if TYPE_CHECKING:
    from railgrip.scenario import Scenario


class Named(NamedTuple):
    """A scenario with the name that tables and folders know it by."""

    name: str
    scenario: Scenario


def read_scenario(source: str, changes: dict[str, Any] | None = None) -> Named:
    """Read a scenario file or a shipped scenario, and change what the command line changes.

    Raises
    ------
    RailgripError
        ``leavs: scenario 'leavs' unknown; known: …; did you mean 'leaves_160'?``; ``trip: is driven
        from stop to stop, which this command does not do; try: railgrip drive my.toml``
    """
    import railgrip

    scenario = railgrip.load(source)
    if scenario.trip is not None:
        what = "is driven from stop to stop, which this command does not do"
        raise RailgripError(Problem("trip", what, cure=f"railgrip drive {source}"))
    return Named(Path(source).stem, scenario.with_(changes) if changes else scenario)


def changes_from(words: Iterable[str]) -> dict[str, Any]:
    """Return what ``--set key=value …`` asks for; a value is TOML, or else a plain text.

    Raises
    ------
    RailgripError
        ``--set: is not of the form key=value; got 'run.speed'; try: --set run.speed=120km/h``

    Examples
    --------
    >>> changes_from(["run.speed=120 km/h", "run.step=0.005", "train.sensor={teeth = 80}"])
    {'run.speed': '120 km/h', 'run.step': 0.005, 'train.sensor': {'teeth': 80}}
    """
    changes = {}
    for word in words:
        key, equals, text = word.partition("=")
        if not equals or not key.strip():
            what = "is not of the form key=value"
            cure = "--set run.speed=120km/h"
            raise RailgripError(Problem("--set", what, got=f"'{word}'", cure=cure))
        changes[key.strip()] = _value(text.strip())
    return changes


def _value(text: str) -> Any:
    try:
        table = tomllib.loads(f"value = {text}")
    except (tomllib.TOMLDecodeError, RecursionError):
        return text
    return table["value"] if len(table) == 1 else text


def formats_from(word: str) -> list[str]:
    """Return the formats that ``--figures png,svg`` names.

    Examples
    --------
    >>> formats_from("png, svg")
    ['png', 'svg']
    """
    known = ("png", "svg", "pdf")
    formats = [part.strip() for part in word.split(",") if part.strip()]
    wrong = [
        unknown_name("--figures", "format", part, known) for part in formats if part not in known
    ]
    if wrong:
        raise RailgripError(wrong)
    return formats
