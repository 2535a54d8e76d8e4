"""From a law of rolling contact to a table of it: once, so that a look-up does from then on."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from railgrip.contact.input_checks import refuse_not_positive
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import RollingContact, RollingLaw
from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.creep_curves import (
    Curve,
    Frame,
    axis_for,
    curve_at,
    curves_between,
    points_elsewhere,
)
from railgrip.laboratory.creep_samples import Law, Points, coulomb, is_compiled
from railgrip.laboratory.creep_spline import sample_places, spline_coefficients
from railgrip.laboratory.creep_table import CreepTable
from railgrip.laboratory.inputs import FloatArray, refuse

CELLS, CURVES = 512, 33
"""Cells of a curve, and curves where a table needs several."""
SLOW_CELLS, SLOW_CURVES = 64, 9
"""The same for laws called from Python, point by point."""
EXCESS = 1e-3
"""By so much of μQ a law may pass the friction it is given: the rounding of a solver."""


def tabulate(
    law: str | RollingLaw,
    contact: RollingContact,
    rail: RailFriction,
    *,
    lateral: float = 0.0,
    spin: float = 0.0,
    is_local: bool = False,
    cells: int | None = None,
    curves: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> CreepTable:
    """Table of a law's longitudinal force over creepage, for any load, speed and friction.

    Choose it for a law too slow to be computed at every step, and for its place in the engine. Laws
    of the package are compiled; any other function is called from Python, point by point.

    Parameters
    ----------
    law : str or callable
        Name of a registered law of rolling contact, or anything with the same contract.
    contact : RollingContact
        The contact; its load is the load of reference.
    rail : RailFriction
        State of reference; k_A and k_S hold for the whole table.
    lateral : float
        Lateral creepage that goes with every longitudinal one, −1 … 1 [-].
    spin : float
        Spin, likewise [1/m].
    is_local : bool
        Whether friction falls with the slip of each point of the patch, and not with that of its
        centre for all of it. The table then also holds for the A of `rail` only.
    cells : int, optional
        Cells of a curve, ≥ 8; absent: `CELLS`, or `SLOW_CELLS` for a law that is not compiled.
    curves : int, optional
        Curves, ≥ 2, where lateral creepage, spin or `is_local` ask for several; absent: `CURVES`
        or `SLOW_CURVES`.
    progress : callable, optional
        Called with the share of the points that are done, 0 … 1.

    Returns
    -------
    CreepTable
        With the error that it was found to have.

    Raises
    ------
    RailgripError
        "the load must be positive and finite; got 0 N" and likewise; "the law gives 1.5 of the
        friction force"; "cells must be at least 8".

    Notes
    -----
    What a table needs is what similarity leaves. With f = C s/(μQ), C = G a b C11, and an ellipse
    whose shape the load does not change, F/(μQ) of a law with one friction for the patch is a
    function of f alone: one curve serves every load, speed and rail, exactly.
    Lateral creepage adds C s_y/(μQ), spin G (ab)^(3/2) φ/(μQ), which with a, b ~ Q^(1/3) depends on
    μ only: a second axis, over μQ/C or over μ, and still exact for every load, speed and rail.
    With both, the greater takes the axis; the other is then exact at the load of reference.
    Friction that falls with the local slip brings A and B w: with k μ0, creepage k s and speed v/k
    the slip speed w stays and the force is k F. So the axis is B w, exact for every load, μ0, B and
    speed. With lateral creepage or spin besides, it is exact at the load and μ0 of reference only.
    `error` is measured, in all these respects; nothing of it is estimated.

    Checked by tests/unit/laboratory/test_tabulate.py.

    Examples
    --------
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> table = tabulate("fastsim_1982", base, rail)
    >>> round(table.force(100e3, rail, 20.0, 0.001) / 30e3, 4), table.error < 1e-5
    (0.4077, True)
    """
    name = law if isinstance(law, str) else getattr(law, "__name__", type(law).__name__)
    function = registry.resolve("railgrip.rolling_laws", law) if isinstance(law, str) else law
    cells = cells if cells is not None else (CELLS if is_compiled(function) else SLOW_CELLS)
    curves = curves if curves is not None else (CURVES if is_compiled(function) else SLOW_CURVES)
    _refuse_bad(contact, rail, lateral, spin, is_local, cells, curves)
    frame = Frame(contact, rail, lateral, spin, axis_for(contact, lateral, spin, is_local))
    count = curves if frame.axis.size > 0.0 else 1
    places = sample_places(cells)
    nodes = [curve_at(frame, i / max(count - 1, 1), places) for i in range(count)]
    between, elsewhere = curves_between(frame, cells, count), points_elsewhere(frame, cells)
    few = curve_at(frame, 1.0, np.array([0.25, 0.5, 0.75])).points
    every_point = [*(each.points for each in (*nodes, *between)), *elsewhere, few, few]
    asked = Law(function, _counter(sum(each.creepage.size for each in every_point), progress))
    rows = np.array([_coefficients(asked, each, is_local) for each in nodes])
    table = CreepTable(name, *frame, rows, _reads_reduction(asked, few), math.nan)
    errors = [_difference(table, asked, each.points, each.scale) for each in between]
    errors += [_difference(table, asked, each, np.ones(each.creepage.size)) for each in elsewhere]
    return table._replace(error=max(errors))


def _coefficients(asked: Law, curve: Curve, is_local: bool) -> FloatArray:
    share = asked.shares(curve.points)
    if not is_local and share.max() > 1.0 + EXCESS:
        raise RailgripError(
            Problem(
                "",
                "the law gives more than friction allows, so a table cannot hold it",
                got=f"{share.max():.3g} of μQ",
                cure="a law that friction bounds",
            )
        )
    whole = np.sqrt(curve.along**2 + curve.across**2)
    return spline_coefficients(share / curve.along * (1.0 + whole))


def _reads_reduction(asked: Law, points: Points) -> bool:
    """Whether other k_A and k_S make another force."""
    rail = points.rail
    other = rail._replace(
        adhesion_reduction=0.5 * rail.adhesion_reduction, slip_reduction=0.25 * rail.slip_reduction
    )
    return bool((asked.shares(points) != asked.shares(points._replace(rail=other))).any())


def _difference(table: CreepTable, asked: Law, points: Points, scale: FloatArray) -> float:
    """Greatest difference of table and law, in shares of μQ.

    Where points stand for others, the table is read at those: creepages and friction over `scale`.
    """
    law = asked.shares(points)
    read = []
    columns = (points.speed, points.creepage, scale)
    for speed, creepage, factor in zip(*(each.tolist() for each in columns), strict=True):
        rail = points.rail
        if factor != 1.0:
            rail = coulomb(rail, rail.static_friction / factor)
        read.append(table.share(points.contact.load, rail, speed, creepage / factor))
    return float(np.abs(np.array(read) - law).max())


def _counter(points: int, progress: Callable[[float], None] | None) -> Callable[[int], None]:
    asked = 0

    def done(more: int) -> None:
        nonlocal asked
        asked += more
        if progress is not None:
            progress(asked / points)

    return done


def _refuse_bad(
    contact: RollingContact,
    rail: RailFriction,
    lateral: float,
    spin: float,
    is_local: bool,
    cells: int,
    curves: int,
) -> None:
    refuse_not_positive(
        (
            ("load", contact.load, "N"),
            ("semi-axis along the track", contact.a, "m"),
            ("semi-axis across the track", contact.b, "m"),
            ("shear modulus", contact.shear_modulus, "Pa"),
            ("friction coefficient", rail.static_friction, ""),
        )
    )
    for name, value, unit in (("lateral creepage", lateral, ""), ("spin", spin, "1/m")):
        if not math.isfinite(value):
            refuse(name, value, unit, positive=False)
    for name, number, least in (("cells", cells, 8), ("curves", curves, 2)):
        if number < least:
            raise RailgripError(Problem("", f"{name} must be at least {least}", got=str(number)))
    if is_local:
        refuse_not_positive(
            (("decay of the friction with the slip speed", rail.friction_decay, "s/m"),)
        )
