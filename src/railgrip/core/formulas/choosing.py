"""A choice without a branch: both sides are there before it.

Compiled, ``a if c else b`` is a branch, and branches on like conditions are merged into one with
all that is loaded and stored on either side. In a loop over the axles that makes masked loads and
scattered stores. `choose` is one selection, whatever stands around it (`railgrip.compiler`).
"""


def choose(condition: bool, one: float, other: float) -> float:
    """Return `one` where the condition holds, else `other`.

    Examples
    --------
    >>> choose(2.0 > 1.0, 3.0, 4.0)
    3.0
    """
    return one if condition else other
