"""Scenarios as TOML: read, write, and the JSON Schema with which editors check them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.scenario import Line, RailCondition, Scenario, Train, library
from railgrip.scenario.files import (
    Table,
    anchored,
    check_depth,
    is_path,
    parse,
    printable,
    read_table,
)

_MODELS: dict[str, type[BaseModel]] = {
    "scenario": Scenario,
    "train": Train,
    "line": Line,
    "rail_condition": RailCondition,
}
_SCHEMA_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def read_toml(path: str | os.PathLike[str]) -> Table:
    """Return the table of a TOML file, its references to other files made absolute.

    Raises
    ------
    RailgripError
        ``run.toml: is not valid TOML: Invalid value (at line 3, column 9)``, or the file is
        missing, larger than 5 MB, not UTF-8, or nested too deeply.
    """
    return read_table(path)


def load(source: str | os.PathLike[str] | Mapping[str, Any] | Scenario) -> Scenario:
    """Return the complete, checked scenario that a source describes.

    Parameters
    ----------
    source : path, str, dict or Scenario
        A TOML file, the name of a shipped scenario, TOML text, or the table itself.

    Returns
    -------
    scenario : Scenario
        SI, every name and file resolved into what it stands for.

    Raises
    ------
    RailgripError
        Every problem at once, one a line, with key path. Entries of lists count from 0:
        ``train.vehicle[1].tare: is out of range; got -44000 kg; allowed: more than 0 kg …``

    Examples
    --------
    >>> load('train = "emu_four_car"\\nrun.speed = "36 km/h"').run.speed
    10.0
    """
    if isinstance(source, Scenario):
        return source
    if isinstance(source, Mapping):
        table = dict(source)
        check_depth(table)
        return Scenario.model_validate(table)
    if isinstance(source, str) and ("\n" in source or "=" in source):
        return Scenario.model_validate(anchored(parse(source), Path.cwd()))
    return Scenario.model_validate(library.fetch("scenario", _file_or_name(source)))


def _file_or_name(source: str | os.PathLike[str]) -> str:
    word = os.fspath(source)
    if not word:
        raise RailgripError("the name of the scenario is empty")
    if word in library.names("scenario"):
        return word
    if is_path(word) or not isinstance(source, str) or os.path.exists(word):
        return os.path.abspath(os.path.expanduser(word))
    problem = unknown_name("", "scenario", printable(word), library.names("scenario"))
    raise RailgripError(Problem("", f"{problem.what} (and there is no such file)"))


def dump_toml(scenario: Scenario) -> str:
    """Return a scenario as TOML that needs no other file and loads back to an equal scenario.

    Examples
    --------
    >>> scenario = load('train = "emu_four_car"')
    >>> load(dump_toml(scenario)) == scenario
    True
    """
    import tomli_w

    return tomli_w.dumps(_folded(scenario.model_dump(by_alias=True, exclude_none=True)))


def _folded(value: Any) -> Any:
    """Return the tree with equal neighbours in lists written once, with their ``count``."""
    if isinstance(value, dict):
        return {key: _folded(item) for key, item in value.items()}
    if not isinstance(value, (list, tuple)):
        return value
    folded: list[Any] = []
    for item in map(_folded, value):
        if isinstance(item, dict) and "count" in item:
            before = folded[-1] if folded else None
            if before is not None and {**before, "count": 1} == item:
                before["count"] += 1
                continue
        folded.append(item)
    return folded


def schema(kind: str = "scenario") -> dict[str, Any]:
    """Return the JSON Schema of a file, for editors (``#:schema`` in the first line).

    Parameters
    ----------
    kind : str
        ``scenario``, ``train``, ``line`` or ``rail_condition``.

    Raises
    ------
    RailgripError
        ``kind of file 'trian' unknown; known: …; did you mean 'train'?``

    Examples
    --------
    >>> schema("line")["properties"]["length"]["examples"]
    ['1.2 km']
    """
    if kind not in _MODELS:
        raise RailgripError(unknown_name("", "kind of file", kind, _MODELS))
    found = _MODELS[kind].model_json_schema(by_alias=True)
    extends = {
        "type": "string",
        "description": "Another file or a shipped name that this one is laid over.",
    }
    properties = {"extends": extends, **found.pop("properties")}
    # What a file leaves out may stand in the one it extends.
    found.pop("required", None)
    return {"$schema": _SCHEMA_DIALECT, **_telling_units({**found, "properties": properties})}


def _telling_units(node: Any) -> Any:
    """Return the schema with the unit of each quantity told in its description."""
    if isinstance(node, list):
        return [_telling_units(item) for item in node]
    if not isinstance(node, dict):
        return node
    told = {key: _telling_units(item) for key, item in node.items()}
    units = [item["unit"] for item in (node, *node.get("anyOf", ())) if "unit" in item]
    if units and isinstance(told.get("description"), str):
        told["description"] += f" [{units[0]}, or a text with a unit]"
    return told
