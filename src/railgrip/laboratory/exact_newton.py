"""Traction in each cell so that it sticks, or slips against full friction: Newton and GMRES."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from railgrip.laboratory.half_space_grid import convolve, smooth
from railgrip.laboratory.krylov import gmres, length

_STEPS = 40
_WEIGHTS = (0.3, 0.1, 0.03)
_KRYLOV = 80


class TangentialProblem(NamedTuple):
    """What the cells must obey: slip = free_slip − kernel ∗ traction.

    Parameters
    ----------
    kernel, own : tuple, float
        Displacement by the tractions, and what a cell does to itself.
    smoothing : ndarray
        About the inverse of the displacement, for the preconditioner.
    is_inside : ndarray (across, along)
        Cells of the patch.
    free_slip : ndarray (2, across, along)
        Slip over one step if the tractions were zero [a].
    is_steady : bool
        Whether the kernel is that of steady rolling, which adds up along each row.
    """

    kernel: Any
    own: float
    smoothing: Any
    is_inside: Any
    free_slip: Any
    is_steady: bool


class TangentialAnswer(NamedTuple):
    """Tractions and slips of the cells, and how the iteration went.

    Parameters
    ----------
    traction, slip : ndarray (2, across, along)
        Traction of the rail on the wheel, and how far the wheel slips over one step.
    is_slipping : ndarray (across, along)
        Cells at their friction bound.
    steps : int
        Newton steps taken.
    residual : float
        What is left, over the size of the traction.
    is_converged : bool
        Whether the residual is below the tolerance.
    """

    traction: Any
    slip: Any
    is_slipping: Any
    steps: int
    residual: float
    is_converged: bool


def solve_tangential(
    problem: TangentialProblem, bound: Any, start: Any, tolerance: float
) -> TangentialAnswer:
    """Find the tractions under Coulomb's law with a given bound in each cell.

    Parameters
    ----------
    problem : TangentialProblem
        What the cells must obey.
    bound : ndarray (across, along)
        Friction coefficient times pressure, ≥ 0.
    start : ndarray (2, across, along)
        Tractions to begin with.
    tolerance : float
        Greatest residual over the size of the traction [-].

    Returns
    -------
    TangentialAnswer
        The best found; `is_converged` says whether it is the solution.

    Notes
    -----
    Stick (slip s = 0, |p| ≤ g) and slip (|p| = g along s) are one equation, p = Π(p + ρ s), with Π
    the projection onto the disc of radius g and any ρ > 0. Newton's method for it converges in
    some eight steps from nothing, for a ρ somewhat below what a cell's own stiffness suggests; if
    it does not, it begins again with a smaller ρ. The linear equations of a step are solved by
    GMRES. Its preconditioner treats the sticking cells as if the whole plane stuck (a periodic
    convolution), and sums along the rows from the leading edge, as the displacements of steady
    rolling do; some 20 iterations then suffice for any grid.

    References
    ----------
    .. [1] P. Alart, A. Curnier, A mixed formulation for frictional contact problems prone to Newton
       like solution methods, Comput. Methods Appl. Mech. Eng. 92 (1991) 353–375.
    .. [2] E. A. H. Vollebregt, A new solver for the elastic normal contact problem using conjugate
       gradients, deflation, and an FFT-based preconditioner, J. Comput. Phys. 257 (2014) 333–351.

    Checked by tests/laws/test_exact.py: every cell sticks or slips as it must.
    """
    answers: list[TangentialAnswer] = []
    for weight in _WEIGHTS:
        answers.append(_newton(problem, bound, start, tolerance, weight / problem.own))
        if answers[-1].is_converged:
            break
    best = min(answers, key=lambda answer: (not answer.is_converged, answer.residual))
    return best._replace(steps=sum(answer.steps for answer in answers))


def _newton(
    problem: TangentialProblem, bound: Any, start: Any, tolerance: float, weight: float
) -> TangentialAnswer:
    """Iterate with one ρ (`weight`) until the residual is small, or the steps are used up."""
    inside, traction = problem.is_inside, start
    for step in range(_STEPS + 1):
        slip = (problem.free_slip - convolve(problem.kernel, traction)) * inside
        wish = traction + weight * slip
        reach = np.hypot(wish[0], wish[1])
        slipping = inside & (reach > bound)
        reach = np.where(slipping, reach, 1.0)
        direction = wish / reach
        off = np.where(slipping, traction - bound * direction, -weight * slip)
        rest = length(off)
        residual = rest / max(length(traction), rest, 1e-300)
        if residual <= tolerance or step == _STEPS or not np.isfinite(residual):
            break
        share = np.where(slipping, bound / reach, 0.0)
        accuracy = min(1e-2, max(0.3 * tolerance / residual, 0.1 * residual))
        traction = traction - _step(problem, weight, slipping, direction, share, off, accuracy)
    return TangentialAnswer(traction, slip, slipping, step, residual, residual <= tolerance)


def _step(
    problem: TangentialProblem,
    weight: float,
    slipping: Any,
    direction: Any,
    share: Any,
    off: Any,
    accuracy: float,
) -> Any:
    """Solve the linearised equations for the change of traction."""
    sticking = problem.is_inside & ~slipping

    def product(change: Any) -> Any:
        slid = weight * convolve(problem.kernel, change)
        turned = share * (change - slid)
        turned -= direction * (turned * direction).sum(axis=0)
        return np.where(slipping, change - turned, slid * sticking)

    def precondition(wanted: Any) -> Any:
        load = smooth(problem.smoothing, wanted * sticking) * (sticking / weight)
        if problem.is_steady:
            load = _sum_from_leading_edge(load, sticking)
        return np.where(slipping, wanted, load)

    return gmres(product, precondition, off, accuracy, _KRYLOV)


def _sum_from_leading_edge(load: Any, sticking: Any) -> Any:
    """Add up along the rows against the direction of rolling, beginning anew behind each slip."""
    sums = np.cumsum(load[:, :, ::-1], axis=2)
    places = np.arange(sticking.shape[1])[None, :]
    last_slip = np.maximum.accumulate(np.where(sticking[:, ::-1], 0, places), axis=1)
    before = np.take_along_axis(sums, np.broadcast_to(last_slip, sums.shape), axis=2)
    return (sums - before)[:, :, ::-1] * sticking
