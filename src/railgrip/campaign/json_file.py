"""Notes beside results: one JSON table a file, whole or not there."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError


def write_json(path: Path, content: dict[str, Any]) -> None:
    """Write a table aside, flush it to the disk, then give it its name."""
    with write_aside(path) as aside:
        text = json.dumps(content, indent=1, ensure_ascii=False)
        with aside.open("w", encoding="utf-8") as file:
            file.write(text + "\n")
            file.flush()
            os.fsync(file.fileno())


def read_json(path: Path) -> dict[str, Any]:
    """Return the table of a file.

    Raises
    ------
    RailgripError
        ``out/dry/campaign.json: is damaged; got Expecting value: line 1 column 1 (char 0)``
    """
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise RailgripError(Problem(str(path), "is damaged", got=str(error)[:100])) from None
    if not isinstance(found, dict):
        raise RailgripError(Problem(str(path), "is damaged", got="no table"))
    return found
