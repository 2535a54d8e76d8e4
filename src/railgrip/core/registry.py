"""Plug-ins by name: laws, controllers and readers, from this package or from anybody's.

A plug-in announces itself in its own ``pyproject.toml``, under an entry point group::

    [project.entry-points."railgrip.controllers"]
    my_wsp = "my_package.my_wsp:MyWSP"

Nothing is imported before it is asked for by name.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from railgrip.core.errors import Problem, RailgripError, unknown_name

GROUPS = {
    "railgrip.collectors": "collector",
    "railgrip.controllers": "controller",
    "railgrip.friction_laws": "friction law",
    "railgrip.laws": "law",
    "railgrip.readers": "reader",
    "railgrip.rolling_laws": "law of rolling contact",
    "railgrip.slow_rolling_laws": "law of rolling contact that needs a table",
}
"""Entry point group → the word that messages use for one of its members."""


@cache
def _entries(group: str) -> dict[str, EntryPoint]:
    if group not in GROUPS:
        raise RailgripError(unknown_name("", "plug-in group", group, GROUPS))
    return {entry.name: entry for entry in entry_points(group=group)}


def names(group: str) -> list[str]:
    """Return the names known in a plug-in group, sorted.

    Parameters
    ----------
    group : str
        A key of `GROUPS`.

    Raises
    ------
    RailgripError
        ``plug-in group 'railgrip.lawz' unknown; known: …``

    Examples
    --------
    >>> "polach_2005" in names("railgrip.laws")
    True
    """
    return sorted(_entries(group))


def group_of(name: str, groups: Sequence[str]) -> str:
    """Return the first of several groups in which a name is known; if none, the first group.

    Parameters
    ----------
    name : str
        Name under which a plug-in may be registered.
    groups : sequence of str
        Keys of `GROUPS`.

    Examples
    --------
    >>> group_of("fastsim_1982", ["railgrip.laws", "railgrip.rolling_laws"])
    'railgrip.rolling_laws'
    """
    return next((group for group in groups if name in _entries(group)), groups[0])


def resolve(group: str, name: str, where: str = "") -> Any:
    """Import and return the plug-in that bears this name.

    Parameters
    ----------
    group : str
        A key of `GROUPS`.
    name : str
        Name under which the plug-in is registered.
    where : str
        Key path of the name in the user's file, for the message.

    Raises
    ------
    RailgripError
        ``wsp.controller: controller 'conventionl' unknown; known: …; did you mean …?``,
        or the plug-in is registered and cannot be imported.

    Examples
    --------
    >>> resolve("railgrip.laws", "polach_2005").__name__
    'polach_2005'
    """
    known = _entries(group)
    if name not in known:
        raise RailgripError(unknown_name(where, GROUPS[group], name, known))
    try:
        return known[name].load()
    except (ImportError, AttributeError) as error:
        problem = Problem(
            where,
            f"{GROUPS[group]} '{name}' is registered as '{known[name].value}' and cannot be loaded",
            got=f"{type(error).__name__}: {error}",
            cure="mend or uninstall the package that registers it",
        )
        raise RailgripError(problem) from error
