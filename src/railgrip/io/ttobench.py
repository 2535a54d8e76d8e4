"""Reads the tracks of TTOBench (JSON with units) as lines."""

from __future__ import annotations

import json
import math
import os
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any, NoReturn

from pydantic import ValidationError

from railgrip.core.errors import Problem, RailgripError
from railgrip.scenario.explain import problems_of
from railgrip.scenario.files import check_depth, read_text
from railgrip.scenario.line import Line

_UNITS = {
    "position": {"m": 1.0, "km": 1e3},
    "velocity": {"km/h": 1 / 3.6, "m/s": 1.0},
    "slope": {"permil": 1e-3, "‰": 1e-3, "%": 1e-2, "-": 1.0},
    "radius at start": {"m": 1.0, "km": 1e3},
    "radius at end": {"m": 1.0, "km": 1e3},
}
_PIECE = 10.0
"""Length of the constant-radius pieces that stand for a clothoid, m."""

_STRAIGHT = 1e-6
"""Curvature below which a piece counts as straight, 1/m (a radius of 1 000 km)."""


def read_ttobench_track(path: str | os.PathLike[str]) -> Line:
    """Return the line that a track file of TTOBench describes.

    Stops only give the length; altitude, tunnels and ETCS data are not read.

    Parameters
    ----------
    path : str or path
        A JSON file of TTOBench's track library, format of v1.1 to v1.5.

    Returns
    -------
    line : Line
        Gradients positive uphill, speed limits m/s, curves with radius > 0 m on either hand.

    Raises
    ------
    RailgripError
        ``track.json: gradients.units.slope: unknown unit; got 'deg'; allowed: permil, ‰, %, -``

    Notes
    -----
    A clothoid, whose curvature changes evenly along it, becomes pieces of at most 10 m with the
    mean curvature of each, so that the angle turned is kept.

    References
    ----------
    .. [1] D. Kouzoupis, I. Pendharkar, F. Corman, "TTOBench – an Open-Source Library for Train
       Trajectory Optimization", Operations Research Forum 4:67 (2023),
       doi 10.1007/s43069-023-00248-x, track description.

    Examples
    --------
    >>> from railgrip.data import path
    >>> read_ttobench_track(path("lines", "fribourg_bern")).length
    31240.7
    """
    track = _Track(Path(path))
    stops = [row[0] for row in track.rows("stops", ("position",))]
    if len(stops) < 2 or stops[0] != 0.0 or any(b <= a for a, b in pairwise(stops)):
        track.refuse("stops", "must begin with 0 and ascend, the last one being the length")
    description = {
        "title": track.text("id").replace("_", " "),
        "source": f"{track.text('library version')}, {track.text('license')}",
        "length": stops[-1],
        "gradient": [
            {"at": at, "value": slope}
            for at, slope in track.sections("gradients", ("position", "slope"), optional=True)
        ],
        "speed_limit": [
            {"at": at, "value": speed}
            for at, speed in track.sections("speed limits", ("position", "velocity"))
        ],
        "curve": _curves(track, stops[-1]),
    }
    try:
        return Line.model_validate(description)
    except ValidationError as error:
        raise RailgripError(
            replace(problem, where=f"{track.path}: {problem.where}")
            for problem in problems_of(error, Line)
        ) from None


class _Track:
    """The JSON document, asked for one field at a time."""

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self.document = json.loads(read_text(path), parse_constant=self._no_constant)
        except RecursionError:
            self.refuse("", "is nested too deeply")
        except ValueError as error:
            self.refuse("", f"is not valid JSON: {error}")
        check_depth(self.document, str(path))
        if not isinstance(self.document, dict):
            self.refuse("", "must hold a JSON object")

    def refuse(self, where: str, what: str, got: str = "", allowed: str = "") -> NoReturn:
        place = f"{self.path}: {where}" if where else str(self.path)
        raise RailgripError(Problem(place, what, got[:80], allowed))

    def _no_constant(self, word: str) -> NoReturn:
        self.refuse("", "holds a number that is none", got=word)

    def text(self, key: str) -> str:
        metadata = self.document.get("metadata")
        value = metadata.get(key, "") if isinstance(metadata, dict) else ""
        return str(value)[:200]

    def rows(
        self, field: str, columns: tuple[str, ...], optional: bool = False
    ) -> list[tuple[float, ...]]:
        """Return the rows of one field in SI."""
        if optional and field not in self.document:
            return []
        table = self.document.get(field)
        values = table.get("values") if isinstance(table, dict) else None
        if not isinstance(table, dict) or not isinstance(values, list) or not values:
            self.refuse(field, "is missing, or has no values")
        units = table.get("units", {columns[0]: table.get("unit")})
        scales = [self._scale(field, column, units) for column in columns]
        return [
            self._row(f"{field}.values[{i}]", row if len(columns) > 1 else [row], scales)
            for i, row in enumerate(values)
        ]

    def sections(
        self, field: str, columns: tuple[str, ...], optional: bool = False
    ) -> list[tuple[float, ...]]:
        """Return the rows of a field whose first entry must stand at the beginning."""
        rows = self.rows(field, columns, optional)
        if rows and rows[0][0] != 0.0:
            self.refuse(f"{field}.values[0]", "must begin at position 0", got=f"{rows[0][0]:g} m")
        return rows

    def _scale(self, field: str, column: str, units: Any) -> float:
        known = _UNITS[column]
        unit = units.get(column) if isinstance(units, dict) else None
        if not isinstance(unit, str) or unit not in known:
            self.refuse(
                f"{field}.units.{column}", "unknown unit", got=repr(unit), allowed=", ".join(known)
            )
        return known[unit]

    def _row(self, where: str, row: Any, scales: list[float]) -> tuple[float, ...]:
        if not isinstance(row, list) or len(row) != len(scales):
            self.refuse(where, f"must have {len(scales)} entries", got=repr(row))
        numbers = [self._number(where, value) for value in row]
        if not math.isfinite(numbers[0]):
            self.refuse(where, "must have a finite position", got=repr(row))
        return tuple(a * b for a, b in zip(numbers, scales, strict=True))

    def _number(self, where: str, value: Any) -> float:
        if value == "infinity":
            return math.inf
        if isinstance(value, bool) or not isinstance(value, int | float) or abs(value) > 1e9:
            self.refuse(where, "must hold numbers", got=repr(value))
        return float(value)


def _curves(track: _Track, length: float) -> list[dict[str, float]]:
    """Return the curves of a track as stretches of constant radius."""
    columns = ("position", "radius at start", "radius at end")
    rows = track.sections("curvatures", columns, optional=True)
    if any(0.0 in row[1:] for row in rows):
        track.refuse("curvatures", "must not hold a radius of 0")
    ends = [row[0] for row in rows[1:]] + [length]
    return [
        {"from": a, "to": b, "radius": 1 / curvature}
        for (begin, first, last), end in zip(rows, ends, strict=False)
        for a, b, curvature in _pieces(begin, end, first, last)
        if curvature > _STRAIGHT
    ]


def _pieces(
    begin: float, end: float, first_radius: float, last_radius: float
) -> list[tuple[float, float, float]]:
    """Return (begin, end, mean curvature) of the pieces of one curve or clothoid."""
    even = first_radius == last_radius
    count = 1 if even else max(1, math.ceil((end - begin) / _PIECE))
    edges = [begin + (end - begin) * k / count for k in range(count)] + [end]
    middles = [(k + 0.5) / count for k in range(count)]
    return [
        (a, b, abs((1 - share) / first_radius + share / last_radius))
        for (a, b), share in zip(pairwise(edges), middles, strict=True)
    ]
