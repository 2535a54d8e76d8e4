"""Reads rolling stock and infrastructure of OSRD (JSON), from the user's own copies.

Rolling stock is railjson's ``rolling_stock`` schema, version 3: effort curves by mode, resistance
A, B, C, constant deceleration. Infrastructure is RailJSON 3: a line is made of the track sections
that are named, one after the other.
"""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from railgrip.core.errors import Problem, RailgripError
from railgrip.io.checked import checked
from railgrip.scenario.files import check_depth, read_text
from railgrip.scenario.line import Line
from railgrip.scenario.point_train import PointTrain

_VERSIONS = ("3",)


def read_osrd_train(path: str | os.PathLike[str], mode: str | None = None) -> PointTrain:
    """Return the train of an OSRD rolling stock file.

    Parameters
    ----------
    path : str or path
        A JSON file of one rolling stock.
    mode : str, optional
        Traction mode; absent: the file's default mode. Its default curve is taken.

    Returns
    -------
    train : PointTrain
        Units of the file are kg, m, m/s, N; B is N/(m/s), C is N/(m/s)².

    Raises
    ------
    RailgripError
        ``train.json: effort_curves.modes: mode '25kV' unknown; allowed: 25000V, thermal``
    """
    file = Path(path)
    document = _document(file)
    version = str(document.get("railjson_version", document.get("version", "3"))).split(".")[0]
    if version not in _VERSIONS:
        _refuse(file, "railjson_version", "is none that can be read", version, "3.x")
    curves = _table(file, document, "effort_curves")
    modes = _table(file, curves, "modes", "effort_curves.")
    word = str(mode or curves.get("default_mode", ""))
    if word not in modes:
        _refuse(
            file, "effort_curves.modes", f"mode '{word}' unknown", allowed=", ".join(sorted(modes))
        )
    curve = modes[word].get("default_curve") if isinstance(modes[word], dict) else None
    where = f"effort_curves.modes.{word}.default_curve"
    if not isinstance(curve, dict):
        _refuse(file, where, "is missing")
    speeds, forces = curve.get("speeds"), curve.get("max_efforts")
    if not isinstance(speeds, list) or not isinstance(forces, list) or len(speeds) != len(forces):
        _refuse(file, where, "must have as many speeds as max_efforts")
    resistance = _table(file, document, "rolling_resistance")
    if resistance.get("type", "davis") != "davis":
        _refuse(file, "rolling_resistance.type", "is none that is known", str(resistance["type"]))
    description = {
        "title": str(document.get("name", ""))[:200],
        "source": "OSRD rolling stock",
        "mass": _number(file, document, "mass"),
        "rotating": _number(file, document, "inertia_coefficient", 1.0) - 1.0,
        "length": _number(file, document, "length"),
        "max_speed": _number(file, document, "max_speed"),
        "resistance": {
            "constant": _number(file, resistance, "A"),
            "linear": _number(file, resistance, "B"),
            "quadratic": _number(file, resistance, "C"),
        },
        "effort": {
            "table": [{"speed": v, "force": f} for v, f in zip(speeds, forces, strict=True)]
        },
        "max_deceleration": _gamma(file, document),
    }
    comfort = document.get("comfort_acceleration")
    if isinstance(comfort, int | float) and comfort > 0.0:
        description["max_acceleration"] = comfort
    return checked(PointTrain, description, file)


def read_osrd_line(path: str | os.PathLike[str], tracks: Sequence[str] | None = None) -> Line:
    """Return the line that track sections of an OSRD infrastructure make, from end to end.

    Parameters
    ----------
    path : str or path
        A RailJSON infrastructure.
    tracks : sequence of str, optional
        Ids of track sections in the order of travel, each from its beginning; an id with a
        leading "-" is travelled from its end. Absent: the first section alone.

    Returns
    -------
    line : Line
        Slopes (‰ in the file) and curves of the sections, and the speed sections without a
        restriction to certain trains, the least where several overlap; no limit at all where the
        file has none (a journey then asks for one).

    Raises
    ------
    RailgripError
        ``infra.json: track_sections: section 'TA9' unknown; allowed: TA0, TA1, …``
    """
    file = Path(path)
    document = _document(file)
    version = str(document.get("version", "3")).split(".")[0]
    if version not in _VERSIONS:
        _refuse(file, "version", "is none that can be read", version, "3.x")
    rows = document.get("track_sections")
    if not isinstance(rows, list) or not rows or not all(isinstance(row, dict) for row in rows):
        _refuse(file, "track_sections", "is missing")
    known = {str(row.get("id")): row for row in rows}
    wanted = list(tracks) if tracks is not None else [next(iter(known))]
    offset = 0.0
    gradients: list[tuple[float, float, float]] = []
    curves: list[dict[str, float]] = []
    limits: list[tuple[float, float, float]] = []
    for word in wanted:
        backwards, name = word.startswith("-"), word.removeprefix("-")
        if name not in known:
            _refuse(
                file,
                "track_sections",
                f"section '{name}' unknown",
                allowed=", ".join(sorted(known)),
            )
        length = _number(file, known[name], "length")
        for a, b, slope in _stretches(file, known[name], "slopes", "gradient", length, backwards):
            sign = -1.0 if backwards else 1.0
            gradients.append((offset + a, offset + b, sign * slope * 1e-3))
        for a, b, radius in _stretches(file, known[name], "curves", "radius", length, backwards):
            if radius:
                curves.append({"from": offset + a, "to": offset + b, "radius": abs(radius)})
        for a, b, speed in _speeds(file, document, name, length, backwards):
            limits.append((offset + a, offset + b, speed))
        offset += length
    permitted = _steps(limits, offset, lambda values: min(values, default=0.0))
    gaps = [step["at"] for step in permitted if step["value"] == 0.0]
    if gaps:
        _refuse(file, "speed_sections", "leave a gap", f"no limit from {gaps[0]:g} m")
    return checked(
        Line,
        {
            "title": " ".join(wanted)[:200],
            "source": "OSRD infrastructure",
            "length": offset,
            "gradient": _steps(gradients, offset, lambda values: sum(values)),
            "curve": curves,
            "speed_limit": permitted,
        },
        file,
    )


def _stretches(
    file: Path, row: dict[str, Any], field: str, value: str, length: float, backwards: bool
) -> list[tuple[float, float, float]]:
    found = []
    for one in _rows(file, row, field):
        a, b = _number(file, one, "begin", 0.0), _number(file, one, "end", length)
        a, b = (length - b, length - a) if backwards else (a, b)
        found.append((a, b, _number(file, one, value)))
    return sorted(found)


def _speeds(
    file: Path, document: dict[str, Any], track: str, length: float, backwards: bool
) -> list[tuple[float, float, float]]:
    found = []
    against = "STOP_TO_START" if backwards else "START_TO_STOP"
    for section in _rows(file, document, "speed_sections"):
        if section.get("speed_limit") is None or section.get("on_routes"):
            continue
        speed = _number(file, section, "speed_limit")
        for part in _rows(file, section, "track_ranges"):
            directions = part.get("applicable_directions", "BOTH")
            if part.get("track") == track and directions in ("BOTH", against):
                a, b = _number(file, part, "begin"), _number(file, part, "end")
                a, b = (length - b, length - a) if backwards else (a, b)
                found.append((a, b, speed))
    return found


def _steps(
    stretches: list[tuple[float, float, float]], length: float, joined: Any
) -> list[dict[str, float]]:
    """Return what holds from where on; a place that nothing covers is 0, a limit left out."""
    marks = sorted({0.0, *(x for a, b, _ in stretches for x in (a, b) if x < length)})
    found: list[dict[str, float]] = []
    for mark in marks:
        value = joined([v for a, b, v in stretches if a <= mark < b])
        if not found or found[-1]["value"] != value:
            found.append({"at": mark, "value": value})
    return found if stretches else []


def _gamma(file: Path, document: dict[str, Any]) -> float:
    gamma = document.get("const_gamma", document.get("gamma"))
    if isinstance(gamma, dict):
        gamma = gamma.get("value")
    if isinstance(gamma, bool) or not isinstance(gamma, int | float):
        _refuse(file, "const_gamma", "is missing")
    return abs(float(gamma))


def _number(file: Path, table: dict[str, Any], key: str, default: float | None = None) -> float:
    value = table.get(key, default)
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e12:
        _refuse(file, key, "must be a number", repr(value)[:60])
    return float(value)


def _table(file: Path, table: dict[str, Any], key: str, before: str = "") -> dict[str, Any]:
    value = table.get(key)
    if not isinstance(value, dict):
        _refuse(file, before + key, "is missing")
    return dict(value)


def _rows(file: Path, table: dict[str, Any], key: str) -> list[dict[str, Any]]:
    rows = table.get(key) or []
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        _refuse(file, key, "must be a list of tables")
    return rows


def _document(file: Path) -> dict[str, Any]:
    try:
        document = json.loads(read_text(file))
    except RecursionError:
        _refuse(file, "", "is nested too deeply")
    except ValueError as error:
        _refuse(file, "", f"is not valid JSON: {error}")
    if not isinstance(document, dict):
        _refuse(file, "", "must hold a JSON object")
    check_depth(document, str(file))
    return dict(document)


def _refuse(file: Path, where: str, what: str, got: str = "", allowed: str = "") -> NoReturn:
    raise RailgripError(Problem(f"{file}: {where}" if where else str(file), what, got, allowed))
