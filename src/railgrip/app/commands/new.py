"""`railgrip new`: a commented scenario to start from."""

from __future__ import annotations

import re
from importlib import resources
from pathlib import Path

from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError


def new(name: str, /) -> int:
    """Write a commented scenario NAME.toml to start from; never overwrites.

    Parameters
    ----------
    name
        Name of the new file, with or without .toml.
    """
    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    if not re.fullmatch(r"[\w.-]+", path.stem):
        what = "is no name for a scenario"
        raise RailgripError(Problem("new", what, got=f"'{name}'", allowed="letters, digits, _ . -"))
    if path.exists():
        raise RailgripError(Problem(str(path), "is there already", cure="another name"))
    text = template().replace("TITLE", path.stem.replace("_", " "))
    with write_aside(path) as aside:
        aside.write_text(text.replace("THIS_FILE", path.stem), encoding="utf-8")
    print(path)
    return 0


def template() -> str:
    """Return the commented scenario that every new file begins as."""
    file = resources.files("railgrip.app").joinpath("new_scenario.toml")
    return file.read_text(encoding="utf-8")
