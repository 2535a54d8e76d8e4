"""Any unit → SI. pint knows the units, and is imported when the first text with one is met."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Any

MOST_CHARACTERS = 80

_NUMBER_AND_UNIT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.S)
_EXPONENT = re.compile(r"(?:\^|\*\*)-?\d(?![\d^*.])")


def split(text: str) -> tuple[float, str] | None:
    """Return number and unit of a text, or None if it does not begin with a number.

    Examples
    --------
    >>> split("3.8 bar")
    (3.8, 'bar')
    """
    match = _NUMBER_AND_UNIT.fullmatch(text) if len(text) <= MOST_CHARACTERS else None
    return None if match is None else (float(match[1]), match[2])


def round15(number: float) -> float:
    """Round to 15 digits, so that 3.8 bar is 380000.0 and not its neighbour.

    Examples
    --------
    >>> round15(379999.99999999994)
    380000.0
    """
    return float(f"{number:.15g}")


@cache
def _registry() -> Any:
    import pint
    import platformdirs

    # pint reads its definitions ten times faster from its own cache; without one it works too.
    folder = Path(platformdirs.user_cache_dir("railgrip")) / "units"
    try:
        return pint.UnitRegistry(autoconvert_offset_to_baseunit=True, cache_folder=folder)
    except OSError:
        return pint.UnitRegistry(autoconvert_offset_to_baseunit=True)


@cache
def conversion(unit: str, target: str) -> tuple[float, float] | None:
    """Return factor and offset from a unit to the target, or None where it does not fit.

    Examples
    --------
    >>> conversion("bar", "Pa"), conversion("1/mm", "1/m")
    ((100000.0, 0.0), (1000.0, 0.0))
    """
    unit = f"1{unit}" if unit.startswith("/") else unit  # as in "0.5/m"
    if not _is_plain(unit):
        return None
    ureg = _registry()
    try:
        parsed, wanted = ureg.parse_units(unit), ureg.parse_units(target)
        zero = ureg.Quantity(0.0, parsed).to(wanted).magnitude
        one = ureg.Quantity(1.0, parsed).to(wanted).magnitude
    except Exception:  # pint raises many kinds, also from its tokenizer: all mean "no such unit"
        return None
    return (one - zero if zero else one), round15(zero)


def _is_plain(unit: str) -> bool:
    # pint evaluates what it parses: "m**9**9**9" would never come back.
    rest = _EXPONENT.sub("", unit.removeprefix("1/"))
    return len(unit) <= 40 and not re.search(r"[\d^]|\*\*|[^\w\s/*().·²³‰%°µμ^-]", rest)


def si_value(text: str) -> float | None:
    """Return a text with any unit in SI base units (but °C stays), or None if it is none.

    Examples
    --------
    >>> si_value("5 bar")
    500000.0
    """
    parts = split(text)
    if parts is None:
        return None
    number, unit = parts
    if not unit:
        return number
    scale = (1.0, 0.0) if unit in ("degC", "°C") else _to_base(unit)
    return None if scale is None else round15(number * scale[0] + scale[1])


@cache
def _to_base(unit: str) -> tuple[float, float] | None:
    if not _is_plain(unit):
        return None
    try:
        ureg = _registry()
        base = str(ureg.get_base_units(ureg.parse_units(unit))[1])
    except Exception:  # as above: whatever pint raises, the unit is not known
        return None
    return conversion(unit, "" if base == "dimensionless" else base)
