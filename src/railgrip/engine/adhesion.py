"""The greatest adhesion that a contact could transmit, at whatever slip: the creep curve's peak."""

from __future__ import annotations

from typing import Any

import numpy as np

from railgrip.compiler import compiled, entry, inlined
from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.core import registry
from railgrip.engine import layout as at
from railgrip.engine.offsets import as_offset
from railgrip.engine.plan import FloatArray, Plan
from railgrip.laboratory.creep_grid import chord_by_grid
from railgrip.laboratory.creep_spline import chord_by_table
from railgrip.scenario.scenario import Scenario

_polach = inlined(polach_2005)
_falling = inlined(falling_friction)
_by_table = inlined(chord_by_table)
_by_grid = inlined(chord_by_grid)

CREEPAGES = np.geomspace(1e-4, 1.0, 48)
"""Creepages at which the curve is sampled: within 0.5 % of the peak of Polach's curves."""


@inlined
def _peaks_of(
    law: Any, mu: Any, ratio: Any, decay: Any, stick: Any, slip: Any,
    load: Any, slope: Any, speed: Any, creepages: Any, peak: Any,
) -> None:  # fmt: skip
    n = as_offset(load.shape[0])
    for j in range(creepages.shape[0]):
        creepage = creepages[j]
        for i in range(n):
            rail = RailFriction(mu[i], ratio[i], decay[i], stick[i], slip[i])
            force = law(rail, load[i], slope[i], creepage * speed[i], creepage)
            peak[i] = max(peak[i], force / load[i])


@entry
def _peaks_polach(
    mu: Any, ratio: Any, decay: Any, stick: Any, slip: Any,
    load: Any, slope: Any, speed: Any, creepages: Any, peak: Any,
) -> None:  # fmt: skip
    """Peaks of the default law: kept compiled on disk."""
    _peaks_of(_polach, mu, ratio, decay, stick, slip, load, slope, speed, creepages, peak)


@entry
def _peaks_by_tables(
    mu: Any, ratio: Any, decay: Any, stick: Any, slip: Any,
    load: Any, slope: Any, speed: Any, creepages: Any, peak: Any, tables: Any, axle: Any,
) -> None:  # fmt: skip
    """The same where the law of each axle stands in a table."""
    is_one_curve = tables.curves.shape[1] == 1
    for i in range(load.shape[0]):
        rail = RailFriction(mu[i], ratio[i], decay[i], stick[i], slip[i])
        curves, axis = tables.curves[axle[i]], tables.axes[axle[i]]
        for j in range(creepages.shape[0]):
            creepage = creepages[j]
            if is_one_curve:
                limit = load[i] * _falling(rail, creepage * speed[i])
                chord = _by_table(curves[0], limit, slope[i], creepage)
            else:
                chord = _by_grid(curves, axis, rail, load[i], slope[i], speed[i], creepage)
            peak[i] = max(peak[i], chord * creepage / load[i])


def available_adhesion(
    scenario: Scenario, plan: Plan, of_axle: dict[str, FloatArray], speed: FloatArray
) -> FloatArray:
    """Return the peak of the creep curve at every point of the traces (run, axle, time).

    Own cleaning in the contact is left out: it is what the rail offers as it lies there.
    """
    shape = of_axle["wheel_load"].shape

    def per_axle(offset: int) -> FloatArray:
        column: FloatArray = plan.parameters[1:, offset - at.FIRST_PARAMETER]
        return column[None, :, None]

    load = of_axle["wheel_load"].ravel()
    relative = (of_axle["wheel_load"] / per_axle(at.STATIC_LOAD)).ravel() ** (2 / 3)
    slope = relative * np.broadcast_to(per_axle(at.KALKER_SLOPE), shape).ravel()
    names = (
        "rail_friction", "friction_ratio", "friction_decay", "adhesion_reduction", "slip_reduction",
    )  # fmt: skip
    state = [np.ascontiguousarray(of_axle[name].ravel()) for name in names]
    speeds = np.ascontiguousarray(np.broadcast_to(speed, shape)).ravel()
    peak = np.zeros_like(load)
    arguments = (*state, load, slope, speeds, CREEPAGES, peak)
    if plan.creep_law in (at.LAW_TABLE, at.LAW_GRID):
        numbers = np.arange(shape[1])[None, :, None]
        axle = np.ascontiguousarray(np.broadcast_to(numbers, shape)).ravel()
        _peaks_by_tables(*arguments, plan.creep_tables, axle)
    elif plan.creep_law == at.LAW_POLACH:
        _peaks_polach(*arguments)
    else:
        law = inlined(registry.resolve("railgrip.laws", scenario.run.creep_law))
        compiled(_peaks_of.py_func)(law, *arguments)
    peak[np.isnan(load)] = np.nan
    return peak.reshape(shape)
