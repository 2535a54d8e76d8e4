"""One step of a journey: below the ceiling of permitted speed, or along it."""

from __future__ import annotations

from typing import Any

from railgrip.engine.journey.forces import (
    HOLD,
    efficiency,
    effort_at,
    piece_at,
    resistance,
    speed_of,
)

HALVINGS = 45
ON = 1e-9
"""A square of speed counts as at the ceiling within so much of itself."""
SAME = 1e-12
"""Accelerations that differ by less are the same, m/s²."""

MOVED, FAST, HALFWAY, MIDDLE, PULL_MIDDLE, PULL_END = range(4, 10)
"""Places in the scratch of a free step; below them forces: traction, brake, motors, friction."""
SCRATCH = 10


def forces(
    train: Any, slope: float, drag: float, speed: float, piece: int,
    share: float, retard: float, out: Any,
) -> float:  # fmt: skip
    """Fill traction and brake force of the free motion; return the acceleration, m/s²."""
    resists = resistance(train, slope, drag, speed)
    gain = train.dynamic_mass * train.max_acceleration if share != HOLD else 0.0
    wanted = max(gain + resists, 0.0)
    out[0] = min(abs(share) * effort_at(train.effort, piece, speed), wanted)
    out[1] = train.dynamic_mass * retard
    acceleration: float = (out[0] - out[1] - resists) / train.dynamic_mass
    return acceleration


def book(
    train: Any, speed: float, traction: float, brake: float, slope: float, drag: float,
    seconds: float, totals: Any, out: Any,
) -> None:  # fmt: skip
    """Add what the forces do in some seconds at a speed; leave motors' and friction brake."""
    motor = min(brake, effort_at(train.brake, piece_at(train.brake, speed), speed))
    work = speed * seconds
    out[2], out[3] = motor, brake - motor
    totals[0] += traction * work
    totals[1] += motor * work
    totals[2] += (brake - motor) * work
    resists = resistance(train, 0.0, drag, speed)
    totals[3] += resists * work
    totals[4] += train.weight * slope * work
    full = effort_at(train.effort, piece_at(train.effort, speed), speed)
    share = traction / full if full > 0.0 else 0.0
    totals[5] += traction * work / efficiency(train, speed, share, train.traction_efficiency)
    full = effort_at(train.brake, piece_at(train.brake, speed), speed)
    share = motor / full if full > 0.0 else 0.0
    totals[6] += motor * work * efficiency(train, speed, share, train.brake_efficiency)


def advance(
    train: Any, slope: float, change: float, drag: float, speed: float, piece: int,
    share: float, retard: float, seconds: float, out: Any,
) -> None:  # fmt: skip
    """Fill ``out`` with where some seconds of free motion lead (Runge–Kutta, order 4)."""
    half = 0.5 * seconds
    a1 = forces(train, slope, drag, speed, piece, share, retard, out)
    v2 = speed + half * a1
    a2 = forces(train, slope + change * half * speed, drag, v2, piece, share, retard, out)
    v3 = speed + half * a2
    a3 = forces(train, slope + change * half * v2, drag, v3, piece, share, retard, out)
    out[6], out[7], out[8] = half * v2, v3, out[0]
    v4 = speed + seconds * a3
    a4 = forces(train, slope + change * seconds * v3, drag, v4, piece, share, retard, out)
    out[4] = seconds * (speed + 2.0 * v2 + 2.0 * v3 + v4) / 6.0
    out[5] = speed + seconds * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0
    forces(train, slope + change * out[4], drag, out[5], piece, share, retard, out)
    out[9] = out[0]


def free_step(
    train: Any, place: float, speed: float, slope: float, change: float, drag: float,
    stop_at: float, lid: float, fall: float, share: float, retard: float,
    law: Any, parameters: Any, state: Any, ahead: Any,
    longest: float, locate: bool, totals: Any, out: Any,
) -> float:  # fmt: skip
    """Move below the ceiling up to the first change; return the seconds it took.

    ``lid`` is the square of the permitted speed here, ``fall`` its slope.
    """
    piece = piece_at(train.effort, speed)
    start = forces(train, slope, drag, speed, piece, share, retard, out)
    pull, brake = out[0], out[1]
    full = effort_at(train.effort, piece, speed)
    is_limited = pull < abs(share) * full
    low, high, seconds = 0.0, longest, longest
    if locate:
        for halving in range(HALVINGS):
            advance(train, slope, change, drag, speed, piece, share, retard, seconds, out)
            moved, fast = out[4], out[5]
            law(place + moved, fast, parameters, state, ahead)
            now_limited = out[9] < abs(share) * effort_at(train.effort, piece, fast)
            same = (
                place + moved <= stop_at
                and fast > 0.0
                and fast * fast <= (lid + fall * moved) * (1.0 + ON)
                and ahead[0] == share
                and ahead[1] == retard
                and piece_at(train.effort, fast) == piece
                and now_limited == is_limited
            )
            if same:
                low = seconds
                if halving == 0:
                    break
            else:
                high = seconds
            if high - low < 1e-13:
                break
            seconds = 0.5 * (low + high)
    advance(train, slope, change, drag, speed, piece, share, retard, high, out)
    sixth = high / 6.0
    pull_middle, middle, halfway, pull_end = out[8], out[7], out[6], out[9]
    book(train, speed, pull, brake, slope, drag, sixth, totals, out)
    book(
        train, middle, pull_middle, brake, slope + change * halfway, drag, 4.0 * sixth, totals, out
    )
    if out[5] > 0.0:
        tilt = slope + change * out[4]
        book(train, out[5], pull_end, brake, tilt, drag, sixth, totals, out)
    # a train that stands and is not moved
    return -1.0 if speed <= 1e-9 and start <= 1e-9 else high


def bound_step(
    train: Any, place: float, top: float, along: float, slope: float, change: float, drag: float,
    stop_at: float, share: float, retard: float,
    law: Any, parameters: Any, state: Any, ahead: Any, longest: float, totals: Any, out: Any,
) -> float:  # fmt: skip
    """Move along the ceiling up to the first change; return the way, m.

    ``top`` is the square of the speed here, ``along`` the acceleration of the ceiling.
    """
    speed = speed_of(top)
    far = stop_at - place
    if along < 0.0:
        slower = max(speed - longest, 0.0)
        far = min(far, (top - slower * slower) / (-2.0 * along))
    else:
        far = min(far, max(speed, 1.0) * 20.0 * longest)
    low, high, way = 0.0, far, far
    for halving in range(HALVINGS):
        fast = speed_of(top + 2.0 * along * way)
        law(place + way, fast, parameters, state, ahead)
        piece = piece_at(train.effort, fast)
        tilt = slope + change * way
        free = forces(train, tilt, drag, fast, piece, ahead[0], ahead[1], out)
        if free >= along - SAME and ahead[0] == share and ahead[1] == retard:
            low = way
            if halving == 0:
                break
        else:
            high = way
        if high - low < 1e-9:
            break
        way = 0.5 * (low + high)
    for k in range(3):  # Simpson over position
        part = 0.5 * k * high
        weight = (4.0 if k == 1 else 1.0) / 6.0 * high
        # the work of a force does not know the speed; a stand is approached at 1 mm/s
        fast = max(speed_of(top + 2.0 * along * part), 1e-3)
        tilt = slope + change * part
        force = train.dynamic_mass * along + resistance(train, tilt, drag, fast)
        book(train, fast, max(force, 0.0), max(-force, 0.0), tilt, drag, weight / fast, totals, out)
    return high
