"""The units a brake engineer reads: km/h, bar, kN, kJ, normal litres, per cent."""

from __future__ import annotations

from typing import NamedTuple

from railgrip.core.signals import SIGNALS


class Shown(NamedTuple):
    """How a quantity is shown: shown value = `factor` times the SI value.

    Attributes
    ----------
    unit : str
        Unit as printed, empty for a plain number.
    factor : float
        Shown unit per SI unit.
    decimals : int
        Digits after the point that mean something; -1: written as a power of ten.
    """

    unit: str
    factor: float
    decimals: int


_BY_UNIT = {
    "m/s": Shown("km/h", 3.6, 1),
    "m/s^2": Shown("m/s²", 1.0, 2),
    "m": Shown("m", 1.0, 1),
    "s": Shown("s", 1.0, 2),
    "Pa": Shown("bar", 1e-5, 2),
    "N": Shown("kN", 1e-3, 1),
    "N m": Shown("kN m", 1e-3, 1),
    "J": Shown("kJ", 1e-3, 0),
    "J/m": Shown("kJ/m", 1e-3, 2),
    "kg/m": Shown("g/m", 1e3, 1),
    "m^3": Shown("Nl", 1e3, 0),
    "degC": Shown("°C", 1.0, 0),
    "K": Shown("K", 1.0, 0),
    "1": Shown("", 1.0, 3),
}
_PER_CENT = Shown("%", 100.0, 1)
_BY_NAME = {
    "adhesion_utilisation": _PER_CENT,
    "slide_activity": _PER_CENT,
    "axle_greatest_slip": _PER_CENT,
    "axle_greatest_spin": _PER_CENT,
    "drive_demand": _PER_CENT,
    "creepage": _PER_CENT,
    "cleaning": _PER_CENT,
    "brake_demand": _PER_CENT,
    "energy_balance": Shown("", 1.0, -1),
    "axle_flat_length": Shown("mm", 1e3, 1),
    "axle_valve_cycles": Shown("", 1.0, 0),
    "status": Shown("", 1.0, 0),
}


def shown(name: str) -> Shown:
    """Return how a signal of the catalogue is shown.

    Parameters
    ----------
    name : str
        A name of the signal catalogue.

    Returns
    -------
    Shown
        Unit, factor from SI, decimals.

    Examples
    --------
    >>> shown("train_speed")
    Shown(unit='km/h', factor=3.6, decimals=1)
    """
    if name in _BY_NAME:
        return _BY_NAME[name]
    unit = SIGNALS[name].unit
    return _BY_UNIT.get(unit, Shown(unit, 1.0, 3))


def written(value: float, how: Shown) -> str:
    """Return a shown value with its unit; a dash where there is none.

    Examples
    --------
    >>> written(159.96, shown("train_speed"))
    '160.0 km/h'
    """
    if value != value:
        return "–"
    number = f"{value:.1e}" if how.decimals < 0 else f"{value:.{how.decimals}f}"
    return f"{number} {how.unit}".rstrip()


def axis_label(words: str, unit: str) -> str:
    """Return an axis label in words with its unit behind a comma.

    Examples
    --------
    >>> axis_label("Speed", "km/h")
    'Speed, km/h'
    """
    return f"{words}, {unit}" if unit else words
