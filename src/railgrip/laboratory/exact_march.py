"""How the forces of rolling contact build up, cell by cell of rolled distance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.exact_checks import refuse_bad_input
from railgrip.laboratory.exact_friction import FrictionMemory, refuse_bad_memory
from railgrip.laboratory.exact_newton import TangentialProblem
from railgrip.laboratory.exact_solution import (
    ExactSolution,
    free_slip,
    friction_case,
    solution_of,
)
from railgrip.laboratory.exact_step import solve_with_friction
from railgrip.laboratory.half_space_grid import convolve
from railgrip.laboratory.half_space_patch import MARGIN, half_space_patch

_TOLERANCE = 1e-7


@dataclass(frozen=True, eq=False)
class ExactMarch:
    """Forces over the rolled distance, and the patch at the end of it.

    Parameters
    ----------
    distance : ndarray (step)
        Distance rolled since the start, after each step [m].
    forces : list of CreepForce (step)
        What the rail does to the wheel [N, N, N m].
    is_converged : ndarray of bool (step)
        Whether the equations of the step hold to the tolerance.
    last : ExactSolution
        The patch after the last step; give it to the next `march_exact` as its start.
    """

    distance: Any
    forces: list[CreepForce]
    is_converged: Any
    last: ExactSolution


def march_exact(
    contact: RollingContact,
    rail: RailFriction,
    speed: float,
    creepages: Sequence[Creepage],
    *,
    start: ExactSolution | None = None,
    grid: tuple[int, int] = (48, 48),
    memory: FrictionMemory | None = None,
    tolerance: float = _TOLERANCE,
) -> ExactMarch:
    """Roll on step by step, one cell each, from a given traction.

    Choose it for contacts whose creepage changes within some patch lengths of rolling, or to see
    how the steady state comes about. Load and patch stay as they are.

    Parameters
    ----------
    contact, rail, speed, grid, memory, tolerance
        As in `solve_exact`.
    creepages : sequence of Creepage
        One for each step; a step rolls 2a/(grid[0] − 4).
    start : ExactSolution, optional
        What the patch was like before, on the same contact and grid, from `solve_exact` or an
        earlier march; without it, pressed together without traction.

    Returns
    -------
    ExactMarch
        Forces after each step; look at `is_converged`.

    Raises
    ------
    RailgripError
        As `solve_exact`; for no creepage at all; and for a start on another grid.

    Notes
    -----
    As `solve_exact`, but the displacement one step ago is that of the tractions one step ago:
    S = dx w − u(x) + u_before(x + dx). Under constant creepage the forces go to those of
    `solve_exact` on the same grid, the last per cent slowly. The relaxation law 1 − e^(−d/σ) with
    σ = 8a/(3π) = 0.85 a is faster: on the base case 63 % of the steady force are reached after
    1.42 a for small creepage (the law leads by up to 0.21 of the steady force), after 1.21 a at
    0.1 % (0.15). For σ supposes twice the stiffness at rest that the half-space has (Mindlin's,
    4 G a/(2 − ν) on a circle); where the patch slips, the way is shorter again.

    Checked by tests/laws/test_exact_march.py.

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> constant = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> creepages = [Creepage(0.001, 0.0, 0.0)] * 40
    >>> march = march_exact(base, constant, 20.0, creepages, grid=(24, 24))
    >>> [round(march.forces[step].longitudinal) for step in (0, 9, 39)]
    [843, 7012, 12529]
    """
    if not creepages:
        raise RailgripError(Problem("creepages", "give at least one, one for each step"))
    for creepage in creepages:
        refuse_bad_input(contact, rail, speed, creepage, grid)
    memory = memory or FrictionMemory()
    refuse_bad_memory(memory)
    patch = half_space_patch(contact.a, contact.b, contact.poisson, *grid)
    traction, friction = _start(start, rail, patch.is_inside)
    traction = traction / (math.pi * contact.shear_modulus)
    forces, converged = [], []
    for creepage in creepages:
        fixed = free_slip(patch, contact, creepage) + convolve(patch.before, traction)
        problem = TangentialProblem(
            patch.now, patch.self_now, patch.smoothing, patch.is_inside, fixed, is_steady=False
        )
        case = friction_case(patch, contact, rail, memory, speed, friction)
        answer, friction, rounds = solve_with_friction(problem, case, traction, tolerance)
        traction = answer.traction
        last = solution_of(patch, contact, answer, friction, rounds)
        forces.append(last.force)
        converged.append(last.is_converged)
    cell = 2.0 * contact.a / (grid[0] - 2 * MARGIN)
    return ExactMarch(cell * np.arange(1, len(forces) + 1), forces, np.array(converged), last)


def _start(start: ExactSolution | None, rail: RailFriction, inside: Any) -> tuple[Any, Any]:
    """Return the tractions [Pa] and friction coefficients before the first step."""
    if start is None:
        return np.zeros((2, *inside.shape)), np.full(inside.shape, rail.static_friction)
    if start.is_inside.shape != inside.shape:
        rows, columns = start.is_inside.shape
        raise RailgripError(
            Problem("start", "is on another grid", got=f"({columns}, {rows})", allowed="grid")
        )
    return np.stack([start.traction_x, start.traction_y]), start.friction
