"""Own figures of each run: a function that turns the engine's tables of a batch into columns."""

from __future__ import annotations

import hashlib
import importlib.util
import inspect
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.plan import Outcome
from railgrip.engine.result import figures_of
from railgrip.scenario import Scenario

Collector = Callable[[Scenario, Outcome, int], dict[str, Any]]


def find_collector(word: str, drawn: Collection[str] = ()) -> Collector | None:
    """Return the collector that a name or ``file.py:function`` means, none for an empty word.

    A collector is called with a dictionary of arrays, (run,) or (run, axle), named as in the
    glossary, and returns a dictionary of arrays (run,) under names that are neither those of
    figures nor of columns that are `drawn`.

    Raises
    ------
    RailgripError
        ``collector: 'mine.py' holds no function 'energy'``; when called: ``'mine.py:energy' failed
        with KeyError…``, ``… must return one value for each run as 'energy'``
    """
    if not word:
        return None
    file, colon, name = word.rpartition(":")
    function = _from_file(Path(file), name) if colon else _installed(word)

    def collect(scenario: Scenario, out: Outcome, runs: int) -> dict[str, Any]:
        figures = figures_of(scenario, out)
        taken = {"run", *drawn, *figures}
        try:
            found = function(figures)
        except Exception as error:
            what = f"'{word}' failed with {type(error).__name__}: {error}"
            cure = f"figures there are: {', '.join(sorted(figures))}"
            is_missing = isinstance(error, KeyError)
            raise RailgripError(
                Problem("collector", what, cure=cure if is_missing else "")
            ) from error
        return _checked(word, found, runs, taken)

    return collect


def mark_of(word: str) -> str:
    """Return what tells a collector from another one of the same name: SHA-256 of its file.

    What that file imports in its turn is not looked at.
    """
    if not word:
        return ""
    file, colon, _ = word.rpartition(":")
    source = Path(file if colon else inspect.getsourcefile(_installed(word)) or "")
    return hashlib.sha256(source.read_bytes()).hexdigest() if source.is_file() else ""


def _installed(word: str) -> Any:
    return registry.resolve("railgrip.collectors", word, "collector")


def _checked(word: str, found: Any, runs: int, taken: set[str]) -> dict[str, Any]:
    """Return what a collector gave as columns; refuse what is not one number for each run."""
    if not isinstance(found, Mapping):
        what = f"'{word}' must return a dictionary of arrays"
        raise RailgripError(Problem("collector", what, got=type(found).__name__))
    columns: dict[str, Any] = {}
    for key, values in found.items():
        name = str(key)
        if name.casefold() in {one.casefold() for one in (*taken, *columns)}:
            what = f"'{word}' returns '{name}', which the campaign has already"
            cure = "give it another name; keep = [...] keeps figures as they are"
            raise RailgripError(Problem("collector", what, cure=cure))
        try:
            column = np.asarray(values)
        except ValueError:
            column = np.empty(0, dtype=object)
        if column.shape != (runs,):
            what = f"'{word}' must return one value for each run as '{name}'"
            raise RailgripError(Problem("collector", what, f"shape {column.shape}", f"({runs},)"))
        if column.dtype.kind not in "biuf":
            what = f"'{word}' must return numbers as '{name}'"
            raise RailgripError(Problem("collector", what, got=str(column.dtype)))
        columns[name] = column
    return columns


def _from_file(path: Path, name: str) -> Any:
    spec = importlib.util.spec_from_file_location(f"railgrip_collector_{path.stem}", path)
    if not path.is_file() or spec is None or spec.loader is None:
        raise RailgripError(Problem("collector", f"there is no file '{path}'"))
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        what = f"'{path.name}' cannot be loaded: {type(error).__name__}: {error}"
        raise RailgripError(Problem("collector", what)) from error
    function = getattr(module, name, None)
    if not callable(function):
        raise RailgripError(Problem("collector", f"'{path.name}' holds no function '{name}'"))
    return function
