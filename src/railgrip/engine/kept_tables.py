"""Tables of slow laws, kept on disk beside the compiled kernels."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path

from railgrip.compiler import numba
from railgrip.core.errors import RailgripError
from railgrip.laboratory.creep_table import CreepTable
from railgrip.laboratory.table_file import open_table, save_table


def kept(key: tuple[object, ...], make: Callable[[], CreepTable]) -> CreepTable:
    """Return the table that was kept under a key; if none was, make it and keep it.

    The folder is bound to the sources of the package, so a table never outlives its law. Where
    nothing can be written, the table is made anew each time.

    Parameters
    ----------
    key : tuple
        All that the table depends on; numbers, texts and tuples of them.
    make : callable
        Makes the table.
    """
    name = hashlib.sha256(repr(key).encode()).hexdigest()[:16]
    file = Path(numba.config.CACHE_DIR) / "tables" / f"{name}.npz"
    try:
        return open_table(file)
    except RailgripError:
        table = make()
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        save_table(table, file)
    except (OSError, RailgripError):
        pass
    return table
