"""The exact solution of rolling contact on a Hertzian patch (Kalker's half-space theory)."""

from __future__ import annotations

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
from railgrip.laboratory.half_space_patch import MARGIN, half_space_patch

__all__ = ["ExactSolution", "exact_law", "refine_exact", "solve_exact"]

_TOLERANCE = 1e-7


def solve_exact(
    contact: RollingContact,
    rail: RailFriction,
    speed: float,
    creepage: Creepage,
    *,
    grid: tuple[int, int] = (48, 48),
    memory: FrictionMemory | None = None,
    tolerance: float = _TOLERANCE,
) -> ExactSolution:
    """Steady rolling on a Hertzian patch after Kalker's complete theory.

    Choose it to judge the fast laws, to fill a table, or to see stick and slip; a case takes some
    twenty milliseconds, so it does not belong in a time step.

    Parameters
    ----------
    contact : RollingContact
        Load, semi-axes, material; Kalker's coefficients are not used.
    rail : RailFriction
        Friction; only `static_friction`, `friction_ratio` and `friction_decay` are used. With a
        ratio of 1 or no decay it is Coulomb's.
    speed : float
        Speed of the train; only matters, and must be > 0, where friction falls [m/s].
    creepage : Creepage
        Longitudinal, lateral, spin; of any size [-, -, 1/m].
    grid : (int, int)
        Cells along and across, 8 … 512; two on each side lie beyond the ellipse, so the cells are
        2a/(n − 4) long [-].
    memory : FrictionMemory, optional
        How falling friction follows the slip.
    tolerance : float
        Greatest residual of the equations over the size of the traction [-].

    Returns
    -------
    ExactSolution
        Forces and fields; look at `is_converged`.

    Raises
    ------
    RailgripError
        One line for each quantity that is out of its range.

    Notes
    -----
    Both bodies are elastic half-spaces of the same material. What is in a cell at x was at x + dx
    one step ago, so in steady rolling the wheel slips in it, over one step, by

        S = dx (s_x − φ y, s_y + φ x') − u(x) + u(x + dx),  u = Σ (influence × traction),

    with uniform traction in each cell. In the stick zone S = 0 and |p| ≤ μ p_n; in the slip zone
    |p| = μ p_n along S. The difference over one cell makes the result of first order in the size
    of the cells: on the base case it is too large by 1.3 % at 48 × 48 for small creepage, by half
    of that at twice the cells; `refine_exact` extrapolates. The spin moment of long patches suffers
    most (C33 at 48 × 48 is too large by 6 % on the base case, by 40 % at a/b = 5). The spin is
    taken at x' = x + dx/6, as CONTACT does, with which results on equal grids agree.
    Known wrong for conformal contact (flange root), for patches that are no ellipse, for unlike
    materials, and where the third body is not thin.

    References
    ----------
    .. [1] J. J. Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, Kluwer 1990, ch. 4,
       doi:10.1007/978-94-015-7889-9.
    .. [2] E. A. H. Vollebregt, User guide for CONTACT, Vtech CMCC (the discretisation).

    Checked by tests/reference/exact_longitudinal (CONTACT on equal grids, 1e-6 of the value) and
    tests/reference/exact_kalker (initial slopes).

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> constant = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> solution = solve_exact(base, constant, 20.0, Creepage(0.001, 0.0, 0.0))
    >>> round(solution.force.longitudinal, 1), solution.is_converged
    (12644.6, True)
    """
    refuse_bad_input(contact, rail, speed, creepage, grid)
    memory = memory or FrictionMemory()
    refuse_bad_memory(memory)
    patch = half_space_patch(contact.a, contact.b, contact.poisson, *grid)
    problem = TangentialProblem(
        patch.steady,
        patch.self_steady,
        patch.smoothing,
        patch.is_inside,
        free_slip(patch, contact, creepage),
        is_steady=True,
    )
    case = friction_case(patch, contact, rail, memory, speed, None)
    start = np.zeros_like(problem.free_slip)
    answer, friction, rounds = solve_with_friction(problem, case, start, tolerance)
    return solution_of(patch, contact, answer, friction, rounds)


def exact_law(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """`solve_exact` on 48 × 48 cells as a law of rolling contact, for curves and tables.

    Raises
    ------
    RailgripError
        From `solve_exact`; and "the exact solver did not converge".

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> constant = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> round(exact_law(base, constant, 20.0, Creepage(0.0, 0.002, 0.0)).lateral)
    19985
    """
    return _certain(solve_exact(contact, rail, speed, creepage))


def refine_exact(
    contact: RollingContact,
    rail: RailFriction,
    speed: float,
    creepage: Creepage,
    *,
    grid: tuple[int, int] = (48, 48),
    memory: FrictionMemory | None = None,
) -> tuple[CreepForce, CreepForce]:
    """Forces extrapolated to cells of no size, and how far the finer of two grids is off.

    Choose it where the force itself is wanted rather than that of a certain grid. It solves on
    the grid and on one with cells half as large, and follows the first-order error to zero.

    Parameters
    ----------
    contact, rail, speed, creepage, grid, memory
        As in `solve_exact`.

    Returns
    -------
    force, error : CreepForce
        Extrapolated forces, and their distance from those of the finer grid; what remains wrong
        with the former is some five times less, for the rim of the patch goes in steps.

    Raises
    ------
    RailgripError
        As `exact_law`.

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> constant = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> force, error = refine_exact(base, constant, 20.0, Creepage(0.001, 0.0, 0.0))
    >>> round(force.longitudinal), round(error.longitudinal)
    (12465, -90)
    """
    refuse_bad_input(contact, rail, speed, creepage, grid)
    fine_grid = (2 * (grid[0] - MARGIN), 2 * (grid[1] - MARGIN))
    coarse, fine = (
        _certain(solve_exact(contact, rail, speed, creepage, grid=each, memory=memory))
        for each in (grid, fine_grid)
    )
    error = CreepForce(*(near - far for near, far in zip(fine, coarse, strict=True)))
    return CreepForce(*(near + off for near, off in zip(fine, error, strict=True))), error


def _certain(solution: ExactSolution) -> CreepForce:
    if not solution.is_converged:
        raise RailgripError(
            Problem(
                "creepage",
                "the exact solver did not converge",
                got=f"residual {solution.residual:.1e} after {solution.newton_steps} steps, "
                f"friction renewed {solution.friction_rounds} times",
                cure="another grid, or a longer friction memory",
            )
        )
    return solution.force
