"""Reads a journey from TOML."""

from __future__ import annotations

import os
from pathlib import Path

from railgrip.io.checked import checked
from railgrip.scenario.files import read_table
from railgrip.scenario.journey import Journey


def read_journey(path: str | os.PathLike[str]) -> Journey:
    """Return the journey of a TOML file.

    Parameters
    ----------
    path : str or path
        With ``train`` and ``line`` (names, files or tables), and what else `Journey` knows.

    Raises
    ------
    RailgripError
        ``commuter.toml: stop[2].at: lies off the line; got 40000 m; allowed: 0 to 29556.1 m``
    """
    file = Path(path)
    return checked(Journey, read_table(file), file)
