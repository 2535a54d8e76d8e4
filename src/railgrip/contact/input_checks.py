"""Refusals that the Python-facing functions of the contact share."""

import math

from railgrip.core.errors import Problem, RailgripError


def refuse_not_positive(quantities: tuple[tuple[str, float, str], ...]) -> None:
    """Refuse the first quantity that is not positive and finite.

    Parameters
    ----------
    quantities : tuple of (name, value, unit)
        What a sentence calls it, the number, and the unit of the number.

    Raises
    ------
    RailgripError
        "the load must be positive and finite; got -1000 N".

    Examples
    --------
    >>> refuse_not_positive((("load", 100e3, "N"),))
    """
    for name, value, unit in quantities:
        if not 0.0 < value < math.inf:
            got = f"{value:g} {unit}"
            raise RailgripError(Problem("", f"the {name} must be positive and finite", got=got))


def refuse_poisson(poisson: float) -> None:
    """Refuse a Poisson's ratio that no elastic body has.

    Parameters
    ----------
    poisson : float
        Poisson's ratio [-].

    Raises
    ------
    RailgripError
        "Poisson's ratio out of range; got 0.6; allowed: -1 < ratio <= 0.5".

    Examples
    --------
    >>> refuse_poisson(0.3)
    """
    if not -1.0 < poisson <= 0.5:
        raise RailgripError(
            Problem(
                "", "Poisson's ratio out of range", got=f"{poisson:g}", allowed="-1 < ratio <= 0.5"
            )
        )
