"""Measured stops → the functions of a pad, as many as the stops can tell."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.additive import (
    additive_fit,
    chance_of_no_effect,
    first_guess,
    range_of,
)
from railgrip.laboratory.pad_fit.data import INFLUENCES, UNITS, Blocks, PadStops, blocks_of
from railgrip.laboratory.pad_fit.design import identifiable, levels_of
from railgrip.laboratory.pad_fit.fitting import Fit, fit_law
from railgrip.laboratory.pad_fit.laws import Lags, Product
from railgrip.laboratory.pad_fit.parameters import (
    LEAST_STOPS,
    REFERENCE,
    Parameter,
    curve_points,
    parameters_of,
)
from railgrip.laboratory.pad_fit.shape import Placed, Shape, check_shape

SIGNIFICANT = 0.05
LEAST_START_LAG = 1.0


@dataclass(frozen=True)
class Plan:
    """What shall be found.

    Parameters
    ----------
    shapes : dict
        Influence → shape of its function; an influence that is missing gets none.
    reference : dict
        Influence → where its function is 1.
    lags : Lags
        Of the sensors, given or to be found.
    method : {"together", "one_at_a_time"}
        All data at once; or each function from the data near the reference of the other two.
    nearness : float
        For one at a time: how near, in shares of the reference value.
    """

    shapes: dict[str, Shape] = field(default_factory=lambda: dict.fromkeys(INFLUENCES, Shape()))
    reference: dict[str, float] = field(default_factory=lambda: dict(REFERENCE))
    lags: Lags = field(default_factory=lambda: Lags(fitted=("temperature",)))
    method: Literal["together", "one_at_a_time"] = "together"
    nearness: float = 0.15


@dataclass(frozen=True)
class Identified:
    """A pad found in measured stops.

    Parameters
    ----------
    fit : Fit
        The fitted product.
    parameters : list of Parameter
        With 95 % intervals clustered by stop.
    naive : list of Parameter
        The same with the intervals that ignore the correlation.
    points : dict
        Influence → points of its function, [(x, factor)].
    problems : list of Problem
        What could not be found, and why.
    blocks : Blocks
        What was fitted to.
    plan : Plan
        What was asked.
    """

    fit: Fit
    parameters: list[Parameter]
    naive: list[Parameter]
    points: dict[str, list[tuple[float, float]]]
    problems: list[Problem]
    blocks: Blocks
    plan: Plan

    def __getitem__(self, name: str) -> Parameter:
        """Return a parameter by its name."""
        return next(one for one in self.parameters if one.name == name)

    @property
    def reference_friction(self) -> float:
        """Friction at the reference point."""
        return self.parameters[0].value

    def pad(self) -> dict[str, Any]:
        """Return the pad as a scenario reads it, SI and °C."""
        table: dict[str, Any] = {"law": "piecewise", "reference_friction": self.reference_friction}
        for name in INFLUENCES:
            if name in self.points:
                table[name] = [list(point) for point in self.points[name]]
        return table


def identify_pad(stops: PadStops, plan: Plan | None = None) -> Identified:
    """Find reference friction and functions of a pad in measured stops.

    Parameters
    ----------
    stops : PadStops
        Samples while braking, at least two stops.
    plan : Plan, optional
        What to find; all three functions with two break points each if not given.

    Returns
    -------
    Identified
        With `problems` for every function that could not be found; the rest is fitted.

    Raises
    ------
    RailgripError
        ``nothing can be fitted: there are 1 stops; allowed: 2 or more``

    Notes
    -----
    log μ = log f0 + Σ log f_i(x_i) + offset of the stop + noise that dies out over its memory; see
    `railgrip.laboratory.pad_fit.fitting.fit_law` for how it is solved. An influence whose curve
    passes for none at the 5 % level (Wald test of straight lines through seven knots, clustered by
    stop) gets no function: break points of a level line do not exist.

    Checked by studies/identification.py: 200 trials with known functions.

    Examples
    --------
    >>> from railgrip.laboratory.pad_fit.synthetic import Programme, organic, synthetic_stops
    >>> found = identify_pad(synthetic_stops(organic, Programme(stops=40), seed=1))
    >>> abs(found.reference_friction - 0.37) < 0.01
    True
    """
    asked = plan or Plan()
    for name, shape in asked.shapes.items():
        check_shape(name, shape)
    blocks = blocks_of(stops)
    if blocks.stops < 2:
        what = f"nothing can be fitted: there are {blocks.stops} stops"
        raise RailgripError(Problem("", what, allowed="2 or more"))
    if asked.method == "one_at_a_time":
        from railgrip.laboratory.pad_fit.one_at_a_time import one_at_a_time

        return one_at_a_time(blocks, asked)
    return together(blocks, asked)


def together(blocks: Blocks, plan: Plan) -> Identified:
    """Find all functions at once; see `identify_pad`."""
    names, problems = identifiable(list(plan.shapes), blocks)
    if blocks.stops < LEAST_STOPS:
        what = f"no intervals: {blocks.stops} stops are too few"
        problems.append(Problem("", what, allowed=f"{LEAST_STOPS} or more"))
    starts = [LEAST_START_LAG if n in plan.lags.fitted else plan.lags.given[k]
              for k, n in enumerate(INFLUENCES)]  # fmt: skip
    lags = plan.lags._replace(given=(starts[0], starts[1], starts[2]))
    rough = additive_fit(names, blocks, lags)
    for name in list(names):
        if blocks.stops >= LEAST_STOPS:
            chance = chance_of_no_effect(name, rough, blocks.stops)
            if chance > SIGNIFICANT:
                names.remove(name)
                what = "shows no effect: its factor is 1"
                problems.append(Problem(name, what, f"probability {chance:.2f} of chance alone"))
    placed, more = _placed(names, blocks, plan)
    law = Product(placed, lags)
    start = _start(law, rough, blocks)
    fit = fit_law(law, blocks, start, intervals=True)
    fit, again = _straightened(fit, rough, blocks, plan)
    return identified(fit, blocks, plan, [*problems, *more, *again])


def identified(fit: Fit, blocks: Blocks, plan: Plan, problems: list[Problem]) -> Identified:
    """Return a fit in the words of a pad."""
    law = fit.law
    assert isinstance(law, Product)
    numbers, _ = law.parts(fit.theta)
    points = {
        name: curve_points(placed, numbers[name], plan.reference[name])
        for name, placed in law.functions.items()
    }
    for name, placed in law.functions.items():
        if not placed.low <= plan.reference[name] <= placed.high:
            unit = UNITS[name]
            what = "the reference lies outside the data, where the function is held constant"
            got = f"{plan.reference[name]:g} {unit}"
            problems.append(
                Problem(name, what, got, f"{placed.low:.4g} to {placed.high:.4g} {unit}")
            )
    found = parameters_of(fit, blocks.stops, plan.reference)
    naive = parameters_of(fit, blocks.stops, plan.reference, naive=True)
    return Identified(fit, found, naive, points, problems, blocks, plan)


def _placed(
    names: list[str], blocks: Blocks, plan: Plan
) -> tuple[dict[str, Placed], list[Problem]]:
    placed, problems = {}, []
    for name in names:
        shape = plan.shapes[name]
        levels = levels_of(name, blocks)
        if levels and shape.free_points:
            shape = Shape(len(levels), "flat", levels)
            what = "its break points cannot be found: it takes few values; they are its points"
            got = ", ".join(f"{level:.4g}" for level in levels) + f" {UNITS[name]}"
            problems.append(Problem(name, what, got))
        placed[name] = Placed(shape, *range_of(name, blocks))
    return placed, problems


def _start(law: Product, rough: Fit, blocks: Blocks) -> FloatArray:
    inner = [first_guess(placed, name, rough, blocks) for name, placed in law.functions.items()]
    lags = [law.lags.given[INFLUENCES.index(name)] for name in law.fitted_lags]
    start = np.concatenate([[0.0], *inner, lags])
    without, _ = law.log_friction(start, blocks)
    start[0] = float(np.median((blocks.log_friction - without)[blocks.is_there]))
    return start


def _straightened(fit: Fit, rough: Fit, blocks: Blocks, plan: Plan) -> tuple[Fit, list[Problem]]:
    """Replace functions whose break points the stops cannot tell by one straight line."""
    law = fit.law
    assert isinstance(law, Product)
    problems = []
    functions = dict(law.functions)
    for name, placed in law.functions.items():
        half = _half_width(fit, name, blocks.stops, plan)
        span = placed.high - placed.low
        if half > 0.5 * span:
            functions[name] = Placed(Shape(2, "open"), placed.low, placed.high)
            unit = UNITS[name].replace("°C", "K")
            what = "its break points cannot be found: fitted as one straight line"
            got = f"± {half:.3g} {unit} in a range of {span:.3g} {unit}"
            problems.append(Problem(name, what, got, cure="more stops, or more variation in each"))
    if not problems:
        return fit, []
    law = Product(functions, law.lags)
    return fit_law(law, blocks, _start(law, rough, blocks), intervals=True), problems


def _half_width(fit: Fit, name: str, stops: int, plan: Plan) -> float:
    if stops < LEAST_STOPS:
        return 0.0
    halves = [
        one.high - one.value
        for one in parameters_of(fit, stops, plan.reference)
        if one.name.startswith(f"{name}_point") and not one.is_fixed
    ]
    return max(halves, default=0.0)
