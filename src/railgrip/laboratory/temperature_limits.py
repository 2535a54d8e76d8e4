"""Temperatures that wheel and rail steel should not pass, and which of them a contact passes."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

from railgrip.core.errors import Problem, RailgripError


class TemperatureLimit(NamedTuple):
    """A temperature with a consequence.

    Parameters
    ----------
    name : str
        What it is.
    temperature : float
        From which it threatens [°C].
    consequence : str
        What happens above it.
    source : str
        Where the number comes from, and whether it was confirmed.
    """

    name: str
    temperature: float
    consequence: str
    source: str


class PassedLimit(NamedTuple):
    """A limit that was passed, and by how much.

    Parameters
    ----------
    limit : TemperatureLimit
        Which.
    excess : float
        Temperature above it, ≥ 0 [K].
    """

    limit: TemperatureLimit
    excess: float

    def __str__(self) -> str:
        return (
            f"{self.limit.name} ({self.limit.temperature:.0f} °C) passed by {self.excess:.0f} K: "
            f"{self.limit.consequence}"
        )


STEEL_LIMITS = (
    TemperatureLimit(
        "softening",
        500.0,
        "a work-hardened tread loses its hardness",
        "Cvetkovski, about 500 °C",
    ),
    TemperatureLimit(
        "eutectoid A1",
        723.0,
        "austenite begins to form; it turns into martensite when the rail or the wheel chills it",
        "723 … 727 °C, recalled from the literature, not confirmed",
    ),
    TemperatureLimit(
        "short-time austenitisation",
        850.0,
        "martensite (a white etching layer) within milliseconds of contact",
        "about 850 °C, recalled from the literature, not confirmed",
    ),
)
"""Starting values for plain carbon steel; replace them by those of your steel."""


def passed_limits(
    temperature: float, limits: Iterable[TemperatureLimit] = STEEL_LIMITS
) -> list[PassedLimit]:
    """Limits that a temperature passes, the lowest first.

    Choose it as a warning, not as a proof: whether martensite forms depends on how long the steel
    is hot, how fast it cools, and on its pressure and carbon.

    Parameters
    ----------
    temperature : float
        Greatest temperature of a surface: bulk, touch and flash together [°C].
    limits : iterable of TemperatureLimit
        In any order.

    Returns
    -------
    list of PassedLimit
        Empty when none is reached.

    Raises
    ------
    RailgripError
        "the temperature is not a number" or "the limit is not a number".

    References
    ----------
    .. [1] R. Müller et al., Wear (2016): austenitisation simulated, its use in traction and brake
       control recommended.
    .. [2] I. Pal et al. (2012): white etching layers of skid marks, 884 HV, 230 … 310 µm deep.

    Examples
    --------
    >>> for passed in passed_limits(760.0):
    ...     print(passed.limit.name, round(passed.excess))
    softening 260
    eutectoid A1 37
    """
    if math.isnan(temperature):
        raise RailgripError(Problem("temperature", "the temperature is not a number"))
    known = sorted(limits, key=lambda limit: limit.temperature)
    for limit in known:
        if math.isnan(limit.temperature):
            raise RailgripError(Problem(f"limit '{limit.name}'", "the limit is not a number"))
    return [
        PassedLimit(limit, temperature - limit.temperature)
        for limit in known
        if temperature >= limit.temperature
    ]
