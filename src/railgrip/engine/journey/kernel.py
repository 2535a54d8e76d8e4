"""The march of one leg: free under the driving law, or bound to the ceiling of permitted speed.

Below the ceiling the motion is integrated in time (Runge–Kutta of order 4); at the ceiling the
square of the speed is linear in position, so that nothing is integrated but energy. Wherever
something changes within a step (a section ends, the ceiling is met, another piece of the effort
holds, the law demands otherwise), the step is halved until the change is found, so that results
do not depend on the step.
"""

from __future__ import annotations

from typing import Any

from numba import types as nbt

from railgrip.compiler import entry
from railgrip.engine.journey.forces import effort_at, piece_at, resistance, speed_of
from railgrip.engine.journey.steps import (
    ON,
    SAME,
    SCRATCH,
    bound_step,
    forces,
    free_step,
)

LAW = nbt.void(nbt.float64, nbt.float64, nbt.float64[::1], nbt.float64[::1], nbt.float64[::1])
"""Signature of a driving law: position, speed, parameters, state, demand."""

DRIVING, ARRIVED, STALLED, TOO_WEAK, TOO_LONG, TIME_IS_UP = 0, 1, 2, 3, 4, 5
"""How a leg ended."""
IN_TIME = 1e-7
"""So near its end, s, a march that is limited in time has come to it."""

TIME, POSITION, SPEED, TRACTION, MOTOR_BRAKE, FRICTION, CEILING = range(7)
"""Columns of the trace."""
COLUMNS = 7

(
    W_TRACTION, W_MOTOR_BRAKE, W_FRICTION, W_RESISTANCE, W_GRADE, DC_TRACTION, DC_BRAKE, SWITCHINGS,
) = range(8)  # fmt: skip
"""Totals of a leg: work at the wheel and energy at the DC link in J, switchings of traction."""
TOTALS = 8


def _march(
    train: Any, sections: Any, slopes: Any, changes: Any, drags: Any,
    bounds: Any, squares: Any, falls: Any, law: Any, parameters: Any, state: Any,
    start_speed: float, longest: float, until: float, trace: Any, totals: Any, work: Any, end: Any,
) -> int:  # fmt: skip
    """Drive one leg, or as much of it as the seconds ``until`` allow; return how it ended.

    ``work`` is scratch of `SCRATCH` + 2 × (2 + size of the state); ``end`` receives the rows of
    the trace, time, position and speed.
    """
    n_state = state.shape[0]
    out, demand = work[:SCRATCH], work[SCRATCH : SCRATCH + 2 + n_state]
    ahead = work[SCRATCH + 2 + n_state :]
    place, speed, clock = bounds[0], start_speed, 0.0
    last = bounds.shape[0] - 2
    i, j, rows, was_pulling, idle = 0, 0, 0, False, 0
    while True:
        if clock >= until - IN_TIME:
            end[0], end[1], end[2], end[3] = rows, clock, place, speed
            return 5
        left = until - clock
        while j < last and bounds[j + 1] <= place:
            j += 1
        while i < drags.shape[0] - 1 and sections[i + 1] <= place:
            i += 1
        top = max(squares[j] + falls[j] * (place - bounds[j]), 0.0)
        slope, drag, along = (
            slopes[i] + changes[i] * (place - sections[i]),
            drags[i],
            0.5 * falls[j],
        )
        at_top = speed * speed >= top * (1.0 - ON) - 1e-12
        if at_top:
            speed = speed_of(top)
        law(place, speed, parameters, state, demand)
        share, retard = demand[0], demand[1]
        piece = piece_at(train.effort, speed)
        free = forces(train, slope, drag, speed, piece, share, retard, out)
        bound = at_top and free >= along - SAME
        traction, brake = out[0], out[1]
        if bound:
            needed = train.dynamic_mass * along + resistance(train, slope, drag, speed)
            traction, brake = max(needed, 0.0), max(-needed, 0.0)
        if (traction > 0.0) != was_pulling:
            totals[7] += 1.0
            was_pulling = not was_pulling
        motor = min(brake, effort_at(train.brake, piece_at(train.brake, speed), speed))
        end[0], end[1], end[2], end[3] = rows, clock, place, speed
        if rows == trace.shape[0]:
            return 4
        trace[rows, 0], trace[rows, 1], trace[rows, 2] = clock, place, speed
        trace[rows, 3], trace[rows, 4], trace[rows, 5] = traction, motor, brake - motor
        trace[rows, 6] = speed_of(top)
        rows += 1
        end[0] = rows
        if place >= bounds[last + 1] - 1e-7:
            return 1
        if brake - motor > train.friction_brake * (1.0 + 1e-9):
            return 3
        stop_at = min(sections[i + 1], bounds[j + 1])
        if bound:
            stop_at = min(stop_at, place + max(speed + 0.5 * along * left, 0.5 * speed) * left)
            way = bound_step(
                train, place, top, along, slope, changes[i], drag, stop_at, share, retard,
                law, parameters, state, ahead, longest, totals, out,
            )  # fmt: skip
            fast = speed_of(top + 2.0 * along * way)
            clock += 2.0 * way / (speed + fast) if speed + fast > 0.0 else 0.0
            place += way
            speed = fast
            idle = idle + 1 if way < 1e-7 else 0
        else:
            locate = idle < 4
            seconds = free_step(
                train, place, speed, slope, changes[i], drag, stop_at, top, falls[j],
                share, retard, law, parameters, state, ahead,
                min(longest if locate else 0.1 * longest, left), locate, totals, out,
            )  # fmt: skip
            if seconds < 0.0 or out[5] <= 0.0:
                return 2
            idle = idle + 1 if seconds < 1e-7 else 0
            clock += seconds
            place += out[4]
            speed = out[5]
            lid = squares[j] + falls[j] * (place - bounds[j])
            if place <= bounds[j + 1] and speed * speed > lid:
                speed = speed_of(lid)
        law(place, speed, parameters, state, demand)
        for k in range(n_state):
            state[k] = demand[2 + k]


march = entry(_march)
