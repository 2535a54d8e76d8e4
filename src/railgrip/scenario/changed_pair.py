"""A wheel–rail pair with some of its numbers changed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from railgrip.core.errors import RailgripError
from railgrip.scenario.contact_pair import ContactPair
from railgrip.scenario.explain import problems_of


def changed_pair(pair: ContactPair, changes: Mapping[str, Any]) -> ContactPair:
    """Return a pair like the given one, with other numbers; checked as a file is.

    Parameters
    ----------
    pair : ContactPair
        What to begin with.
    changes : mapping of str
        Key path to text with unit or number in SI; None drops the key.

    Returns
    -------
    ContactPair
        Checked and frozen; its title says that it was changed.

    Raises
    ------
    RailgripError
        ``wheel.radius: is out of range; got 9 m; allowed: …``, and the cross checks of the pair.

    Examples
    --------
    >>> from railgrip.scenario.contact_pair import contact_pair
    >>> changed_pair(contact_pair("cone_on_head"), {"rail.head_radius": "200 mm"}).rail.head_radius
    0.2
    """
    table = pair.model_dump()
    for path, value in changes.items():
        *parents, key = path.split(".")
        place = table
        for parent in parents:
            place = place[parent]
        place[key] = value
    table["title"], table["source"] = f"{pair.title}, changed", ""
    try:
        return ContactPair.model_validate(table)
    except ValidationError as error:
        raise RailgripError(problems_of(error, ContactPair)) from None
