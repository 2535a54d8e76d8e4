"""The unit of a field: reads numbers and texts, speaks in messages, tells editors."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from pydantic_core import PydanticCustomError, core_schema

from railgrip.scenario.conversion import conversion, round15, split

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue


class Unit(NamedTuple):
    """The unit a field is held in, and the one its messages speak in.

    Parameters
    ----------
    si : str
        Unit of the held number, as pint spells it.
    spoken : str
        Unit used in messages, e.g. km/h for speeds.
    factor : float
        Spoken number = held number × factor.
    example : str
        What a reader may write.

    Examples
    --------
    >>> Unit("m/s", "km/h", 3.6, "160 km/h").read("120 km/h")
    33.3333333333333
    """

    si: str
    spoken: str
    factor: float
    example: str

    def read(self, value: Any) -> float:
        """Return the value in SI; raise a pydantic error that says what is allowed."""
        if isinstance(value, str):
            number = self._read_text(value)
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            number = _as_float(value)
        else:
            raise self._refusal("must be a number or a text with a unit")
        if not math.isfinite(number):
            raise self._refusal("must be a finite number")
        return number

    def show(self, number: float) -> str:
        """Return an SI number in the spoken unit.

        Examples
        --------
        >>> Unit("m/s", "km/h", 3.6, "160 km/h").show(10.0)
        '36 km/h'
        """
        return f"{number * self.factor:.6g} {self.spoken}".rstrip()

    def _read_text(self, text: str) -> float:
        parts = split(text)
        if parts is None:
            raise self._refusal("must be a number followed by a unit")
        number, unit = parts
        if not unit:
            if self.si:
                raise self._refusal("has no unit")
            return number
        scale = conversion(unit, self.si)
        if scale is None:
            raise self._refusal(f"has a unit that is not known or does not fit: '{unit}'")
        return round15(number * scale[0] + scale[1])

    def _refusal(self, what: str) -> PydanticCustomError:
        allowed = f"a number in {self.si or '1'}, or a text such as '{self.example}'"
        return PydanticCustomError("railgrip", "{what}", {"what": what, "allowed": allowed})

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        """Read first, then check as a float, so that Field(gt=…) sees SI."""
        return core_schema.no_info_before_validator_function(self.read, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: core_schema.CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Editors may offer a number (SI) or a text with a unit."""
        number = handler(schema)
        number["type"] = ["number", "string"]
        number["examples"] = [self.example]
        number["unit"] = self.si or "1"
        return number


def _as_float(value: float) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf
