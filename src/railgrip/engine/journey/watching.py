"""What the supervision would say of a run: its status along the way, and how near each limit came.

The run may have been driven in any way; nothing is changed by watching it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from railgrip.control.etcs.limit_table import LIMITS, LimitTable
from railgrip.control.etcs.supervised_way import SupervisedWay, excess
from railgrip.engine.journey.legs import Leg
from railgrip.engine.journey.supervision import Onboard
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

STATUS: Final = ("normal", "indication", "overspeed", "warning", "service brake", "emergency brake")
"""By how many limits are passed."""
OVER: Final = 1e-4
"""A speed that is above a limit by no more than this is not, m/s."""
PLACES: Final = 5.0
"""Between two points of the curves, m."""


class Said(NamedTuple):
    """An entry of the log: where the status changed, and the target that decides it."""

    time: float
    position: float
    speed: float
    status: str
    target: float
    """Position, or nan for the speed limit here, m."""


class Approach(NamedTuple):
    """How a run came to one target.

    Parameters
    ----------
    target, target_speed : float
        [m], [m/s].
    kind : str
        ``speed limit``, ``stop``, ``train ahead``.
    passed : ndarray (limit)
        How far before the target each limit was passed first, nan if it was not, [m].
    margin : ndarray (limit)
        The least way left to each limit, negative beyond it, [m].
    """

    target: float
    target_speed: float
    kind: str
    passed: Array
    margin: Array


class Watched(NamedTuple):
    """What the supervision says of a run.

    Parameters
    ----------
    log : list of Said
        Changes of the status.
    approaches : list of Approach
        Targets whose indication was passed.
    position : ndarray (place)
        [m].
    limits : ndarray (limit, place)
        Speeds of the limits along the run, in the order of `LIMITS`, nan for none, [m/s].
    """

    log: list[Said]
    approaches: list[Approach]
    position: Array
    limits: Array


class _Track(NamedTuple):
    """A stretch of a run on which the same was known."""

    time: Array
    place: Array
    speed: Array
    way: SupervisedWay
    leg: Leg


def watched(
    journey: Journey, time: Array, position: Array, speed: Array, told: Sequence[tuple[int, Leg]]
) -> Watched:
    """Return what the supervision of a journey says of a run.

    Parameters
    ----------
    journey : Journey
        With a table ``supervision``.
    time, position, speed : ndarray (moment)
        Of the run, [s], [m], [m/s].
    told : list of (int, Leg)
        First moment and leg of each stretch on which the same was known.

    Raises
    ------
    RailgripError
        ``supervision: is missing``

    Notes
    -----
    Between two moments the speed is taken for straight over time; changes are located there.

    Checked by tests/reference/etcs_era_tool.

    Examples
    --------
    >>> from railgrip.engine.journey.drive import drive
    >>> brake = [{"value": 0.6}]
    >>> train = {"length": 100.0, "emergency": brake, "service": brake, "emergency_time": 2.0,
    ...          "service_time": 3.0}
    >>> run = drive(Journey(train="local", line="const", supervision={"train": train}))
    >>> names = ("time", "position", "speed")
    >>> found = watched(run.journey, *(run.trace[name] for name in names), run.told)
    >>> [(one.status, round(one.position)) for one in found.log]
    [('normal', 0), ('indication', 9165), ('normal', 9967)]
    >>> found.approaches[0].margin.round()
    array([-38.,  24.,  38.,  47.,  47.])
    """
    onboard = Onboard(journey)
    firsts = [first for first, _ in told] + [time.size]
    tracks = [
        _Track(time[a:b], position[a:b], speed[a:b],
               onboard.way(leg.authority, leg.end, leg.is_stop), leg)
        for (a, leg), b in zip(told, firsts[1:], strict=True) if b > a
    ]  # fmt: skip
    log = list[Said]()
    for track in tracks:
        log.extend(_changes(track))
    found: dict[tuple[str, float], Approach] = {}
    for track in tracks:
        for table in track.way.tables:
            _approach(track, table, found)
    places = [np.append(np.arange(one.place[0], one.place[-1], PLACES), one.place[-1])
              for one in tracks]  # fmt: skip
    limits = [one.way.speeds(at) for one, at in zip(tracks, places, strict=True)]
    curves = np.concatenate(limits, axis=1)
    return Watched(
        [b for a, b in pairwise([None, *log]) if b and (a is None or a.status != b.status)],
        list(found.values()),
        np.concatenate(places),
        np.where(np.isfinite(curves), curves, np.nan),
    )


def _changes(track: _Track) -> list[Said]:
    """Return the status at the beginning, and wherever it changes."""
    above = excess(track.way, track.place, track.speed) > OVER
    found = [_said(track, track.time[0], track.place[0], track.speed[0])]
    for k in np.flatnonzero((above[:, 1:] != above[:, :-1]).any(axis=0)).tolist():
        moments = []
        for limit in np.flatnonzero(above[:, k] != above[:, k + 1]).tolist():

            def over(seconds: float, k: int = k, limit: int = limit) -> float:
                _, place, speed = _between(track, k, seconds)
                return float(excess(track.way, place, speed)[limit, 0]) - OVER

            moments.append(_root(over, float(track.time[k + 1] - track.time[k])))
        found += [_said(track, *_between(track, k, one)) for one in sorted(moments)]
        found.append(_said(track, track.time[k + 1], track.place[k + 1], track.speed[k + 1]))
    return found


def _said(track: _Track, time: float, place: float, speed: float) -> Said:
    # at a change that has just been located, a hair beyond it counts
    over = excess(track.way, place, speed)[:, 0] > OVER - 1e-7
    number = int(np.max(np.flatnonzero(over), initial=-1)) + 1
    decides = track.way.deciding(place, number - 1) if number else None
    at = np.nan if decides is None else decides.target.position
    return Said(float(time), float(place), float(speed), STATUS[number], at)


def _approach(track: _Track, table: LimitTable, found: dict[tuple[str, float], Approach]) -> None:
    """Note how a stretch of the run came to a target."""
    target = table.target
    kind = "speed limit"
    if target.is_end_of_authority:
        kind = "train ahead" if track.leg.authority <= target.position else "stop"
    ahead = (track.place < target.position) & (track.speed > table.speed[0])
    if not ahead.any():
        return
    left = target.position - track.place
    margins = np.where(ahead, left - table.distance_at(track.speed), np.inf)
    least = margins.min(axis=1)
    if least[0] >= 0.0:
        return
    passed = np.full(len(LIMITS), np.nan)
    for limit in np.flatnonzero(least < 0.0).tolist():
        k = int(np.argmax(margins[limit] < 0.0))
        passed[limit] = left[k]
        if k > 0 and np.isfinite(margins[limit, k - 1]):

            def rest(seconds: float, k: int = k, limit: int = limit) -> float:
                _, place, speed = _between(track, k - 1, seconds)
                before: float = table.distance_at(speed)[limit, 0]
                return target.position - place - before

            span = float(track.time[k] - track.time[k - 1])
            passed[limit] = target.position - _between(track, k - 1, _root(rest, span))[1]
    key = (kind, np.inf if kind == "train ahead" else target.position)
    if key in found:
        before = found[key]
        passed = np.where(np.isnan(before.passed), passed, before.passed)
        least = np.minimum(before.margin, least)
    found[key] = Approach(target.position, target.speed, kind, passed, least)


def _between(track: _Track, k: int, seconds: float) -> tuple[float, float, float]:
    """Return time, place and speed some seconds after a moment of the run."""
    span = max(float(track.time[k + 1] - track.time[k]), 1e-12)
    share = seconds / span
    speed = float(track.speed[k] + (track.speed[k + 1] - track.speed[k]) * share)
    way = 0.5 * (float(track.speed[k]) + speed) * seconds
    whole = 0.5 * float(track.speed[k] + track.speed[k + 1]) * span
    # the run's own way between the moments, to which the mean speed comes within its curvature
    stretch = float(track.place[k + 1] - track.place[k]) / whole if whole > 0.0 else 1.0
    return float(track.time[k]) + seconds, float(track.place[k]) + stretch * way, speed


def _root(function: object, span: float) -> float:
    assert callable(function)
    low, high = function(0.0), function(span)
    if (low > 0.0) == (high > 0.0):
        return span
    return float(brentq(function, 0.0, span, xtol=1e-9))
