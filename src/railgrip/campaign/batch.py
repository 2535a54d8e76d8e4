"""One chunk of a campaign: drawn, laid out as arrays, run, reduced to a table of columns.

Each quantity that is drawn is tried once, before the campaign begins: where lowering a scenario
with an array gives the numbers that lowering it value by value gives, it goes into the batch as an
array. Where it does not (a controller, a filling with inshot, a delay in ticks), runs with the
same value form a group that is lowered together.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from railgrip.campaign.campaign_file import CampaignFile
from railgrip.campaign.collecting import Collector, find_collector
from railgrip.campaign.distribution_kinds import Values
from railgrip.campaign.drawing import Column, Drawing, Draws
from railgrip.campaign.lowering import goes_together
from railgrip.campaign.quantities import allowed, in_range, spoken
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.status import RunStatus
from railgrip.engine.many import vary
from railgrip.engine.plan import Outcome, Overrides, Plan
from railgrip.engine.result import figures_of
from railgrip.engine.simulate import Prepared, compute, prepare
from railgrip.report.metrics import SOURCES
from railgrip.scenario import Scenario
from railgrip.scenario.places import replaced

Table = dict[str, Values]
TRIED = (0.3, 0.7, *np.linspace(0.01, 0.99, 50))
"""Quantiles at which a quantity is tried: the first two that the scenario allows."""
MOST_GROUPS = 64
"""Groups whose lowered scenario is kept."""
FASTEST = 1.0 - 1e-9
"""Quantile of the initial speed that the rail's cells are laid out for."""


class Batches:
    """Runs the chunks of a campaign, in any order and in any number of threads.

    Parameters
    ----------
    campaign : CampaignFile
        What is asked.
    scenario : Scenario, optional
        In place of the campaign's own: a design under a condition.

    Raises
    ------
    RailgripError
        Where a quantity cannot be drawn or a scenario not be run.
    """

    def __init__(self, campaign: CampaignFile, scenario: Scenario | None = None) -> None:
        scenario = campaign.base() if scenario is None else scenario
        self.campaign = campaign
        self.scenario = _for_the_fastest(campaign, scenario)
        self.drawing = Drawing(campaign, self.scenario)
        self.collect: Collector | None = find_collector(campaign.collector, self.drawing.names)
        self._groups: dict[tuple[Any, ...], tuple[Scenario, Prepared]] = {}
        first = {column.variable.label: column for column in reversed(self._columns())}
        tried = {label: self._goes_together(column) for label, column in first.items()}
        self.together = {column.name: tried[column.variable.label] for column in self._columns()}

    def _columns(self) -> list[Column]:
        return self.drawing.columns

    @property
    def apart(self) -> list[str]:
        """Names of the columns that cannot share a batch."""
        return [name for name, together in self.together.items() if not together]

    def table(self, first: int, last: int) -> Table:
        """Return draws, status and figures of the runs first … last − 1, column by column."""
        draws = self.drawing.draw(first, last)
        table: Table = {"run": np.arange(first, last, dtype=np.int64), **_plain(draws)}
        found = self.figures(draws, table["run"])
        return {**table, **found}

    def figures(self, draws: Draws, number: Values) -> Table:
        """Return status and figures of runs with these draws."""
        possible = self._possible(draws, len(number), self._columns())
        whole: Table = {}
        for rows in self._grouped(draws, possible):
            part = self._run({name: values[rows] for name, values in draws.items()}, number[rows])
            for name, values in part.items():
                if name not in whole:
                    whole[name] = _missing(values.dtype, len(number))
                whole[name][rows] = values
        if not whole:
            whole = {name: np.full(len(number), np.nan) for name in self.campaign.keep}
        whole["status"] = whole.get("status", np.zeros(len(number), dtype=np.int8))
        whole["status"][~possible] = RunStatus.IMPOSSIBLE
        return whole

    def _possible(self, draws: Draws, runs: int, columns: Sequence[Column]) -> Any:
        """Return which runs keep the range that the scenario allows each quantity."""
        possible = np.ones(runs, dtype=bool)
        for column in columns:
            for place in column.places:
                value = column.value(place, draws[column.name])
                possible &= in_range(self.drawing.scenario, place, value)
        return possible

    def _grouped(self, draws: Draws, possible: Any) -> list[Any]:
        """Return the rows of each group that can share a batch."""
        rows = np.flatnonzero(possible)
        if not self.apart:
            return [rows] if len(rows) else []
        groups: dict[tuple[Any, ...], list[int]] = {}
        for row in rows:
            groups.setdefault(self._key(draws, int(row)), []).append(int(row))
        return [np.array(group) for group in groups.values()]

    def _key(self, draws: Draws, row: int) -> tuple[Any, ...]:
        return tuple(draws[name][row].item() if hasattr(draws[name][row], "item")
                     else draws[name][row] for name in self.apart)  # fmt: skip

    def _run(self, draws: Draws, number: Values) -> Table:
        prepared, plan, changes = self.laid_out(draws, number)
        out, _ = compute(prepared._replace(plan=plan), changes)
        figures = kept(prepared.scenario, out, self.campaign.keep)
        figures["status"] = out.train[:, 0].astype(np.int8)
        if self.collect is not None:
            figures |= self.collect(prepared.scenario, out, len(number))
        return figures

    def laid_out(self, draws: Draws, number: Values) -> tuple[Prepared, Plan, Overrides]:
        """Return what the engine needs for runs of one group."""
        single, prepared = self._group(draws)
        many = single
        for column in self._columns():
            if self.together[column.name]:
                for place in column.places:
                    value = column.value(place, draws[column.name])
                    many = replaced(many, place.steps, value)
        plan, changes = vary(prepared.plan, single, many, np.asarray(number, dtype=np.int64))
        return prepared, plan, changes

    def _group(self, draws: Draws) -> tuple[Scenario, Prepared]:
        key = self._key(draws, 0) if self.apart else ()
        found = self._groups.get(key)
        if found is None:
            scenario = self.drawing.scenario
            for column in self._columns():
                if not self.together[column.name]:
                    drawn = key[self.apart.index(column.name)]
                    for place in column.places:
                        scenario = replaced(scenario, place.steps, column.value(place, drawn))
            if self.apart:
                scenario = _checked(scenario)
            found = (scenario, prepare(scenario))
            if len(self._groups) < MOST_GROUPS:
                self._groups[key] = found
        return found

    def _goes_together(self, column: Column) -> bool:
        scenario = self.drawing.scenario
        prepared = self._groups.setdefault((), (scenario, prepare(scenario)))[1]
        return goes_together(scenario, column, self._tried(column), prepared, _checked)

    def _tried(self, column: Column) -> Values:
        """Return two draws that the scenario allows, or all names; refuse where there is none."""
        drawn = column.variable.distribution.ppf(np.array(TRIED))
        if drawn.dtype.kind == "b":
            return np.array([False, True])
        if drawn.dtype.kind not in "fi":  # names: each of them must be one
            return np.asarray(drawn)
        possible = self._possible({column.name: drawn}, len(drawn), [column])
        if not possible.any():
            i = self.campaign.variable.index(column.variable)
            place = column.places[0]
            low, high = column.value(place, drawn).min(), column.value(place, drawn).max()
            raise RailgripError(
                Problem(
                    f"variable[{i}].distribution",
                    f"nothing that it draws is possible for {place.steps[-1]}",
                    spoken(self.drawing.scenario, place, low, high),
                    allowed(self.drawing.scenario, place),
                )
            )
        return np.asarray(np.resize(drawn[possible], 2))


def kept(scenario: Scenario, out: Outcome, names: tuple[str, ...]) -> Table:
    """Return the named figures of every run."""
    found = figures_of(scenario, out)
    table: Table = {}
    for name in names:
        source = SOURCES[name]
        values = found[source.variable]
        if source.over_axles:
            reduce = np.max if source.over_axles == "greatest" else np.sum
            values = reduce(values, axis=1)
        table[name] = np.asarray(values, dtype=float)
    return table


def _for_the_fastest(campaign: CampaignFile, scenario: Scenario) -> Scenario:
    """Cells of the rail must suit the fastest run: it decides how the plan is laid out."""
    for variable in campaign.variable:
        if variable.quantity == "run.speed" and variable.apply == "value":
            fastest = float(variable.distribution.ppf(np.array([FASTEST]))[0])
            if fastest > scenario.run.speed:
                return scenario.with_({"run.speed": min(fastest, 600 / 3.6)})
    return scenario


def _checked(scenario: Scenario) -> Scenario:
    """Return a scenario checked anew, with a sentence that says that it was drawn."""
    try:
        return Scenario.model_validate(scenario.model_dump(exclude_unset=True, warnings=False))
    except RailgripError as error:
        raise RailgripError(
            [Problem(p.where, f"as drawn, {p.what}", p.got, p.allowed) for p in error.problems]
        ) from None


def _plain(draws: Draws) -> Table:
    return {
        name: values.astype(str).astype(object) if values.dtype.kind in "OU" else values
        for name, values in draws.items()
    }


def _missing(dtype: Any, runs: int) -> Values:
    if dtype.kind == "f":
        return np.full(runs, np.nan)
    return np.zeros(runs, dtype=dtype)
