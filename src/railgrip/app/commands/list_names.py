"""`railgrip list`: what is there to choose from."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from railgrip.app.options import Json
from railgrip.app.screen import print_json, print_table
from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError, unknown_name

SHIPPED = {
    "scenarios": "scenario",
    "trains": "train",
    "point-trains": "point_train",
    "lines": "line",
    "rail-conditions": "rail_condition",
    "contact-pairs": "contact_pair",
    "pads": "pad",
    "discs": "disc",
    "campaigns": "campaign",
}
PLUG_INS = {
    "controllers": "railgrip.controllers",
    "laws": "railgrip.laws",
    "rolling-laws": "railgrip.rolling_laws",
    "friction-laws": "railgrip.friction_laws",
    "readers": "railgrip.readers",
    "collectors": "railgrip.collectors",
}
KINDS = (*SHIPPED, *PLUG_INS)


def list_names(
    kind: Annotated[str | None, Parameter(help=f"One of: {', '.join(KINDS)}.")] = None,
    /,
    *,
    as_json: Json = False,
) -> int:
    """List trains, lines, rail conditions, controllers and whatever else has a name.

    Parameters
    ----------
    as_json
        Print one JSON object.
    """
    if kind is not None and kind.replace("_", "-") not in KINDS:
        raise RailgripError(unknown_name("list", "kind", kind, KINDS))
    kinds = KINDS if kind is None else (kind.replace("_", "-"),)
    found = {each: _titles(each) for each in kinds}
    if as_json:
        print_json(found)
        return 0
    for each, titles in found.items():
        print_table(each, ["name", "what it is"], titles.items(), to_the_right=False)
    return 0


def _titles(kind: str) -> dict[str, str]:
    if kind in PLUG_INS:
        group = PLUG_INS[kind]
        return {name: _first_line(group, name) for name in registry.names(group)}
    from railgrip.scenario import library

    shipped = SHIPPED[kind]
    return {name: _title(library.fetch(shipped, name)) for name in library.names(shipped)}


def _title(description: object) -> str:
    if isinstance(description, dict):
        return str(description.get("title", ""))
    return str(getattr(description, "title", ""))


def _first_line(group: str, name: str) -> str:
    try:
        doc = registry.resolve(group, name).__doc__ or ""
    except RailgripError as error:  # somebody's broken package must not hide all others
        broken: Problem = error.problems[0]
        return f"cannot be loaded: {broken.got}"
    return str(doc.strip().partition("\n")[0])
