"""Finds out what a file of another program is, reads it, and writes it as TOML."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from railgrip.core.errors import Problem, RailgripError
from railgrip.io.line_csv import read_line_csv
from railgrip.io.osrd import read_osrd_line, read_osrd_train
from railgrip.io.railml import read_railml
from railgrip.io.railtoolkit import read_railtoolkit_train
from railgrip.io.railtoolkit_path import read_railtoolkit_path
from railgrip.io.ttobench import read_ttobench_track
from railgrip.io.ttobench_train import read_ttobench_journey, read_ttobench_train
from railgrip.scenario.base import Model
from railgrip.scenario.files import read_text

_FORMATS = "JSON (TTOBench, OSRD), YAML (railtoolkit), XML (railML), CSV"


class Imported(NamedTuple):
    """What a file turned out to hold.

    Attributes
    ----------
    kind : str
        ``line``, ``point train`` or ``stops``.
    format : str
        Where it comes from.
    table : dict
        What to write as TOML: SI without units.
    summary : str
        One sentence.
    """

    kind: str
    format: str
    table: dict[str, Any]
    summary: str


def read_any(path: Path, tracks: Sequence[str] | None = None) -> Imported:
    """Return what a file of another program holds.

    Parameters
    ----------
    path : Path
        A file in one of the known formats.
    tracks : sequence of str, optional
        Which track, path or sections, or the vehicles of a formation, where the file holds several.

    Raises
    ------
    RailgripError
        ``line.kml: is of no known format; allowed: JSON (TTOBench, OSRD), …``

    Examples
    --------
    >>> from railgrip.data import path
    >>> read_any(path("lines", "slope")).summary
    'a line of 10.0 km: 1 speed limit, 11 gradients, 0 curves, 0 tunnels, 0 stops'
    """
    first = tracks[0] if tracks else None
    ending = path.suffix.lower()
    if ending == ".csv":
        return _model("line", "CSV", read_line_csv(path))
    if ending in (".xml", ".railml", ".railmlx"):
        return _model("line", "railML", read_railml(path, first))
    if ending in (".yaml", ".yml"):
        if "running-path" in read_text(path)[:2000]:
            return _model("line", "railtoolkit", read_railtoolkit_path(path, first))
        return _model("point train", "railtoolkit", read_railtoolkit_train(path, tracks))
    if ending != ".json":
        raise RailgripError(Problem(str(path), "is of no known format", allowed=_FORMATS))
    try:
        keys = set(json.loads(read_text(path)))
    except (ValueError, TypeError, RecursionError):
        keys = set()
    if "effort_curves" in keys:
        return _model("point train", "OSRD", read_osrd_train(path, first))
    if "track_sections" in keys:
        return _model("line", "OSRD", read_osrd_line(path, tracks))
    if "timing points" in keys:
        timed = read_ttobench_journey(path)
        stops = [stop.model_dump(exclude_defaults=True) for stop in timed.stops]
        text = f"{len(stops)} stops on {timed.track}"
        if timed.passing:
            text += f"; {len(timed.passing)} passing points have no place in a journey, left out"
        return Imported("stops", "TTOBench", {"title": timed.track, "stop": stops}, text)
    if "mass" in keys:
        return _model("point train", "TTOBench", read_ttobench_train(path))
    if not keys & {"metadata", "stops", "speed limits"}:
        raise RailgripError(Problem(str(path), "is of no known format", allowed=_FORMATS))
    return _model("line", "TTOBench", read_ttobench_track(path))


def _model(kind: str, source: str, model: Model) -> Imported:
    table = model.model_dump(by_alias=True, exclude_defaults=True, mode="json")
    if kind == "line":
        words = [
            f"{len(table.get(key, ()))} {name}{'' if len(table.get(key, ())) == 1 else 's'}"
            for key, name in (
                ("speed_limit", "speed limit"), ("gradient", "gradient"), ("curve", "curve"),
                ("tunnel", "tunnel"), ("stop", "stop"),
            )
        ]  # fmt: skip
        text = f"a line of {table['length'] / 1e3:.1f} km: {', '.join(words)}"
    else:
        text = f"a train of {table['mass'] / 1e3:.4g} t, {table['max_speed'] * 3.6:.4g} km/h"
    return Imported(kind, source, table, text)
