"""The shipped trains, lines, rail conditions, pads, scenarios, test profiles and more, by name.

This package holds files, not numbers in code. It only says which names exist and where their
files lie, so that nothing else has to know the folders.
"""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from railgrip.core.errors import RailgripError, unknown_name

KINDS = (
    "trains", "point_trains", "rolling_stock", "lines", "journeys", "rail_conditions",
    "contact_pairs", "pads", "discs", "scenarios", "profiles", "safety", "campaigns",
)  # fmt: skip
"""The kinds of shipped data; each is a folder of this package."""


def names(kind: str) -> list[str]:
    """Return the names of the shipped files of one kind, sorted.

    Parameters
    ----------
    kind : str
        One of `KINDS`.

    Returns
    -------
    names : list of str
        Lower-case names with underscores, as scenario files use them.

    Raises
    ------
    RailgripError
        ``kind of data 'train' unknown; known: …; did you mean 'trains'?``

    Examples
    --------
    >>> len(names("lines")) >= 16
    True
    >>> "st_gallen_wil" in names("lines")
    True
    """
    return sorted(_files(kind))


def path(kind: str, name: str) -> Path:
    """Return the file of a shipped name.

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    name : str
        A name from :func:`names`.

    Returns
    -------
    path : Path
        An existing file; ``.toml``, or the format of its source: ``.json`` (TTOBench), ``.yaml``
        (railtoolkit).

    Raises
    ------
    RailgripError
        ``line 'st_gallen_wyl' unknown; known: …; did you mean 'st_gallen_wil'?``

    Examples
    --------
    >>> path("lines", "st_gallen_wil").name
    'st_gallen_wil.json'
    """
    files = _files(kind)
    if name not in files:
        raise RailgripError(unknown_name("", _singular(kind), name, files))
    return files[name]


def _files(kind: str) -> dict[str, Path]:
    """Return name → file of one kind."""
    if kind not in KINDS:
        raise RailgripError(unknown_name("", "kind of data", kind, KINDS))
    folder = Path(str(resources.files("railgrip.data"))) / kind
    return {
        file.stem: file
        for ending in ("toml", "json", "yaml")
        for file in folder.rglob(f"*.{ending}")
    }


def _singular(kind: str) -> str:
    if kind == "safety":
        return "safety case"
    return kind.removesuffix("s").replace("_", " ")
