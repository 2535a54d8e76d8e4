"""TOML text → table: every way in which a file can be broken ends in one sentence."""

from __future__ import annotations

import os
import re
import tomllib
from pathlib import Path
from typing import Any

from railgrip.core.errors import Problem, RailgripError

Table = dict[str, Any]

MOST_BYTES = 5_000_000
MOST_DEPTH = 40
MOST_ENTRIES = 20_000
MOST_VALUES = 250_000

# tomllib takes quadratic time over a key of many dotted parts.
_LONG_KEY = re.compile(r"""(?<![\w"'-])(?:[\w"'-]++[ \t]*+\.[ \t]*+){60}""")

# These name another file; relative to the file that names it.
_POINTERS = frozenset({"extends", "train", "line", "use", "condition", "pad", "disc", "controller"})


def read_text(path: Path) -> str:
    """Return the text of a file; refuse what is missing, too large or no text."""
    where = printable(str(path), 300)
    try:
        if path.is_dir():
            raise RailgripError(Problem(where, "is a folder", cure="name the file in it"))
        size = path.stat().st_size
        if size > MOST_BYTES:
            raise RailgripError(
                Problem(
                    where,
                    "is too large to be a description",
                    got=f"{size / 1e6:.1f} MB",
                    allowed=f"up to {MOST_BYTES / 1e6:g} MB",
                )
            )
        with path.open("rb") as file:
            raw = file.read(MOST_BYTES + 1)
    except FileNotFoundError:
        raise RailgripError(Problem(where, "there is no such file")) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise RailgripError(Problem(where, "cannot be read", got=reason)) from None
    return _decode(raw, where)


def _decode(raw: bytes, where: str) -> str:
    if len(raw) > MOST_BYTES:  # a pipe or a device has no size to look at first
        raise RailgripError(Problem(where, "is too large to be a description"))
    if b"\0" in raw:
        raise RailgripError(Problem(where, "is not a text file"))
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        column = error.start - raw.rfind(b"\n", 0, error.start)
        raise RailgripError(
            Problem(
                where,
                f"is not UTF-8 text (at line {line}, column {column})",
                cure="save it as UTF-8",
            )
        ) from None


def parse(text: str, where: str = "") -> Table:
    """Return the table that a TOML text holds.

    Examples
    --------
    >>> parse('speed = "160 km/h"')
    {'speed': '160 km/h'}
    """
    if len(text) > MOST_BYTES:
        raise RailgripError(Problem(where, "is too large to be a description"))
    if _LONG_KEY.search(text):
        raise RailgripError(Problem(where, "has a key of very many parts"))
    try:
        table = tomllib.loads(text.removeprefix("\ufeff"))
    except tomllib.TOMLDecodeError as error:
        raise RailgripError(Problem(where, f"is not valid TOML: {error}")) from None
    except RecursionError:
        raise RailgripError(Problem(where, "is nested too deeply")) from None
    except (ValueError, OverflowError) as error:  # numbers and dates beyond Python's own limits
        raise RailgripError(Problem(where, f"is not valid TOML: {error}")) from None
    check_depth(table, where)
    return table


def check_depth(table: Any, where: str = "") -> None:
    """Refuse what is nested so deeply, or holds so much, that nothing else could walk it."""
    level: list[Any] = [[table]]
    values = 0
    for _ in range(MOST_DEPTH + 1):
        below: list[Any] = []
        for value in level:
            entries = value.values() if isinstance(value, dict) else value
            if len(entries) > MOST_ENTRIES:
                raise RailgripError(
                    Problem(
                        where,
                        "has a list or table of too many entries",
                        got=f"{len(entries)}",
                        allowed=f"up to {MOST_ENTRIES}",
                    )
                )
            values += len(entries)
            below.extend(entry for entry in entries if isinstance(entry, (dict, list, tuple)))
        if values > MOST_VALUES:
            raise RailgripError(
                Problem(where, "holds too many values", allowed=f"up to {MOST_VALUES}")
            )
        if not below:
            return
        level = below
    raise RailgripError(Problem(where, "is nested too deeply", allowed=f"{MOST_DEPTH} levels"))


def read_table(path: str | os.PathLike[str]) -> Table:
    """Return the table of a TOML file, its pointers to other files made absolute."""
    file = Path(path)
    return anchored(parse(read_text(file), printable(str(file), 300)), file.parent)


def anchored(table: Table, folder: Path) -> Table:
    """Return the table with each relative file name below it counted from a folder."""

    def walk(key: str, value: Any) -> Any:
        if isinstance(value, dict):
            return {inner: walk(inner, item) for inner, item in value.items()}
        if isinstance(value, list):
            return [walk("", item) for item in value]
        if key in _POINTERS and isinstance(value, str) and is_path(value):
            return os.path.abspath(folder / os.path.expanduser(value))
        return value

    return {key: walk(key, value) for key, value in table.items()}


def printable(word: str, most: int = 60) -> str:
    """Return a word from a file as it can stand in a one-line message.

    Examples
    --------
    >>> printable("wet\\nleaves")
    'wet\\\\nleaves'
    """
    if not word.isprintable():
        word = word.encode("unicode_escape").decode("ascii")
    return word if len(word) <= most else f"{word[:most]}…"


def is_path(word: str) -> bool:
    """Whether a reference names a file and not something shipped.

    Examples
    --------
    >>> is_path("my_train.toml"), is_path("emu_four_car")
    (True, False)
    """
    return word.endswith((".toml", ".json", ".yaml", ".py")) or word.startswith((".", "/", "~"))
