"""Reads running paths of railtoolkit (YAML, schemas 2022.05 and 2024.07)."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from railgrip.io.checked import checked
from railgrip.io.railtoolkit_document import document_of, refuse
from railgrip.scenario.line import Line


def read_railtoolkit_path(path: str | os.PathLike[str], name: str | None = None) -> Line:
    """Return the line of a running path.

    Parameters
    ----------
    path : str or path
        A file with ``paths``.
    name : str, optional
        Id of the path; absent: the first.

    Returns
    -------
    line : Line
        Path resistance as gradient; it begins at 0 whatever the first station is.

    Raises
    ------
    RailgripError
        ``path.yaml: schema_version: is none that can be read; got '2023.01'; allowed: …``

    Examples
    --------
    >>> from railgrip.data import path
    >>> read_railtoolkit_path(path("lines", "slope")).gradient[3].value
    0.005
    """
    file = Path(path)
    document = document_of(file, "running-path")
    paths = document.get("paths")
    if not isinstance(paths, list) or not all(isinstance(one, dict) for one in paths) or not paths:
        refuse(file, "paths", "is missing")
    found = [one for one in paths if name is None or one.get("id") == name]
    if not found:
        known = ", ".join(str(one.get("id")) for one in paths)
        refuse(file, "paths", f"path '{name}' unknown", allowed=known)
    rows = _listed(found[0].get("characteristic_sections"))
    if (
        not isinstance(rows, list) or len(rows) < 2
        or any(not isinstance(row, list) or len(row) != 3 for row in rows)
        or any(not isinstance(x, int | float) or isinstance(x, bool) for row in rows for x in row)
    ):  # fmt: skip
        refuse(file, "characteristic_sections", "must hold rows of station, speed and resistance")
    zero = rows[0][0]
    return checked(
        Line,
        {
            "title": str(found[0].get("name", ""))[:200],
            "source": f"railtoolkit, schema {document['schema_version']}",
            "length": rows[-1][0] - zero,
            "speed_limit": _changes([(at - zero, v / 3.6) for at, v, _ in rows[:-1]]),
            "gradient": _changes([(at - zero, slope * 1e-3) for at, _, slope in rows[:-1]]),
        },
        file,
    )


def _listed(rows: Any) -> Any:
    """Return sections that are tables (2024.07) as rows; what one leaves out goes on as it was."""
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        return rows
    found: list[list[Any]] = []
    for row in rows:
        speed, resistance = found[-1][1:] if found else (None, 0.0)
        entry = row.get("position"), row.get("speed", speed), row.get("resistance", resistance)
        found.append([*entry])
    return found


def _changes(rows: list[tuple[float, float]]) -> list[dict[str, float]]:
    kept = [row for k, row in enumerate(rows) if k == 0 or row[1] != rows[k - 1][1]]
    return [{"at": at, "value": value} for at, value in kept]
