"""A campaign complete in itself: units read as the scenario reads them, samples written out."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from railgrip.campaign.campaign_parts import Until, Variable
from railgrip.campaign.distribution_kinds import Empirical
from railgrip.campaign.distributions import Mixture, Truncated
from railgrip.campaign.quantities import in_unit, number_in, unit_of
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.core.signals import SIGNALS
from railgrip.report.metrics import SOURCES
from railgrip.scenario import Scenario
from railgrip.scenario.explain import problems_of
from railgrip.scenario.files import read_text
from railgrip.scenario.places import find_places, spread_out
from railgrip.scenario.quantity import Unit
from railgrip.scenario.units import RATIO

_KIND_IN_PATH = re.compile(
    r"\b(distribution|of)\.(?:normal|lognormal|uniform|triangular|truncated|event|discrete|"
    r"empirical|mixture)\b"
)


def problems_in_file(error: ValidationError, model: type[BaseModel], at: str = "") -> list[Problem]:
    """Return problems with key paths as they stand in the file: no kind after ``distribution``."""
    found = problems_of(error, model, at)
    return [replace(one, where=_KIND_IN_PATH.sub(r"\1", one.where)) for one in found]


def in_their_units(
    scenario: Scenario, variables: Sequence[Variable], table: Sequence[dict[str, Any]]
) -> tuple[Variable, ...]:
    """Return the variables of a table, texts with a unit read as the scenario reads them.

    A quantity that only a design has is left as it is: its texts are SI.
    """
    spread = spread_out(scenario)
    return tuple(
        _in_its_unit(spread, variable, raw, f"variable[{i}]")
        for i, (variable, raw) in enumerate(zip(variables, table, strict=True))
    )


def _in_its_unit(spread: Scenario, variable: Variable, raw: Any, where: str) -> Variable:
    unit = RATIO
    if variable.apply != "factor":
        try:
            place = find_places(spread, variable.quantity, f"{where}.quantity")[0]
        except RailgripError:  # told when it is drawn, in the scenario that has it or has it not
            return variable
        found = unit_of(spread, place)
        if found is None:
            return variable
        unit = found
    given = raw["distribution"]
    read = in_unit(given, unit, f"{where}.distribution", variable.apply == "offset")
    if read == given:
        return variable
    try:
        return Variable.model_validate({**raw, "distribution": read})
    except ValidationError as error:
        raise RailgripError(problems_in_file(error, Variable, where)) from None


def until_in_its_unit(until: Until | None, raw: Any) -> Until | None:
    """Return a width and threshold, texts with a unit read in that of the figure."""
    if until is None or until.figure not in SOURCES or not isinstance(raw, dict):
        return until
    name = SIGNALS[SOURCES[until.figure].variable].unit
    unit = Unit("" if name == "1" else name, "", 1.0, f"5 {name}" if name != "1" else "5 %")
    is_share = until.statistic == "exceedance"
    read = {
        "threshold": number_in(raw.get("threshold"), unit, "until.threshold", False),
        "width": number_in(raw.get("width"), RATIO if is_share else unit, "until.width", True),
    }
    return until.model_copy(
        update={name: value for name, value in read.items() if isinstance(value, float)}
    )


def with_samples(variables: Sequence[Variable], folder: Path) -> tuple[Variable, ...]:
    """Return the variables with the values of the files that they name, from a folder on."""
    found = []
    for i, variable in enumerate(variables):
        written_out = _with_sample(variable.distribution, folder, f"variable[{i}].distribution")
        found.append(variable.model_copy(update={"distribution": written_out}))
    return tuple(found)


def _with_sample(distribution: Any, folder: Path, where: str) -> Any:
    """Return a distribution with the values of its files, also within others."""
    if isinstance(distribution, Empirical) and distribution.file:
        return read_sample(distribution, folder, where)
    if isinstance(distribution, Truncated):
        inner = _with_sample(distribution.of, folder, f"{where}.of")
        return distribution.model_copy(update={"of": inner})
    if isinstance(distribution, Mixture):
        parts = [
            part.model_copy(update={"of": _with_sample(part.of, folder, f"{where}.parts[{i}].of")})
            for i, part in enumerate(distribution.parts)
        ]
        return distribution.model_copy(update={"parts": tuple(parts)})
    return distribution


def read_sample(distribution: Empirical, folder: Path, where: str) -> Empirical:
    """Return the distribution with the values of its file, whose name begins in a folder."""
    lines = [line for line in read_text(folder / distribution.file).splitlines() if line.strip()]
    rows = [[cell.strip() for cell in line.split(",")] for line in lines if line[:1] != "#"]
    column = 0
    if distribution.column:
        if not rows or distribution.column not in rows[0]:
            heads = rows[0] if rows else []
            problem = unknown_name(f"{where}.column", "column", distribution.column, heads)
            raise RailgripError(problem)
        column, rows = rows[0].index(distribution.column), rows[1:]
    try:
        values = tuple(float(row[column]) for row in rows)
        return Empirical(values=values)
    except (ValueError, IndexError, ValidationError):
        what = f"'{distribution.file}' does not hold two or more numbers, one a line"
        raise RailgripError(Problem(f"{where}.file", what)) from None
