"""A controller out of a Python file: found by its shape, refused in a sentence."""

from __future__ import annotations

import importlib.util
import inspect
import sys
import traceback
from pathlib import Path
from types import ModuleType

from railgrip.core.errors import Problem, RailgripError


def load_controller_class(path: str | Path) -> type:
    """Return the controller class that a Python file defines.

    The file is executed: load only files that you trust.

    Parameters
    ----------
    path : str or Path
        The file. It must define exactly one class with the methods ``reset`` and ``step``.

    Returns
    -------
    type
        The class.

    Raises
    ------
    RailgripError
        "my_wsp.py: no such file", "my_wsp.py: cannot be executed; got SyntaxError ... in line 3",
        "my_wsp.py: defines no controller ...", each with what to try.
    """
    path = Path(path)
    where = str(path)
    if path.suffix != ".py" or not path.is_file():
        what = "no such file" if path.suffix == ".py" else "is no Python file"
        raise RailgripError(Problem(where, what, cure="give the path of a .py controller"))
    module = _execute(path)
    found = _controllers_in(module)
    if not found:
        raise RailgripError(
            Problem(
                where,
                "defines no controller",
                got=_names(_classes_in(module)) or "no class",
                allowed="a class with the methods reset(setup) and step(state, measured, dt)",
            )
        )
    if len(found) > 1:
        raise RailgripError(
            Problem(where, "defines more than one controller", _names(found), "one class a file")
        )
    return found[0]


def _execute(path: Path) -> ModuleType:
    """Return the file as a module, or say in which line it fails."""
    name = f"railgrip_controller_{path.stem}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise RailgripError(Problem(str(path), "cannot be read as Python"))
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # so that pickling and dataclasses of the file work
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise RailgripError(
            Problem(str(path), "cannot be executed", got=describe_error(error, path))
        ) from None
    return module


def describe_error(error: BaseException, path: Path | None = None) -> str:
    """Return an error of somebody's code in one line, with the line of the file where known.

    Examples
    --------
    >>> describe_error(ZeroDivisionError("division by zero"))
    'ZeroDivisionError (division by zero)'
    """
    text = f"{type(error).__name__} ({error})".replace("\n", " ")
    if isinstance(error, SyntaxError):
        return f"{type(error).__name__} ({error.msg}) in line {error.lineno}"
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if path and Path(frame.filename) == path]
    return f"{text} in line {lines[-1]}" if lines else text


def _classes_in(module: ModuleType) -> list[type]:
    """Return the classes that the module itself defines."""
    members = inspect.getmembers(module, inspect.isclass)
    return [found for _, found in members if found.__module__ == module.__name__]


def _controllers_in(module: ModuleType) -> list[type]:
    """Return the classes of the module that have the shape of a controller."""
    return [
        found
        for found in _classes_in(module)
        if callable(getattr(found, "reset", None)) and callable(getattr(found, "step", None))
    ]


def _names(classes: list[type]) -> str:
    return ", ".join(found.__name__ for found in classes)
