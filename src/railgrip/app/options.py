"""Options that several commands share, spelt the same everywhere."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

Json = Annotated[bool, Parameter(name="--json")]
Changes = Annotated[list[str] | None, Parameter(name="--set", consume_multiple=True)]
