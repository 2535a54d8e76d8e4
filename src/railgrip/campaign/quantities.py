"""What the scenario says of a quantity that is drawn: its range and its unit."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from railgrip.core.errors import Problem, RailgripError
from railgrip.scenario import Scenario
from railgrip.scenario.conversion import conversion, round15, split
from railgrip.scenario.model_walk import metadata
from railgrip.scenario.places import Place
from railgrip.scenario.quantity import Unit
from railgrip.scenario.units import RATIO

_LEVELS = ("mean", "low", "mode", "high")
_DIFFERENCE = "deviation"
_COMPARE = {"gt": np.greater, "ge": np.greater_equal, "lt": np.less, "le": np.less_equal}
_SAID = {"gt": "more than", "ge": "at least", "lt": "less than", "le": "at most"}


def facts_of(scenario: Scenario, place: Place) -> list[Any]:
    """Return the bounds and the unit of the field at a place; none where a name is free."""
    owner: Any = scenario
    steps: tuple[Any, ...] = place.steps[:-1]
    for step in steps:
        owner = owner[step] if isinstance(owner, (tuple, dict)) else getattr(owner, str(step))
    fields: Any = getattr(type(owner), "model_fields", {})
    field = fields.get(place.steps[-1])
    return [] if field is None else list(metadata(field))


def unit_of(scenario: Scenario, place: Place) -> Unit | None:
    """Return the unit of the field at a place."""
    return next((one for one in facts_of(scenario, place) if isinstance(one, Unit)), None)


def in_range(scenario: Scenario, place: Place, value: Any) -> Any:
    """Return which of the values are numbers that the scenario allows at a place."""
    if value.dtype.kind not in "fi":
        return np.ones(len(value), dtype=bool)
    kept = np.isfinite(value)
    for name, limit in _bounds(scenario, place):
        kept &= _COMPARE[name](value, limit)
    return kept


def allowed(scenario: Scenario, place: Place) -> str:
    """Return the range of a place in words, ``at least 0 km/h and at most 600 km/h``."""
    unit = unit_of(scenario, place) or RATIO
    said = (f"{_SAID[name]} {unit.show(limit)}" for name, limit in _bounds(scenario, place))
    return " and ".join(said)


def spoken(scenario: Scenario, place: Place, low: float, high: float) -> str:
    """Return two numbers of a place in its unit, ``36 km/h to 72 km/h``."""
    unit = unit_of(scenario, place) or RATIO
    return f"{unit.show(float(low))} to {unit.show(float(high))}"


def _bounds(scenario: Scenario, place: Place) -> Iterator[tuple[str, Any]]:
    for fact in facts_of(scenario, place):
        for name in _COMPARE:
            limit = getattr(fact, name, None)
            if limit is not None:
                yield name, limit


def in_unit(table: Any, unit: Unit, where: str, is_difference: bool) -> Any:
    """Return a distribution's table with its texts as numbers in the unit of its quantity.

    So ``"20 degC"`` and ``"293.15 K"`` are the same temperature, and a deviation of ``"5 K"`` is
    five degrees. A number is in that unit already.

    Raises
    ------
    RailgripError
        ``variable[0].distribution.mean: has a unit that does not fit; got '80 kg'; allowed: …``

    Examples
    --------
    >>> in_unit({"kind": "normal", "mean": "36 km/h", "deviation": 0.5}, Unit("m/s", "", 1, ""),
    ...         "", False)
    {'kind': 'normal', 'mean': 10.0, 'deviation': 0.5}
    """
    if isinstance(table, (list, tuple)):
        return [
            in_unit(one, unit, f"{where}[{i}]", is_difference)
            if isinstance(one, dict)
            else number_in(one, unit, f"{where}[{i}]", is_difference)
            for i, one in enumerate(table)
        ]
    read = {}
    for key, value in table.items():
        at = f"{where}.{key}"
        if key in _LEVELS:
            value = number_in(value, unit, at, is_difference)
        elif key == _DIFFERENCE:
            value = number_in(value, unit, at, True)
        elif isinstance(value, dict) or key in ("parts", "values"):
            value = in_unit(value, unit, at, is_difference)
        read[key] = value
    return read


def number_in(value: Any, unit: Unit, where: str, is_difference: bool) -> Any:
    """Return a text with a unit as a number in another unit; anything else as it is."""
    parts = split(value) if isinstance(value, str) else None
    if parts is None or not parts[1]:
        return value  # a number, a name, or what is refused later
    number, given = parts
    scale = conversion(given, unit.si)
    if scale is None:
        raise RailgripError(
            Problem(where, "has a unit that does not fit", f"'{value}'",
                    f"a number in {unit.si or '1'}, or a text such as '{unit.example}'")
        )  # fmt: skip
    return round15(number * scale[0] + (0.0 if is_difference else scale[1]))
