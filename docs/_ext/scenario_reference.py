"""The scenario reference: one table for each model, from the JSON Schema."""

from __future__ import annotations

from typing import Any

from railgrip.io.toml_file import schema

Table = dict[str, Any]


def scenario_reference() -> str:
    """Return the tables as Markdown, in the order in which a reader of a file meets them."""
    whole = schema("scenario")
    parts: list[str] = ["## The file", "", *_table(whole)]
    waiting, done = _named(whole["properties"]), set[str]()
    while waiting:
        name = waiting.pop(0)
        if name in done:
            continue
        done.add(name)
        model = whole["$defs"][name]
        parts += [f"({_anchor(name)})=", f"## {name}", "", _words(model), "", *_table(model)]
        waiting = _named(model.get("properties", {})) + waiting
    return "\n".join([*parts, ""])


def _words(model: Table) -> str:
    return str(model.get("description", "")).partition("\n\n")[0].replace("\n", " ")


def _anchor(name: str) -> str:
    return f"scenario-{name.lower()}"


def _named(node: Any) -> list[str]:
    """Return the names of all models that a part of the schema points to."""
    if isinstance(node, dict):
        own = [node["$ref"].rpartition("/")[2]] if "$ref" in node else []
        return own + [name for value in node.values() for name in _named(value)]
    if isinstance(node, list):
        return [name for value in node for name in _named(value)]
    return []


def _table(model: Table) -> list[str]:
    rows = ["| key | value | if absent | meaning |", "|---|---|---|---|"]
    required = model.get("required", [])
    for key, entry in model.get("properties", {}).items():
        absent = "**needed**" if key in required else _default(entry)
        meaning = str(entry.get("description", "")).replace("|", r"\|").replace("\n", " ")
        rows.append(f"| `{key}` | {_value(entry)} | {absent} | {meaning} |")
    return [*rows, ""]


def _value(entry: Table) -> str:
    if "enum" in entry:
        return ", ".join(f"`{word}`" for word in entry["enum"])
    if "const" in entry:
        return f"`{entry['const']}`"
    if "$ref" in entry:
        name = entry["$ref"].rpartition("/")[2]
        return f"[{name}](#{_anchor(name)})"
    if entry.get("examples"):
        return f'`"{entry["examples"][0]}"`'
    choices = [one for one in entry.get("anyOf", entry.get("oneOf", [])) if one != {"type": "null"}]
    if choices:
        return " or ".join(dict.fromkeys(map(_choice, choices)))
    inner = entry.get("additionalProperties")
    if isinstance(inner, dict) and "$ref" in inner:
        return f"name = {_value(inner)}"
    kind = entry.get("type")
    if kind == "array":
        return f"list of {_value(entry.get('items', {}))}"
    words = {"string": "text", "integer": "whole number", "boolean": "true, false"}
    return words.get(str(kind), "table" if kind == "object" else "number")


def _choice(entry: Table) -> str:
    # Names of shipped things change from release to release: `railgrip list` tells them.
    return "name" if "enum" in entry else "file" if "pattern" in entry else _value(entry)


def _default(entry: Table) -> str:
    default = entry.get("default")
    if default in (None, "", [], {}) or isinstance(default, (dict, list)):
        return ""
    if isinstance(default, bool):
        return str(default).lower()
    if isinstance(default, float):
        return f"{default:.4g}"
    return f"`{default}`"
