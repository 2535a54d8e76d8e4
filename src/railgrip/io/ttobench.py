"""Reads the tracks of TTOBench (JSON with units) as lines."""

from __future__ import annotations

import math
import os
from itertools import pairwise
from pathlib import Path

from railgrip.io.checked import checked
from railgrip.io.ttobench_document import Document
from railgrip.scenario.line import Line

_PIECE = 10.0
"""Length of the constant-radius pieces that stand for a clothoid, m."""

_STRAIGHT = 1e-6
"""Curvature below which a piece counts as straight, 1/m (a radius of 1 000 km)."""


def read_ttobench_track(path: str | os.PathLike[str]) -> Line:
    """Return the line that a track file of TTOBench describes.

    ETCS data are not read.

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
    track = Document(Path(path))
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
        "tunnel": [
            {"from": at, "to": at + length, "cross_section": cross_section}
            for at, length, cross_section in track.rows(
                "tunnels", ("position", "length", "cross section"), optional=True
            )
        ],
        "stop": [{"at": at} for at in stops],
        "altitude": track.scalar("altitude", 0.0),
    }
    return checked(Line, description, track.path)


def _curves(track: Document, length: float) -> list[dict[str, float]]:
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
