"""A JSON document of TTOBench, asked for one field at a time; every number has its unit."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, NoReturn

from railgrip.core.errors import Problem, RailgripError
from railgrip.scenario.files import check_depth, read_text

_UNITS = {
    "position": {"m": 1.0, "km": 1e3},
    "velocity": {"km/h": 1 / 3.6, "m/s": 1.0},
    "slope": {"permil": 1e-3, "‰": 1e-3, "%": 1e-2, "-": 1.0},
    "radius at start": {"m": 1.0, "km": 1e3},
    "radius at end": {"m": 1.0, "km": 1e3},
    "length": {"m": 1.0, "km": 1e3},
    "cross section": {"m^2": 1.0},
    "coefficient": {"kN/(km/h)^2": 12960.0, "N/(m/s)^2": 1.0},
    "lower time constraint": {"s": 1.0, "min": 60.0},
    "upper time constraint": {"s": 1.0, "min": 60.0},
    "lower speed constraint": {"km/h": 1 / 3.6, "m/s": 1.0},
    "upper speed constraint": {"km/h": 1 / 3.6, "m/s": 1.0},
}
_SCALARS = {
    "m": 1.0, "km": 1e3, "kg": 1.0, "t": 1e3, "%": 1e-2, "-": 1.0, "kW": 1e3, "W": 1.0, "MW": 1e6,
    "kN": 1e3, "N": 1.0, "m/s^2": 1.0, "km/h": 1 / 3.6, "m/s": 1.0,
    "kN/(km/h)": 3600.0, "N/(m/s)": 1.0, "kN/(km/h)^2": 12960.0, "N/(m/s)^2": 1.0,
}  # fmt: skip
_VERSIONS = tuple(f"TTOBench v1.{minor}" for minor in range(1, 6))


class Document:
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

    def check_version(self) -> None:
        """Refuse a file of another format or of a version that is not known here."""
        version = self.text("library version")
        if version not in _VERSIONS:
            self.refuse(
                "metadata.library version",
                "is none that can be read",
                got=repr(version),
                allowed=f"{_VERSIONS[0]} to {_VERSIONS[-1].split()[1]}",
            )

    def scalar(self, field: str, default: float | None = None) -> float:
        """Return one number with its unit, SI."""
        table = self.document.get(field)
        if table is None and default is not None:
            return default
        if not isinstance(table, dict) or "value" not in table:
            self.refuse(field, "is missing, or has no value")
        unit = table.get("unit")
        if not isinstance(unit, str) or unit not in _SCALARS:
            self.refuse(
                f"{field}.unit", "unknown unit", got=repr(unit), allowed=", ".join(_SCALARS)
            )
        number = self._number(field, table["value"])
        if not math.isfinite(number):
            self.refuse(field, "must be finite")
        return number * _SCALARS[unit]

    def refuse(self, where: str, what: str, got: str = "", allowed: str = "") -> NoReturn:
        """Raise what is wrong at a place of the document."""
        place = f"{self.path}: {where}" if where else str(self.path)
        raise RailgripError(Problem(place, what, got[:80], allowed))

    def _no_constant(self, word: str) -> NoReturn:
        self.refuse("", "holds a number that is none", got=word)

    def text(self, key: str) -> str:
        """Return an entry of the metadata."""
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
        if value is None and where.startswith("timing points"):
            return math.nan
        if isinstance(value, bool) or not isinstance(value, int | float) or abs(value) > 1e9:
            self.refuse(where, "must hold numbers", got=repr(value))
        return float(value)
