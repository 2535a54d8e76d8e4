"""Reads the trains and journeys of TTOBench (JSON with units)."""

from __future__ import annotations

import math
import os
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

from railgrip.io.checked import checked
from railgrip.io.ttobench_document import Document
from railgrip.scenario.line import LineStop
from railgrip.scenario.point_train import PointTrain


class PassingPoint(NamedTuple):
    """A place that is passed, SI; nan: free.

    Attributes
    ----------
    at : float
        Position, m.
    earliest, latest : float
        When, counted from the start, s.
    slowest, fastest : float
        How fast, m/s.
    """

    at: float
    earliest: float
    latest: float
    slowest: float
    fastest: float


class TimedStops(NamedTuple):
    """What a journey file says.

    Attributes
    ----------
    track : str
        Identifier of the track it belongs to.
    stops : tuple of LineStop
        With the shortest dwell that the departure allows.
    arrival : tuple of (float, float)
        Earliest and latest arrival at each stop, counted from the start, s; nan: free.
    passing : tuple of PassingPoint
        Between the stops. Journeys do not keep them; what is driven can be compared with them.
    """

    track: str
    stops: tuple[LineStop, ...]
    arrival: tuple[tuple[float, float], ...]
    passing: tuple[PassingPoint, ...] = ()


def read_ttobench_train(path: str | os.PathLike[str]) -> PointTrain:
    """Return the train that a file of TTOBench's train library describes.

    Parameters
    ----------
    path : str or path
        A JSON file of TTOBench, v1.1 to v1.5; seats, coaches and ETCS data are not read.

    Returns
    -------
    train : PointTrain
        Efficiencies count between DC link and wheel. Speed limits count at the front, as results
        published for these files do (``rear_clears = false``); change it for a real timetable.

    Raises
    ------
    RailgripError
        ``train.json: mass: is missing, or has no value``

    References
    ----------
    .. [1] D. Kouzoupis, I. Pendharkar, F. Corman, "TTOBench – an Open-Source Library for Train
       Trajectory Optimization", Operations Research Forum 4:67 (2023),
       doi 10.1007/s43069-023-00248-x, train description.

    Examples
    --------
    >>> from railgrip.data import path
    >>> read_ttobench_train(path("point_trains", "flirt_tpf")).mass
    122000.0
    """
    file = Document(Path(path))
    file.check_version()
    rotating = file.scalar("rho", 0.0)
    description: dict[str, Any] = {
        "title": file.text("id").replace("_", " "),
        "source": f"{file.text('library version')}, {file.text('license')}",
        "mass": file.scalar("mass"),
        "rotating": rotating - 1.0 if rotating >= 1.0 else rotating,
        "length": file.scalar("length", 0.0),
        "rear_clears": False,
        "max_speed": file.scalar("max speed"),
        "resistance": {
            "constant": file.scalar("rolling resistance r0"),
            "linear": file.scalar("rolling resistance r1"),
            "quadratic": file.scalar("rolling resistance r2"),
        },
        "tunnel_resistance": [
            {"cross_section": area, "quadratic": drag}
            for area, drag in file.rows(
                "tunnel resistance", ("cross section", "coefficient"), optional=True
            )
        ],
        "effort": {
            "force": file.scalar("max traction force"),
            "power": file.scalar("max traction power"),
        },
        "regeneration": {
            "force": file.scalar("max reg braking force"),
            "power": file.scalar("max reg braking power"),
        },
        "friction_brake": file.scalar("max pn braking force", 0.0),
        "efficiency": {
            "traction": file.scalar("efficiency traction", 1.0),
            "regeneration": file.scalar("efficiency reg brake", 1.0),
        },
    }
    for key, field in (
        ("max_acceleration", "max acceleration"),
        ("max_deceleration", "max deceleration"),
    ):
        if field in file.document:
            description[key] = file.scalar(field)
    return checked(PointTrain, description, file.path)


def read_ttobench_journey(path: str | os.PathLike[str]) -> TimedStops:
    """Return stops, dwells, arrival windows and passing points of a journey file of TTOBench.

    Parameters
    ----------
    path : str or path
        A JSON file of TTOBench v1.5.

    Raises
    ------
    RailgripError
        ``journey.json: timing points: must begin and end with a stopping point``

    Examples
    --------
    >>> from railgrip.data import path
    >>> found = read_ttobench_journey(path("journeys", "st_gallen_wil_01"))
    >>> [(stop.at, stop.dwell) for stop in found.stops]
    [(0.0, 0.0), (15000.0, 180.0), (29556.1, 0.0)]
    """
    file = Document(Path(path))
    file.check_version()
    rows = file.rows(
        "timing points",
        (
            "position", "lower time constraint", "upper time constraint",
            "lower speed constraint", "upper speed constraint",
        ),
    )  # fmt: skip
    halts = [row for row in rows if row[3] == 0.0 and row[4] == 0.0]
    if len(halts) < 2 or rows[0] not in halts or rows[-1] not in halts:
        file.refuse("timing points", "must begin and end with a stopping point")
    stops: list[LineStop] = []
    windows: list[tuple[float, float]] = []
    for at, earliest, latest, *_ in halts:
        if stops and stops[-1].at == at:
            dwell = earliest - windows[-1][0]
            if not dwell >= 0.0:
                dwell = 0.0 if math.isnan(dwell) else dwell
                if dwell < 0.0:
                    file.refuse("timing points", "departs before it arrives", got=f"{at:g} m")
            stops[-1] = checked(LineStop, {"at": at, "dwell": dwell}, file.path)
        else:
            stops.append(checked(LineStop, {"at": at, "dwell": 0.0}, file.path))
            windows.append((earliest, latest))
    passing = tuple(PassingPoint(*row) for row in rows if row not in halts)
    if any(b.at < a.at for a, b in pairwise(passing)):
        file.refuse("timing points", "must ascend by position")
    return TimedStops(file.text("associated track"), tuple(stops), tuple(windows), passing)
