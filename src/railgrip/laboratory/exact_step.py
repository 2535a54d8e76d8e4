"""One case or one step of the exact solver: friction and tractions until they agree."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from railgrip.contact.rail_friction import RailFriction
from railgrip.laboratory.exact_checks import falls
from railgrip.laboratory.exact_friction import FrictionMemory, remembered_friction
from railgrip.laboratory.exact_newton import TangentialAnswer, TangentialProblem, solve_tangential

_PARTS = (0.6,) * 40 + (0.2,) * 80


class FrictionCase(NamedTuple):
    """What the friction of a case depends on, in the patch's normal size.

    Parameters
    ----------
    rail : RailFriction
        State of the rail.
    memory : FrictionMemory
        How fast friction follows the slip speed.
    pressure : ndarray (across, along)
        Pressure over π G [-].
    slip_to_speed : float
        Slip speed over the slip of one step [m/s].
    dt : float
        Time of one step [s].
    before : ndarray or None
        Friction coefficients one step ago; None in steady rolling.
    """

    rail: RailFriction
    memory: FrictionMemory
    pressure: Any
    slip_to_speed: float
    dt: float
    before: Any


def solve_with_friction(
    problem: TangentialProblem, case: FrictionCase, start: Any, tolerance: float
) -> tuple[TangentialAnswer, Any, int]:
    """Return the answer, the friction coefficients and how often friction was renewed.

    Friction that falls is renewed from the slip found with the friction before, part of the way
    each time and a smaller part where that goes round in circles, until it changes by less than
    the tolerance asks; constant friction needs no round.
    """
    friction = np.full(case.pressure.shape, case.rail.static_friction)
    if not falls(case.rail):
        return solve_tangential(problem, friction * case.pressure, start, tolerance), friction, 0
    steps, enough = [], max(tolerance, 1e-7) * case.rail.static_friction
    for part in _PARTS:
        answer = solve_tangential(problem, friction * case.pressure, start, tolerance)
        steps.append(answer.steps)
        start = answer.traction
        slip_speed = case.slip_to_speed * np.hypot(*answer.slip) * answer.is_slipping
        wanted = remembered_friction(case.rail, case.memory, slip_speed, case.dt, case.before)
        change = np.where(problem.is_inside, wanted - friction, 0.0)
        if np.abs(change).max() <= enough or not answer.is_converged:
            break
        friction = friction + part * change
    settled = bool(np.abs(change).max() <= enough)
    answer = answer._replace(steps=sum(steps), is_converged=answer.is_converged and settled)
    return answer, friction, len(steps)
