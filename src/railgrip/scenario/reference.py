"""Fields that take a name: of shipped data (held as the whole model) or of a plug-in."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from pydantic_core import core_schema

from railgrip.core import registry
from railgrip.core.errors import RailgripError, unknown_name
from railgrip.scenario import library
from railgrip.scenario.base import refusal
from railgrip.scenario.files import printable

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue


class Reference(NamedTuple):
    """Marks a field whose text is looked up.

    Parameters
    ----------
    kind : str
        One of `library.FOLDERS`.
    """

    kind: str

    def look_up(self, value: Any) -> Any:
        """Return the table that a name, a file or a table with ``extends`` stands for."""
        try:
            if isinstance(value, str):
                return library.fetch(self.kind, value)
            if isinstance(value, dict) and "extends" in value:
                return library.inherited(self.kind, value)
        except RailgripError as error:
            # Where it went wrong is a place in another file, not a key below this one.
            raise refusal(
                [
                    replace(p, where="", what=f"{p.where}: {p.what}" if p.where else p.what)
                    for p in error.problems
                ]
            ) from None
        return value

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        """Look up first, then check what was found as if it stood there."""
        return core_schema.no_info_before_validator_function(self.look_up, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: core_schema.CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Editors offer the shipped names and allow any file or a table."""
        return {
            "anyOf": [
                {"enum": library.names(self.kind)},
                {"type": "string", "pattern": r"\.(toml|json)$"},
                handler(schema),
            ]
        }


class Plugin(NamedTuple):
    """Marks a field whose text names a plug-in, or a Python file that holds one.

    Parameters
    ----------
    group : str
        One of `registry.GROUPS`.
    word : str
        What messages call it.
    also : str
        A further name that is allowed.
    more_groups : tuple of str
        Further groups whose names are allowed.
    """

    group: str
    word: str
    also: str = ""
    more_groups: tuple[str, ...] = ()

    def check(self, value: Any) -> Any:
        """Refuse a name that nothing is registered under."""
        if not isinstance(value, str) or value.endswith(".py") or value == self.also:
            return value
        known = {
            name for group in (self.group, *self.more_groups) for name in registry.names(group)
        }
        if value not in known:
            names = known | {self.also} if self.also else known
            raise refusal([unknown_name("", self.word, printable(value), names)])
        return value

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        """Check the name, then the text as such."""
        return core_schema.no_info_before_validator_function(self.check, handler(source))
