"""The exact solution of rolling contact on a Hertzian patch (Kalker's half-space theory)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.exact_checks import falls, refuse_bad_input
from railgrip.laboratory.exact_friction import FrictionMemory, refuse_bad_memory
from railgrip.laboratory.exact_newton import TangentialProblem
from railgrip.laboratory.exact_step import FrictionCase, solve_with_friction
from railgrip.laboratory.half_space_patch import MARGIN, HalfSpacePatch, half_space_patch

SPIN_SHIFT = 1.0 / 6.0
"""How many cells ahead of its centre the spin of a cell is taken; as CONTACT does."""
_TOLERANCE = 1e-7


@dataclass(frozen=True, eq=False)
class ExactSolution:
    """Forces, and what happens in each cell of the patch.

    Parameters
    ----------
    force : CreepForce
        What the rail does to the wheel [N, N, N m].
    is_converged : bool
        Whether the equations hold to the tolerance; if not, nothing here may be relied on.
    residual : float
        What is left of them, over the size of the traction [-].
    newton_steps, friction_rounds : int
        Newton steps in all, and how often a falling friction was renewed.
    x, y : ndarray (along), (across)
        Centres of the cells, rolling towards +x [m].
    cell_area : float
        Area of a cell [m²].
    is_inside, is_slipping : ndarray (across, along)
        Cells in contact; those of them that slip.
    pressure : ndarray (across, along)
        Normal pressure [Pa].
    traction_x, traction_y : ndarray (across, along)
        Tangential stress on the wheel, with the sign of `force` [Pa].
    slip_x, slip_y : ndarray (across, along)
        Slip of the wheel's surface on the rail over the speed, with the sign of the creepage [-].
    friction : ndarray (across, along)
        Friction coefficient [-].
    """

    force: CreepForce
    is_converged: bool
    residual: float
    newton_steps: int
    friction_rounds: int
    x: Any
    y: Any
    cell_area: float
    is_inside: Any
    is_slipping: Any
    pressure: Any
    traction_x: Any
    traction_y: Any
    slip_x: Any
    slip_y: Any
    friction: Any

    @property
    def is_sticking(self) -> Any:
        """Cells in contact that do not slip."""
        return self.is_inside & ~self.is_slipping


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


def free_slip(patch: HalfSpacePatch, contact: RollingContact, creepage: Creepage) -> Any:
    """Slip of rigid bodies in each cell over one step [a], (2, across, along)."""
    spin = creepage.spin * contact.a
    ahead = patch.x + SPIN_SHIFT * patch.dx
    slip = np.empty((2, patch.y.size, patch.x.size))
    slip[0] = creepage.longitudinal - spin * patch.y[:, None]
    slip[1] = creepage.lateral + spin * ahead[None, :]
    return slip * patch.dx * patch.is_inside


def friction_case(
    patch: HalfSpacePatch,
    contact: RollingContact,
    rail: RailFriction,
    memory: FrictionMemory,
    speed: float,
    before: Any,
) -> FrictionCase:
    """Friction of this contact in the patch's normal size."""
    dt = patch.dx * contact.a / speed if falls(rail) else 0.0
    to_speed = speed / patch.dx if falls(rail) else 0.0
    pressure = patch.pressure * strain(contact)
    return FrictionCase(rail, memory, pressure, to_speed, dt, before)


def solution_of(
    patch: HalfSpacePatch, contact: RollingContact, answer: Any, friction: Any, rounds: int
) -> ExactSolution:
    """Put the answer into SI units and add it up."""
    a, area = contact.a, patch.dx * patch.dy * contact.a**2
    x, y = a * patch.x, a * patch.y
    along, across = answer.traction * (math.pi * contact.shear_modulus)
    slip = answer.slip / patch.dx
    moment = float((across @ x).sum() - (y @ along).sum())
    return ExactSolution(
        force=CreepForce(float(along.sum()) * area, float(across.sum()) * area, moment * area),
        is_converged=answer.is_converged,
        residual=answer.residual,
        newton_steps=answer.steps,
        friction_rounds=rounds,
        x=x,
        y=y,
        cell_area=area,
        is_inside=patch.is_inside,
        is_slipping=answer.is_slipping,
        pressure=patch.pressure * (contact.load / a**2),
        traction_x=along,
        traction_y=across,
        slip_x=slip[0],
        slip_y=slip[1],
        friction=friction,
    )


def strain(contact: RollingContact) -> float:
    """Load over π G a²: turns the patch's pressure into tractions over π G."""
    return contact.load / (math.pi * contact.shear_modulus * contact.a**2)


def _certain(solution: ExactSolution) -> CreepForce:
    if not solution.is_converged:
        raise RailgripError(
            Problem(
                "creepage",
                "the exact solver did not converge",
                got=f"residual {solution.residual:.1e} after {solution.newton_steps} steps",
                cure="another grid, or a longer friction memory",
            )
        )
    return solution.force
