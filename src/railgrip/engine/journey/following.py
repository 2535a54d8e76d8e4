"""Drives a journey behind another train, whose record is the authority to move."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from railgrip.control.coasting.moving_authority import moving_authority
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.journey.coasting import coasting_of
from railgrip.engine.journey.drive import FLAT_OUT, DrivingLaw, JourneyRun, drive
from railgrip.engine.journey.intervening import marched
from railgrip.engine.journey.marching import Authority
from railgrip.scenario.explain import problems_of
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]


def leading(journey: Journey) -> JourneyRun:
    """Return the run of the leading train of a journey, as it is driven on the same line."""
    leader = journey.leader
    if leader is None:
        raise RailgripError(Problem("leader", "is missing", cure="a table [leader]"))
    try:
        ahead = Journey(
            train=leader.train, line=journey.line, stop=leader.stop or journey.stops(),
            passing_speed=leader.passing_speed, braking=leader.braking,
            gradient_under=journey.gradient_under, curve_resistance=journey.curve_resistance,
            coasting=leader.coasting, step=journey.step,
        )  # fmt: skip
        return drive(ahead) if leader.coasting is None else drive(ahead, coasting_of(ahead))
    except ValidationError as error:
        found = problems_of(error, Journey)
    except RailgripError as error:
        found = error.problems
    raise RailgripError([replace(one, where=f"leader.{one.where}".rstrip(".")) for one in found])


def authority_of(journey: Journey, ahead: JourneyRun | None = None) -> Authority:
    """Return the authority behind the leading train of a journey.

    Parameters
    ----------
    journey : Journey
        With a table ``leader``.
    ahead : JourneyRun, optional
        The leader's run, if it is known; absent: `leading`.

    Raises
    ------
    RailgripError
        ``leader.headway: the train would set off inside the leading train or its margin; got
        10 s; allowed: from 33.4 s``

    Notes
    -----
    The record is straight between the steps of the leader's run: at most a (1 s)²/8 before the
    train itself where it accelerates, well within any margin.
    """
    ahead = leading(journey) if ahead is None else ahead
    leader = journey.leader
    assert leader is not None
    moments, kept = np.unique(ahead.trace["time"], return_index=True)
    front = np.maximum.accumulate(ahead.trace["position"][kept])
    length = ahead.journey.train.length
    free = float(moments[-1]) + leader.clears_after
    needed = journey.stops()[0].at + length + leader.margin
    if front[-1] > needed:
        least = min(float(np.interp(needed, *_rising(front, moments))), free)
    else:
        least = free
    if leader.headway <= least and leader.headway < free:
        raise RailgripError(
            Problem(
                "leader.headway",
                "the train would set off inside the leading train or its margin",
                got=f"{leader.headway:g} s",
                allowed=f"above {least:.1f} s",
            )
        )
    record = moving_authority(
        moments - leader.headway, front, length=length, margin=leader.margin,
        period=leader.renewal,
    )  # fmt: skip
    return Authority(record, free - leader.headway)


def follow(
    journey: Journey, law: DrivingLaw = FLAT_OUT, authority: Authority | None = None
) -> JourneyRun:
    """Drive a journey behind another train, without slip.

    Parameters
    ----------
    journey : Journey
        As for `drive`; its table ``leader`` says what runs ahead.
    law : DrivingLaw
        What to demand below the permitted speed; full power if nothing else is said. It is told
        the end of authority as a target with speed 0, and keeps its state when that is renewed.
    authority : Authority, optional
        Instead of what the leader's run gives.

    Returns
    -------
    run : JourneyRun
        Running times are from the departure on, with what the train stands at ends of authority.

    Raises
    ------
    RailgripError
        What `drive` and `authority_of` find.

    Notes
    -----
    At each renewal the braking curves are drawn anew, to the end of authority or the next stop,
    whichever is nearer; the march between is that of `drive`, cut at the renewal's moment.

    Checked by tests/agreement/test_following.py against the exact run of the laboratory.

    Examples
    --------
    >>> slow = {"train": "freight", "headway": 300.0}
    >>> behind = Journey(train="longdistance", line="const", leader=slow)
    >>> run = follow(behind)
    >>> round(drive(behind).running_time), round(run.running_time), run.switchings
    (331, 561, 76)
    """
    authority = authority_of(journey) if authority is None else authority
    return marched(journey, law, authority)


def driven_run(
    journey: Journey, law: DrivingLaw = FLAT_OUT, authority: Authority | None = None
) -> JourneyRun:
    """Drive a journey behind its leading train, or alone if it has none."""
    if journey.leader is None and authority is None:
        return drive(journey, law)
    return follow(journey, law, authority)


def _rising(front: Array, moments: Array) -> tuple[Array, Array]:
    """Return positions that rise, each with the last moment at which the front was there."""
    last = np.append(np.diff(front) > 0.0, True)
    return front[last], moments[last]
