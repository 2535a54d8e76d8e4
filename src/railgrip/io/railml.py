"""Reads lines of railML 2.4 and 3 (XML): tracks, gradients and speeds.

The file is read as a stream, and one that declares a document type is refused: entities could
make it grow without end or read other files.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree
from xml.parsers import expat

from railgrip.io.checked import checked
from railgrip.io.railml_3 import NetElements, number, refuse
from railgrip.scenario.line import Line

MOST_BYTES = 200_000_000
_VERSIONS = ("2.2", "2.3", "2.4", "2.5", "3.1", "3.2", "3.3")
_CHUNK = 1 << 16


class _Track(NamedTuple):
    name: str
    length: float
    gradients: list[tuple[float, float]]
    speeds: list[tuple[float, float]]
    radii: list[tuple[float, float]]


def read_railml(path: str | os.PathLike[str], track: str | None = None) -> Line:
    """Return a track of a railML file as a line, in the direction of rising positions.

    Parameters
    ----------
    path : str or path
        railML 2.2 to 2.5 (``track`` with ``trackElements``) or 3.1 to 3.3 (``netElement`` with
        gradient curves and speed sections located on it, by intrinsic or by linear coordinates).
    track : str, optional
        Id of the track or net element; absent: the first that has a length.

    Returns
    -------
    line : Line
        Gradients (‰ in the file), speed changes without a train category, radii. Speeds of the
        other direction and temporary ones of railML 3 are left out; what begins on a net element
        holds to the next entry there.

    Raises
    ------
    RailgripError
        ``line.railml: declares a document type; …`` or
        ``line.railml: railml.version: is none that can be read; got '1.1'; allowed: 2.2 to 3.3``
    """
    file = Path(path)
    _refuse_doctype(file)
    try:
        tracks = _read(file)
    except ElementTree.ParseError as error:
        refuse(file, f"is not valid XML: {error}")
    if not tracks:
        refuse(file, "holds no track with a length")
    found = tracks[0] if track is None else next((one for one in tracks if one.name == track), None)
    if found is None:
        known = ", ".join(one.name for one in tracks[:20])
        refuse(file, f"track '{track}' unknown", allowed=known)
    edges = [at for at, _ in found.radii[1:]] + [found.length]
    return checked(
        Line,
        {
            "title": found.name,
            "source": "railML",
            "length": found.length,
            "gradient": _steps(found.gradients, 1e-3),
            "speed_limit": _steps(found.speeds, 1 / 3.6),
            "curve": [
                {"from": at, "to": end, "radius": abs(radius)}
                for (at, radius), end in zip(found.radii, edges, strict=False)
                if radius and end > at
            ],
        },
        file,
    )


def _refuse_doctype(file: Path) -> None:
    """Read the prolog only, and stop at the root."""

    class _Done(Exception):  # noqa: N818
        pass

    def declared(*_: Any) -> None:
        refuse(file, "declares a document type, which may hide entities", cure="remove <!DOCTYPE>")

    def done(*_: Any) -> None:
        raise _Done

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = declared
    parser.StartElementHandler = done
    try:
        if file.is_dir():
            refuse(file, "is a folder", cure="name the file in it")
        if file.stat().st_size > MOST_BYTES:
            refuse(file, "is too large", allowed=f"up to {MOST_BYTES // 1_000_000} MB")
        with file.open("rb") as stream:
            while chunk := stream.read(_CHUNK):
                parser.Parse(chunk, False)
    except _Done:
        return
    except FileNotFoundError:
        refuse(file, "there is no such file")
    except OSError as error:
        refuse(file, "cannot be read", got=error.strerror or str(error))
    except expat.ExpatError as error:
        refuse(file, f"is not valid XML: {error}")
    refuse(file, "is empty")


def _read(file: Path) -> list[_Track]:
    tracks: list[_Track] = []
    three = NetElements(file)
    is_first = True
    for event, element in ElementTree.iterparse(file, events=("start", "end")):
        tag = element.tag.rpartition("}")[2]
        if is_first:
            is_first = False
            version = element.get("version", "")
            if tag.lower() != "railml" or version[:3] not in _VERSIONS:
                where = f"railml.version: is none that can be read (root element '{tag[:40]}')"
                refuse(file, where, got=repr(version[:40]), allowed="2.2 to 2.5, 3.1 to 3.3")
        if event == "start":
            continue
        if tag == "track" and element.find(".//{*}trackTopology") is not None:
            one = _track_2(file, element)
            if one.length > 0.0:
                tracks.append(one)
            element.clear()
        elif three.take(tag, element):
            element.clear()
    for name, length, (gradients, speeds, radii) in three.rows():
        tracks.append(_Track(name, length, gradients, speeds, radii))
    return tracks


def _track_2(file: Path, element: Any) -> _Track:
    begin = element.find(".//{*}trackTopology/{*}trackBegin")
    end = element.find(".//{*}trackTopology/{*}trackEnd")
    if begin is None or end is None:
        return _Track(element.get("id", ""), 0.0, [], [], [])
    zero, last = number(file, begin, "pos"), number(file, end, "pos")

    def rows(tag: str, value: str) -> list[tuple[float, float]]:
        return sorted(
            (number(file, one, "pos") - zero, number(file, one, value))
            for one in element.iterfind(f".//{{*}}trackElements//{{*}}{tag}")
            if one.get(value) is not None
            and one.get("trainCategory") is None
            and one.get("dir", "up") in ("up", "both", "unknown")
        )

    return _Track(
        element.get("id", ""), last - zero,
        rows("gradientChange", "slope"),
        rows("speedChange", "vMax"),
        rows("radiusChange", "radius"),
    )  # fmt: skip


def _steps(rows: list[tuple[float, float]], scale: float) -> list[dict[str, float]]:
    found: list[dict[str, float]] = []
    for at, value in rows:
        if found and found[-1]["at"] == at:
            found[-1]["value"] = value * scale
        elif not found or found[-1]["value"] != value * scale:
            found.append({"at": at, "value": value * scale})
    return found
