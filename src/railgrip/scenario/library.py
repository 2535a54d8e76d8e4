"""What a name or a file name stands for: shipped data, the user's files, ``extends``."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from railgrip import data
from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.scenario.files import Table, is_path, printable, read_table
from railgrip.scenario.merge import merged

FOLDERS = {
    "train": "trains",
    "point_train": "point_trains",
    "line": "lines",
    "pad": "pads",
    "disc": "discs",
    "rail_condition": "rail_conditions",
    "contact_pair": "contact_pairs",
    "scenario": "scenarios",
    "profile": "profiles",
    "campaign": "campaigns",
}
"""Kind of description → its folder in the shipped data."""

_READERS = {
    ("line", ".json"): "ttobench",
    ("line", ".yaml"): "railtoolkit_path",
    ("point_train", ".json"): "ttobench_train",
    ("point_train", ".yaml"): "railtoolkit_train",
}
"""(Kind, ending of the file) → its reader; every other file is TOML."""

_MOST_PARENTS = 20


def names(kind: str) -> list[str]:
    """Return the names of what is shipped of a kind, sorted.

    Parameters
    ----------
    kind : str
        ``train``, ``line``, ``pad``, ``disc``, ``rail_condition``, ``contact_pair``, ``scenario``
        or ``profile``.

    Raises
    ------
    RailgripError
        ``kind of data 'trian' unknown; known: …; did you mean 'train'?``

    Examples
    --------
    >>> "level" in names("line")
    True
    """
    if kind not in FOLDERS:
        raise RailgripError(unknown_name("", "kind of data", kind, FOLDERS))
    return data.names(FOLDERS[kind])


def find(kind: str, word: str) -> Path:
    """Return the file that a name or path means; refuse an unknown name with the nearest."""
    if is_path(word):
        return Path(os.path.abspath(os.path.expanduser(word)))
    known = names(kind)
    if word not in known:
        raise RailgripError(unknown_name("", kind.replace("_", " "), printable(word), known))
    return data.path(FOLDERS[kind], word)


def fetch(kind: str, word: str) -> Any:
    """Return the table (or, from a reader of another format, the model) that a name means."""
    return _read(kind, find(kind, word), ())


def inherited(kind: str, table: Table, visited: tuple[Path, ...] = ()) -> Table:
    """Return a table laid over what it ``extends``, from the oldest parent down."""
    if "extends" not in table:
        return table
    own = {key: value for key, value in table.items() if key != "extends"}
    word = table["extends"]
    if not isinstance(word, str):
        raise RailgripError(Problem("extends", "must be a name or a file"))
    parent = find(kind, word)
    if parent in visited or len(visited) > _MOST_PARENTS:
        chain = " → ".join(path.name for path in (*visited, parent))
        raise RailgripError(Problem("extends", "the files extend each other in a circle", chain))
    below = _read(kind, parent, visited)
    return merged(below if isinstance(below, dict) else below.model_dump(by_alias=True), own)


def _read(kind: str, path: Path, visited: tuple[Path, ...]) -> Any:
    if (kind, path.suffix) in _READERS:
        return registry.resolve("railgrip.readers", _READERS[kind, path.suffix])(path)
    return inherited(kind, read_table(path), (*visited, path))
