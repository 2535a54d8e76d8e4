"""From uniform numbers to the quantities of runs: copula, distributions, places in the scenario."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from railgrip.campaign.campaign_file import CampaignFile
from railgrip.campaign.campaign_parts import Variable
from railgrip.campaign.distribution_kinds import Values
from railgrip.campaign.sampling import uniform_numbers
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.plan import FloatArray
from railgrip.scenario import Scenario
from railgrip.scenario.places import SCOPES, Place, find_places, spread_out

Draws = dict[str, Values]
"""Column → one value for each run, as drawn (a factor, an offset or a value)."""


class Column(NamedTuple):
    """One draw of a variable: the places in the scenario that share it.

    Attributes
    ----------
    name : str
        The variable's label; with the vehicle, bogie or axle it belongs to, as ``mass_V2``.
    variable : Variable
        What it is drawn from.
    places : tuple of Place
        Where it goes.
    """

    name: str
    variable: Variable
    places: tuple[Place, ...]

    def value(self, place: Place, drawn: Any) -> Any:
        """Return what the scenario has at a place under a draw (a number or an array)."""
        if self.variable.apply == "value":
            return drawn
        return place.value * drawn if self.variable.apply == "factor" else place.value + drawn


class Drawing:
    """Draws the runs of a campaign.

    Parameters
    ----------
    campaign : CampaignFile
        What varies.
    scenario : Scenario
        In which it varies; its names decide what each variable means.
    """

    def __init__(self, campaign: CampaignFile, scenario: Scenario) -> None:
        self.campaign = campaign
        self.scenario = spread_out(scenario)
        self.columns = [
            column
            for i, variable in enumerate(campaign.variable)
            for column in _columns(self.scenario, variable, f"variable[{i}].quantity")
        ]
        _refuse_two_at_a_place(self.columns)
        self.names = [column.name for column in self.columns]
        self._factors = self._correlations()

    def _correlations(self) -> list[tuple[list[int], FloatArray]]:
        """Return columns that go together, with the Cholesky factor of their correlation."""
        found = []
        for i, correlation in enumerate(self.campaign.correlation):
            labels = list(correlation.variables)
            factor = np.linalg.cholesky(np.array(correlation.matrix))
            of = [[k for k, c in enumerate(self.columns) if c.variable.label == n] for n in labels]
            if len({len(columns) for columns in of}) > 1:
                where = f"correlation[{i}].variables"
                raise RailgripError(Problem(where, "have not equally many places to go together"))
            found += [(list(together), factor) for together in zip(*of, strict=True)]
        return found

    def draw(self, first: int, last: int) -> Draws:
        """Return what is drawn for the runs first … last − 1.

        Raises
        ------
        RailgripError
            Of `sampling.uniform_numbers`.
        """
        sampling = self.campaign.sampling
        u = uniform_numbers(
            sampling.method, sampling.seed, self.names, first, last, self.campaign.runs
        )
        return self.values(u)

    def values(self, u: FloatArray) -> Draws:
        """Return the draws that uniform numbers (run, column) in (0, 1) stand for."""
        if self._factors:
            u = self._bound_together(u)
        return {
            column.name: column.variable.distribution.ppf(u[:, i])
            for i, column in enumerate(self.columns)
        }

    def _bound_together(self, u: FloatArray) -> FloatArray:
        from scipy.special import ndtr, ndtri

        u = u.copy()
        for columns, factor in self._factors:
            # a sum in a fixed order: a matrix product would depend on the number of rows
            scores = [ndtri(u[:, column]) for column in columns]
            for row, column in enumerate(columns):
                u[:, column] = ndtr(sum(factor[row, k] * scores[k] for k in range(row + 1)))
        return np.clip(u, 2.0**-60, 1.0 - 2.0**-53)


def _columns(scenario: Scenario, variable: Variable, where: str) -> list[Column]:
    places = find_places(scenario, variable.quantity, where)
    depth = SCOPES.index(variable.scope)
    if any(len(place.position) < depth for place in places):
        what = f"'{variable.quantity}' does not belong to single {variable.scope}s"
        raise RailgripError(Problem(where.replace("quantity", "scope"), what, cure="'train'"))
    groups: dict[tuple[int, ...], list[Place]] = {}
    for place in places:
        groups.setdefault(place.position[:depth], []).append(place)
    columns = []
    for position, group in sorted(groups.items()):
        _refuse_impossible(variable, group, where)
        tags = [f"{letter}{number + 1}" for letter, number in zip("VBA", position, strict=False)]
        columns.append(Column("_".join([variable.label, *tags]), variable, tuple(group)))
    return columns


def _refuse_impossible(variable: Variable, places: list[Place], where: str) -> None:
    """Refuse a number where something else stands, and the other way round."""
    value = places[0].value
    drawn = variable.distribution.ppf(np.array([0.5]))
    is_number = np.issubdtype(drawn.dtype, np.number) and drawn.dtype != bool
    needs_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if variable.apply != "value" and not (needs_number and is_number):
        what = f"'{variable.quantity}' is no number of this scenario to take a {variable.apply} of"
        raise RailgripError(Problem(where, what))
    if isinstance(value, bool) and drawn.dtype != bool:
        what = f"'{variable.quantity}' is true or false"
        raise RailgripError(Problem(where, what, cure="distribution.kind = 'event'"))
    if needs_number and not is_number:
        raise RailgripError(Problem(where, f"'{variable.quantity}' is a number, the draws are not"))


def _refuse_two_at_a_place(columns: list[Column]) -> None:
    owners: dict[Any, str] = {}
    for column in columns:
        for place in column.places:
            other = owners.setdefault(place.steps, column.variable.label)
            if other != column.variable.label:
                what = f"'{column.variable.label}' and '{other}' both set {place.steps[-1]}"
                raise RailgripError(Problem("variable", what))
