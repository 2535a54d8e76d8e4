"""Reads a line from CSV: one row for each place where something changes."""

from __future__ import annotations

import csv
import os
from pathlib import Path
from typing import Any, NoReturn

from railgrip.core.errors import Problem, RailgripError
from railgrip.io.checked import checked
from railgrip.scenario.files import read_text
from railgrip.scenario.line import Line

_SCALES = {"position_m": 1.0, "position_km": 1e3, "speed_kmh": 1 / 3.6, "gradient_permille": 1e-3}
MOST_ROWS = 20_000


def read_line_csv(path: str | os.PathLike[str]) -> Line:
    """Return the line of a CSV file.

    Parameters
    ----------
    path : str or path
        With a header of ``position_m`` or ``position_km``, ``speed_kmh``, and where wanted
        ``gradient_permille`` and ``stop`` (a name, or ``x``). An empty cell: goes on as before.
        Separated by comma or semicolon. The last row is the end of the line.

    Returns
    -------
    line : Line
        From position 0, which is where the first row stands.

    Raises
    ------
    RailgripError
        ``line.csv: line 3, speed_kmh: must be a number; got 'fast'``
    """
    file = Path(path)
    text = read_text(file).removeprefix("\ufeff")
    first = text.partition("\n")[0]
    rows = list(csv.DictReader(text.splitlines(), delimiter=";" if ";" in first else ","))
    names = [name for name in ("position_m", "position_km") if rows and name in rows[0]]
    if len(names) != 1 or "speed_kmh" not in rows[0] or len(rows) < 2:
        _refuse(file, "", "needs a header with position_m (or position_km) and speed_kmh, and rows")
    if len(rows) > MOST_ROWS:
        _refuse(file, "", "has too many rows", f"{len(rows)}", f"up to {MOST_ROWS}")
    places = [_number(file, k, row, names[0]) for k, row in enumerate(rows)]
    if any(place is None for place in places):
        _refuse(file, names[0], "must stand in every row")
    zero = places[0] or 0.0
    found: dict[str, list[dict[str, Any]]] = {"speed_limit": [], "gradient": [], "stop": []}
    for k, (row, place) in enumerate(zip(rows, places, strict=True)):
        at = (place or 0.0) - zero
        for key, column in (("speed_limit", "speed_kmh"), ("gradient", "gradient_permille")):
            value = _number(file, k, row, column)
            if value is not None and k + 1 < len(rows):
                found[key].append({"at": at, "value": value})
        if (row.get("stop") or "").strip():
            found["stop"].append({"at": at, "name": str(row["stop"]).strip()})
    description = {"title": file.stem, "source": file.name, "length": (places[-1] or 0.0) - zero}
    return checked(Line, {**description, **found}, file)


def _number(file: Path, index: int, row: dict[str, Any], column: str) -> float | None:
    text = str(row.get(column) or "").strip()
    if not text:
        return None
    try:
        number = float(text)
    except ValueError:
        number = float("nan")
    if not abs(number) < 1e9:
        _refuse(file, f"line {index + 2}, {column}", "must be a number", repr(text)[:40])
    return number * _SCALES[column]


def _refuse(file: Path, where: str, what: str, got: str = "", allowed: str = "") -> NoReturn:
    raise RailgripError(Problem(f"{file}: {where}" if where else str(file), what, got, allowed))
