"""Runs side by side: the same figures in one table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from railgrip.core.errors import RailgripError
from railgrip.engine.result import Result
from railgrip.engine.simulate import simulate
from railgrip.report.metrics import metrics
from railgrip.scenario.scenario import Scenario


@dataclass(frozen=True)
class Comparison:
    """Results by name; printed as a table.

    Attributes
    ----------
    results : dict of Result
        In the order in which they were given.
    """

    results: dict[str, Result]

    def table(self) -> list[list[str]]:
        """Return the rows of the table, the names first."""
        of_run = [{metric.name: metric for metric in metrics(r)} for r in self.results.values()]
        rows = [["", *self.results]]
        for name, metric in of_run[0].items():
            texts = [known[name].text if name in known else "" for known in of_run]
            rows.append([metric.label, *texts])
        return rows

    def differences(self, reference: str | None = None) -> list[str]:
        """Return a sentence for each run on how it differs from one of them, else the first."""
        from railgrip.report.differences import differences

        figures = {name: metrics(result) for name, result in self.results.items()}
        return differences(figures, next(iter(figures)) if reference is None else reference)

    def write(self, path: str | Path) -> Path:
        """Write the page on which each run can be looked at with the others behind it."""
        from railgrip.report.comparison_page import write_comparison

        return write_comparison(self.results, path)

    def __str__(self) -> str:
        rows = self.table()
        widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
        lines = [
            "  ".join(
                cell.ljust(width) if i == 0 else cell.rjust(width)
                for i, (cell, width) in enumerate(zip(row, widths, strict=True))
            ).rstrip()
            for row in rows
        ]
        return "\n".join(lines)


def compare(runs: Mapping[str, Any] | Iterable[Any]) -> Comparison:
    """Run scenarios and lay their figures side by side.

    Parameters
    ----------
    runs : mapping or iterable
        Scenarios, or results that are there already; names are the keys, else the titles.

    Returns
    -------
    Comparison
        Prints as a table; ``.results`` holds the results by name.

    Raises
    ------
    RailgripError
        "there is nothing to compare".

    Examples
    --------
    >>> import railgrip as rg
    >>> leaves = rg.load("leaves_160")
    >>> unprotected = leaves.with_({"wsp.controller": "none"})
    >>> both = rg.compare({"protected": leaves, "unprotected": unprotected})
    >>> list(both.results)
    ['protected', 'unprotected']
    """
    named = dict(runs) if isinstance(runs, Mapping) else _by_title(runs)
    if not named:
        raise RailgripError("there is nothing to compare; try: rg.compare([scenario, another])")
    return Comparison(
        {name: simulate(run) if isinstance(run, Scenario) else run for name, run in named.items()}
    )


def _by_title(runs: Iterable[Any]) -> dict[str, Any]:
    named: dict[str, Any] = {}
    for i, run in enumerate(runs):
        scenario = run if isinstance(run, Scenario) else run.scenario
        title = scenario.title or f"run {i + 1}"
        named[title if title not in named else f"{title} ({i + 1})"] = run
    return named
