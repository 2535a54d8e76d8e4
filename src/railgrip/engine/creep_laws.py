"""The creep law that a scenario names: built in, somebody's own, or a table of a slow one."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import RollingContact, rolling_contact
from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine import layout as at
from railgrip.engine.kept_tables import kept
from railgrip.engine.lower_train import contact_geometry
from railgrip.engine.plan import CreepTables, FloatArray
from railgrip.laboratory.creep_grid import GridAxis
from railgrip.laboratory.creep_samples import is_compiled
from railgrip.laboratory.creep_table import CreepTable
from railgrip.laboratory.tabulate import tabulate
from railgrip.scenario.scenario import Scenario

LAWS = {
    "polach_2005": at.LAW_POLACH,
    "freibauer_1983": at.LAW_FREIBAUER,
    "shen_hedrick_elkins_1983": at.LAW_SHEN,
}
TABULATED = ("railgrip.rolling_laws", "railgrip.slow_rolling_laws")
"""Groups of the laws that enter the engine as tables."""
GREATEST_ERROR = 0.01
"""A table that is farther from its law is refused, in shares of μQ."""
_LOAD, _FRICTION, _DECAY = 100e3, 0.3, 0.2
"""Load and friction of reference: tables hold for any."""


def find_creep_law(scenario: Scenario, conditions: FloatArray) -> tuple[int, CreepTables]:
    """Return the number of the law that the scenario names, and its tables if it has any.

    Parameters
    ----------
    scenario : Scenario
        Complete and checked.
    conditions : float array (condition, 11)
        The states of its rail, as in `Way`.

    Raises
    ------
    RailgripError
        ``run.creep_law: 'my_law' cannot be tabulated: …``; ``run.angle_of_attack: the law
        'my_law' knows no lateral creepage``.
    """
    name, angle = scenario.run.creep_law, scenario.run.angle_of_attack
    group = registry.group_of(name, TABULATED)
    known = name in registry.names(group)
    if angle != 0.0 and not known:
        names = ", ".join(registry.names("railgrip.rolling_laws"))
        what = f"the creep law '{name}' knows no lateral creepage"
        raise RailgripError(Problem("run.angle_of_attack", what, cure=f"one of {names}"))
    if angle == 0.0 and name in registry.names("railgrip.laws"):
        return LAWS.get(name, at.LAW_CUSTOM), _no_tables(scenario.train.n_axles)
    states = np.concatenate([conditions[:, : at.N_FRICTION], conditions[:, at.N_FRICTION : -1]])
    tables = [
        _table(name, contact_geometry(scenario, i), _common(states), math.sin(angle))
        for i in range(scenario.train.n_axles)
    ]
    _refuse_unfit(tables, states)
    curves = np.array([table.curves for table in tables])
    axes = np.array([table.axis for table in tables])
    found = CreepTables(curves, axes, max(table.error for table in tables))
    return at.LAW_TABLE if tables[0].is_one_curve else at.LAW_GRID, found


def _no_tables(n_axles: int) -> CreepTables:
    return CreepTables(np.zeros((n_axles, 1, 3)), np.zeros((n_axles, len(GridAxis._fields))), 0.0)


def _common(states: FloatArray) -> RailFriction:
    """What a table may take from the rail: A, k_A and k_S of its first state."""
    _, ratio, _, adhesion, slip = states[0].tolist()
    return RailFriction(_FRICTION, ratio, _DECAY, adhesion, slip)


@cache
def _table(
    name: str, geometry: tuple[float, ...], rail: RailFriction, lateral: float
) -> CreepTable:
    """Tabulate once in a process; what takes long in our own package, once for all."""
    group = registry.group_of(name, TABULATED)
    law: Any = registry.resolve(group, name, "run.creep_law")

    def make() -> CreepTable:
        try:
            return _tabulated(law, rolling_contact(_LOAD, *geometry), rail, lateral)
        except RailgripError as error:
            what = f"the law '{name}' cannot be tabulated: {error}"
            raise RailgripError(Problem("run.creep_law", what)) from error

    takes_long = not is_compiled(law) and law.__module__.startswith("railgrip.")
    table = kept((name, geometry, *rail, lateral), make) if takes_long else make()
    return table._replace(law=name)


def _tabulated(law: Any, contact: RollingContact, rail: RailFriction, lateral: float) -> CreepTable:
    """Take one friction for the patch; if the law does not, a friction that falls in each point."""
    table = tabulate(law, contact, rail, lateral=lateral)
    if table.error > GREATEST_ERROR and rail.friction_ratio < 1.0:
        table = tabulate(law, contact, rail, lateral=lateral, is_local=True)
    return table


def _refuse_unfit(tables: list[CreepTable], states: FloatArray) -> None:
    table = max(tables, key=lambda each: each.error)
    if table.error > GREATEST_ERROR:
        raise RailgripError(
            Problem(
                "run.creep_law",
                f"a table of the law '{table.law}' is too far from it",
                got=f"{table.error:.2g} of the friction force",
                allowed=f"{GREATEST_ERROR:g}",
            )
        )
    columns = {"friction_ratio": 1} if table.axis.by_fall else {}
    if table.reads_reduction:
        columns |= {"adhesion_reduction": 3, "slip_reduction": 4}
    for name, column in columns.items():
        if np.ptp(states[:, column]) > 0.0:
            raise RailgripError(
                Problem(
                    "run.creep_law",
                    f"a table of the law '{table.law}' needs a rail with one {name}",
                    got=", ".join(f"{value:g}" for value in np.unique(states[:, column])),
                    cure="another creep law, or states of the rail that agree in it",
                )
            )
