"""Own figures of each run: a function that turns the engine's tables of a batch into columns."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.plan import Outcome
from railgrip.engine.result import figures_of
from railgrip.scenario import Scenario

Collector = Callable[[Scenario, Outcome, int], dict[str, Any]]


def find_collector(word: str) -> Collector | None:
    """Return the collector that a name or ``file.py:function`` means, none for an empty word.

    A collector is called with a dictionary of arrays, (run,) or (run, axle), named as in the
    glossary, and returns a dictionary of arrays (run,).

    Raises
    ------
    RailgripError
        ``collector: 'mine.py' holds no function 'energy'``
    """
    if not word:
        return None
    file, colon, name = word.rpartition(":")
    if not colon:
        function = registry.resolve("railgrip.collectors", word, "collector")
    else:
        function = _from_file(Path(file), name)

    def collect(scenario: Scenario, out: Outcome, runs: int) -> dict[str, Any]:
        try:
            found = function(figures_of(scenario, out))
            columns = {str(key): np.asarray(column) for key, column in dict(found).items()}
        except Exception as error:
            what = f"'{word}' failed with {type(error).__name__}: {error}"
            raise RailgripError(Problem("collector", what)) from error
        for key, column in columns.items():
            if column.shape != (runs,):
                what = f"'{word}' must return one value for each run as '{key}'"
                raise RailgripError(
                    Problem("collector", what, f"shape {column.shape}", f"({runs},)")
                )
        return columns

    return collect


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
