"""One table laid over another: ``extends`` in files, `Scenario.with_` in Python."""

from __future__ import annotations

import re
from typing import Any

from railgrip.core.errors import Problem, RailgripError

Table = dict[str, Any]

# A table that becomes something else keeps nothing of what it was.
_DECIDING = {"law": None, "controller": "conventional"}
_STEP = re.compile(r"([^.\[\]]+)((?:\[\d{1,6}\])*)")


def merged(under: Table, over: Table) -> Table:
    """Return ``over`` laid on ``under``: tables merge deeply, lists and values replace.

    Examples
    --------
    >>> merged({"run": {"speed": 40.0, "seed": 1}}, {"run": {"speed": 30.0}})
    {'run': {'speed': 30.0, 'seed': 1}}
    """
    if any(key in over and over[key] != under.get(key, usual) for key, usual in _DECIDING.items()):
        return dict(over)
    # a controller for all replaces the units of a train, and units replace it
    if "unit" in over or ("controller" in over and "unit" in under):
        return dict(over)
    result = dict(under)
    for key, value in over.items():
        below = result.get(key)
        both = isinstance(below, dict) and isinstance(value, dict)
        result[key] = merged(below, value) if both else value  # type: ignore[arg-type]
    return result


def with_path(table: Table, path: str, value: Any) -> Table:
    """Return the table with the value at a dotted key laid over what is there.

    Examples
    --------
    >>> with_path({"vehicle": [{"tare": 1.0}, {"tare": 2.0}]}, "vehicle[1].tare", 3.0)
    {'vehicle': [{'tare': 1.0}, {'tare': 3.0}]}
    """
    steps: list[str | int] = []
    for part in path.split("."):
        match = _STEP.fullmatch(part)
        if match is None:
            raise RailgripError(Problem(path, "is no key path", allowed="e.g. train.vehicle[0]"))
        steps.append(match[1])
        steps.extend(int(index) for index in re.findall(r"\d+", match[2]))
    laid: Table = _with_steps(table, steps, value, path)
    return laid


def _with_steps(node: Any, steps: list[str | int], value: Any, path: str) -> Any:
    step, rest = steps[0], steps[1:]
    if isinstance(step, int):
        if not isinstance(node, (list, tuple)) or step >= len(node):
            raise RailgripError(Problem(path, f"there is no entry [{step}]"))
        items = list(node)
        items[step] = _with_steps(items[step], rest, value, path) if rest else value
        return items
    below = node if isinstance(node, dict) else {}
    if not rest:
        return merged(below, {step: value})
    return {**below, step: _with_steps(below.get(step), rest, value, path)}
