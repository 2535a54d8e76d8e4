"""Plug-ins by name: laws, controllers and readers, from this package or from anybody's.

A plug-in announces itself in its own ``pyproject.toml``, under an entry point group::

    [project.entry-points."railgrip.controllers"]
    my_wsp = "my_package.my_wsp:MyWSP"

Nothing is imported before it is asked for by name.
"""

from __future__ import annotations

from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from railgrip.core.errors import Problem, RailgripError, unknown_name

GROUPS = {
    "railgrip.controllers": "controller",
    "railgrip.friction_laws": "friction law",
    "railgrip.laws": "law",
    "railgrip.readers": "reader",
    "railgrip.rolling_laws": "law of rolling contact",
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
