"""Parameters of a controller that is put together from parts: one set, one array.

A kernel reads its parameters by place in a flat array. A part that reads the first places (the
ordinary WSP) works unchanged inside a larger controller when its fields come first there.
"""

from __future__ import annotations

from collections import namedtuple
from typing import Any


def joined(name: str, *parts: Any, **other: float) -> Any:
    """Return the NamedTuple class that has the fields and defaults of all parts, in their order.

    Parameters
    ----------
    name : str
        Name of the class.
    *parts : NamedTuple classes
        Every field with a default, no name twice; their docstrings describe the fields.
    **other : float
        Fields whose default here is another one than in their part.

    Examples
    --------
    >>> from typing import NamedTuple
    >>> class A(NamedTuple):
    ...     a: float = 1.0
    >>> class B(NamedTuple):
    ...     b: float = 2.0
    >>> joined("AB", A, B)()._replace(b=3.0)
    AB(a=1.0, b=3.0)
    >>> joined("AB", A, B, b=4.0)().b
    4.0
    """
    fields = [field for part in parts for field in part._fields]
    values = {name: value for part in parts for name, value in part._field_defaults.items()}
    defaults = [other.get(field, values[field]) for field in fields]
    made: Any = namedtuple(name, fields, defaults=defaults)  # type: ignore[misc]
    made.__doc__ = f"Fields of {', '.join(part.__name__ for part in parts)}, SI."
    return made
