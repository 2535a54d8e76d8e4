"""What pydantic found, in the words of the person who wrote the file."""

from __future__ import annotations

import re
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from railgrip.core.errors import Problem, nearest, unknown_name
from railgrip.scenario import model_walk
from railgrip.scenario.files import printable
from railgrip.scenario.friction import PAD_LAWS
from railgrip.scenario.quantity import Unit

_MOST_PROBLEMS = 50
_TOO_MANY = 20_000
_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")

_WORDS = {
    "missing": "is missing",
    "bool_type": "must be true or false",
    "string_type": "must be a text",
    "model_type": "must be a table",
    "model_attributes_type": "must be a table",
    "dict_type": "must be a table",
    "tuple_type": "must be a list",
    "int_type": "must be a whole number",
    "int_parsing": "must be a whole number",
    "int_parsing_size": "must be a whole number of reasonable size",
    "int_from_float": "must be a whole number",
    "finite_number": "must be a finite number",
    "too_short": "must not be empty",
    "string_too_short": "must not be empty",
    "string_too_long": "is too long",
    "string_pattern_mismatch": "must be a name of letters, digits, '_', '-' and '.'",
}


def problems_of(error: ValidationError, model: type[BaseModel], at: str = "") -> list[Problem]:
    """Return each error as a problem: key path, what, got, allowed, nearest known key."""
    if error.error_count() > _TOO_MANY:
        return [Problem(at, f"there are {error.error_count()} problems, too many to tell")]
    problems: list[Problem] = []
    for detail in error.errors(include_url=False):
        if not _is_echo(detail):
            problems.extend(_explained(detail, model, at))
    if len(problems) > _MOST_PROBLEMS:
        rest = len(problems) - _MOST_PROBLEMS
        problems = [*problems[:_MOST_PROBLEMS], Problem(at, f"and {rest} more problems")]
    return problems


def _is_echo(detail: ErrorDetails) -> bool:
    # A list is "too short" too when its entries are wrong, a default "not called" when what it
    # is taken from is wrong: each is told already.
    if detail["type"] == "too_short":
        return len(detail["input"]) >= int(detail["ctx"]["min_length"])
    return detail["type"] == "default_factory_not_called"


def _explained(detail: ErrorDetails, model: type[BaseModel], at: str) -> list[Problem]:
    kind, context = detail["type"], detail.get("ctx", {})
    where = joined(at, key_path(detail["loc"]))
    got = shown(detail["input"])
    owner, field = model_walk.place(model, detail["loc"])
    if kind == "railgrip_problems":
        return [
            Problem(joined(where, p.where), p.what, p.got, p.allowed, p.cure)
            for p in context["problems"]
        ]
    if kind == "railgrip":
        got = context.get("got", got)
        return [Problem(where, context["what"], got, context.get("allowed", ""))]
    if kind == "extra_forbidden":
        return [_unknown_key(where, str(detail["loc"][-1]), owner)]
    if kind in ("literal_error", "union_tag_invalid"):
        return [_unknown_word(where, detail, context)]
    if kind in ("greater_than", "greater_than_equal", "less_than", "less_than_equal"):
        return [_out_of_range(where, detail, field)]
    if kind == "too_short" and context["min_length"] > 1:
        return [Problem(where, f"must have at least {context['min_length']} entries", got)]
    if kind == "union_tag_not_found":
        return [Problem(where, f"has no {context['discriminator']}", got)]
    if kind == "missing":
        return [Problem(where, _WORDS[kind])]
    if kind == "too_long":
        return [Problem(where, "has too many entries", allowed=f"up to {context['max_length']}")]
    return [Problem(where, _WORDS.get(kind, detail["msg"]), got)]


def key_path(loc: tuple[int | str, ...]) -> str:
    """Return a place as it would be written in TOML, entries counted from 0.

    Examples
    --------
    >>> key_path(("train", "vehicle", 1, "tare"))
    'train.vehicle[1].tare'
    """
    path, before = "", ""
    for part in loc:
        if isinstance(part, int):
            path += f"[{part}]"
        elif not (part in PAD_LAWS and before == "pad") and part != "[key]":
            path = joined(path, part if _BARE_KEY.fullmatch(part) else shown(part, '"'))
        before = str(part)
    return path


def joined(at: str, path: str) -> str:
    """Return a key path below another."""
    return f"{at}.{path}" if at and path and not path.startswith("[") else at + path


def shown(value: Any, quote: str = "'") -> str:
    """Return a value as it can be printed: short, one line, whatever it is."""
    if isinstance(value, str):
        return f"{quote}{printable(value)}{quote}"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and abs(value) >= 10**30:
        return "a whole number of more than 30 digits"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, (list, tuple)):
        return f"a list of {len(value)}"
    return f"{value}"[:60]


def _unknown_key(where: str, key: str, owner: type[BaseModel] | None) -> Problem:
    known = [] if owner is None else [field.alias or n for n, field in owner.model_fields.items()]
    guess = nearest(key[:60], known)
    return Problem(
        where,
        "unknown key" + (f"; did you mean '{guess}'?" if guess else ""),
        allowed=", ".join(sorted(known)),
    )


def _unknown_word(where: str, detail: ErrorDetails, context: dict[str, Any]) -> Problem:
    known = re.findall(r"'([^']+)'", context.get("expected") or context.get("expected_tags", ""))
    value = detail["input"]
    if detail["type"] == "union_tag_invalid":
        where, value = joined(where, context["discriminator"].strip("'")), context["tag"]
    if not isinstance(value, str):
        return Problem(where, "must be a name", shown(value), ", ".join(known))
    return unknown_name(where, where.rpartition(".")[2], printable(value), known)


_BOUNDS = (
    ("gt", "more than {}"),
    ("ge", "at least {}"),
    ("lt", "less than {}"),
    ("le", "at most {}"),
)


def _out_of_range(where: str, detail: ErrorDetails, field: FieldInfo | None) -> Problem:
    found = [] if field is None else list(model_walk.metadata(field))
    unit = next((entry for entry in found if isinstance(entry, Unit)), Unit("", "", 1.0, ""))
    value = detail["input"]
    text = unit.show(value) if isinstance(value, (int, float)) and abs(value) < 1e300 else ""
    bounds = [
        words.format(unit.show(getattr(entry, bound)))
        for bound, words in _BOUNDS
        for entry in found
        if getattr(entry, bound, None) is not None
    ]
    allowed = " and ".join(bounds)
    return Problem(where, "is out of range", text or shown(value), allowed)
