"""Cases for the ETCS supervision as TOML."""

from __future__ import annotations

import os

from pydantic import ValidationError

from railgrip.core.errors import RailgripError
from railgrip.io.toml_file import read_toml
from railgrip.scenario.explain import problems_of
from railgrip.scenario.supervision import SupervisionCase


def read_supervision(path: str | os.PathLike[str]) -> SupervisionCase:
    """Return the checked case that a TOML file holds.

    Parameters
    ----------
    path : path
        The file; `docs/howto/etcs.md` has one to begin with.

    Raises
    ------
    RailgripError
        Every problem at once, with key paths: ``train.service_time: is missing; try: …``
    """
    table = read_toml(path)
    try:
        return SupervisionCase.model_validate(table)
    except ValidationError as error:
        raise RailgripError(problems_of(error, SupervisionCase)) from None
