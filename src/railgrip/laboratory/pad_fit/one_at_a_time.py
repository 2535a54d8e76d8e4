"""Each function from the data near the reference of the other two, as the source's figure 1."""

from __future__ import annotations

import numpy as np
from scipy.linalg import block_diag

from railgrip.core.errors import Problem
from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.data import INFLUENCES, Blocks, packed
from railgrip.laboratory.pad_fit.fitting import Fit, fit_law, residuals_of
from railgrip.laboratory.pad_fit.identify import Identified, Plan, identified, together
from railgrip.laboratory.pad_fit.laws import Product
from railgrip.laboratory.pad_fit.shape import Placed, log_curve

LEAST_BLOCKS = 30


def one_at_a_time(blocks: Blocks, plan: Plan) -> Identified:
    """Find each function where the other two influences are near their reference.

    The level is then found with the functions held, from all data near the reference of any two
    influences; its interval leaves out that of the functions, which are 1 at the reference.
    """
    problems: list[Problem] = []
    parts: dict[str, tuple[Fit, Blocks]] = {}
    nearby = np.zeros_like(blocks.is_there)
    for name in plan.shapes:
        near = _near(blocks, [other for other in INFLUENCES if other != name], plan)
        kept = near.sum(axis=1) > 1
        if near.sum() < LEAST_BLOCKS or kept.sum() < 2:
            what = "its function cannot be found: too little lies near the reference of the others"
            cure = "method = 'together', or a greater nearness"
            problems.append(Problem(name, what, f"{near.sum()} blocks", f"{LEAST_BLOCKS}", cure))
            continue
        alone = Plan({name: plan.shapes[name]}, plan.reference, plan.lags)
        some = packed(blocks._replace(is_there=near).of(kept))
        found = together(some, alone)
        problems += found.problems
        if name in found.points:
            parts[name] = (found.fit, some)
            nearby |= near
    fit = _joined(parts, packed(blocks._replace(is_there=nearby).of(nearby.sum(axis=1) > 1))
                  if parts else blocks, plan)  # fmt: skip
    whole = fit._replace(residuals=residuals_of(fit.law, fit.theta, blocks))
    return identified(whole, blocks, plan, problems)


def _near(blocks: Blocks, others: list[str], plan: Plan) -> np.ndarray:
    near = blocks.is_there.copy()
    for name in others:
        values = blocks.values[INFLUENCES.index(name)]
        if np.isfinite(values).all():
            reach = plan.nearness * abs(plan.reference[name])
            near &= np.abs(values - plan.reference[name]) <= reach
    return near


def _joined(parts: dict[str, tuple[Fit, Blocks]], near: Blocks, plan: Plan) -> Fit:
    """Return one fit of all functions, its level found anew."""
    functions: dict[str, Placed] = {}
    inner: list[FloatArray] = []
    errors: list[FloatArray] = []
    naive: list[FloatArray] = []
    for name, (fit, _) in parts.items():
        assert isinstance(fit.law, Product)
        placed = fit.law.functions[name]
        functions[name] = placed
        n = placed.shape.parameters
        inner.append(fit.theta[1 : 1 + n])
        errors.append(fit.covariance[1 : 1 + n, 1 : 1 + n])
        naive.append(fit.naive[1 : 1 + n, 1 : 1 + n])
    law = Product(functions, plan.lags)
    late = [parts[name][0].theta[-1:] for name in law.fitted_lags]
    late_errors = [parts[name][0].covariance[-1:, -1:] for name in law.fitted_lags]
    late_naive = [parts[name][0].naive[-1:, -1:] for name in law.fitted_lags]
    theta = np.concatenate([[0.0], *inner, *late])
    held = _Held(law, theta, plan)
    level = fit_law(held, near, np.array([float(np.median(near.log_friction[near.is_there]))]))
    theta[0] = level.theta[0] - held.at_reference
    covariance = block_diag(level.covariance, *errors, *late_errors)
    return level._replace(
        law=law, theta=theta, covariance=_about_reference(covariance, held),
        naive=_about_reference(block_diag(level.naive, *naive, *late_naive), held),
    )  # fmt: skip


class _Held:
    """The functions as found, 1 at the reference; only the level is free."""

    names = ("level",)

    def __init__(self, law: Product, theta: FloatArray, plan: Plan) -> None:
        self.law, self.theta = law, theta
        numbers, _ = law.parts(theta)
        self.at_reference = 0.0
        self.slopes = np.zeros(len(theta))
        begin = 1
        for name, placed in law.functions.items():
            log_h, by_numbers, _ = log_curve(placed, numbers[name], np.array(plan.reference[name]))
            self.at_reference += float(log_h)
            self.slopes[begin : begin + placed.shape.parameters] = by_numbers
            begin += placed.shape.parameters

    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Least and greatest level."""
        return np.array([-7.0]), np.array([2.0])

    def log_friction(self, theta: FloatArray, blocks: Blocks) -> tuple[FloatArray, FloatArray]:
        """Logarithm of the friction, the level being that at the reference."""
        rest, _ = self.law.log_friction(self.theta, blocks)
        return theta[0] + rest - self.at_reference, np.ones((*blocks.time.shape, 1))


def _about_reference(covariance: FloatArray, held: _Held) -> FloatArray:
    """Carry the level's error from the reference to where the fitted law counts it from."""
    carry = np.eye(len(covariance))
    carry[0, :] = -held.slopes
    carry[0, 0] = 1.0
    return np.asarray(carry @ covariance @ carry.T)
