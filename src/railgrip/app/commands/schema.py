"""`railgrip schema`: the JSON Schema that editors check files with."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from railgrip.app.screen import print_json


def schema(
    kind: Annotated[str, Parameter(help="scenario, train, line or rail_condition.")] = "scenario",
    /,
    *,
    as_json: Annotated[bool, Parameter(name="--json", show=False)] = False,
) -> int:
    """Print the JSON Schema of a kind of file.

    Save it and name it in the first line of your file, `#:schema scenario.schema.json`: editors
    with TOML support then complete keys and check values.
    """
    from railgrip.io import toml_file

    print_json(toml_file.schema(kind.replace("-", "_")))
    return 0
