"""A YAML document of railtoolkit: its kind and version are looked at first."""

from __future__ import annotations

from pathlib import Path
from typing import Any, NoReturn

from railgrip.core.errors import Problem, RailgripError
from railgrip.scenario.files import check_depth, read_text

_VERSIONS = {"rolling-stock": ("2022.05",), "running-path": ("2022.05", "2024.07")}


def document_of(file: Path, wanted: str) -> dict[str, Any]:
    """Return the table of a file, or refuse one of another kind or version."""
    import yaml

    try:
        document = yaml.safe_load(read_text(file))
    except yaml.YAMLError as error:
        reason = str(error).splitlines()[0]
        raise RailgripError(Problem(str(file), f"is not valid YAML: {reason}")) from None
    except (RecursionError, ValueError):
        raise RailgripError(Problem(str(file), "is not valid YAML")) from None
    if not isinstance(document, dict):
        refuse(file, "", "must hold a table")
    check_depth(document, str(file))
    schema = str(document.get("schema", ""))
    if f"/{wanted}.json" not in schema:
        refuse(file, "schema", f"is not that of a {wanted} file", got=repr(schema)[:80])
    if str(document.get("schema_version")) not in _VERSIONS[wanted]:
        refuse(
            file, "schema_version", "is none that can be read",
            got=repr(document.get("schema_version"))[:40], allowed=" and ".join(_VERSIONS[wanted]),
        )  # fmt: skip
    return document


def refuse(file: Path, where: str, what: str, **more: str) -> NoReturn:
    """Raise what is wrong at a place of a file."""
    raise RailgripError(Problem(f"{file}: {where}" if where else str(file), what, **more))
