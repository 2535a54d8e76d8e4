"""Creep tables in files: an .npz of NumPy that says what it is."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import RollingContact
from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.creep_grid import GridAxis
from railgrip.laboratory.creep_table import CreepTable

KIND, VERSION = "railgrip creep table", 1


def save_table(table: CreepTable, path: str | os.PathLike[str]) -> Path:
    """Write a table, whole or not at all.

    Parameters
    ----------
    table : CreepTable
        From `tabulate`.
    path : path
        The file, by custom ``….npz``.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    RailgripError
        ``out/exact.npz: cannot be written; got No such file or directory``.

    Examples
    --------
    See `open_table`.
    """
    target = Path(path)
    with write_aside(target) as aside, aside.open("wb") as file:
        np.savez(
            file,
            kind=KIND,
            version=VERSION,
            law=table.law,
            contact=table.contact,
            rail=table.rail,
            crossing=(table.lateral, table.spin),
            axis=table.axis,
            curves=table.curves,
            reads_reduction=table.reads_reduction,
            error=table.error,
        )
    return target


def open_table(path: str | os.PathLike[str]) -> CreepTable:
    """Read a table that `save_table` wrote; the same bits.

    Parameters
    ----------
    path : path
        The file.

    Returns
    -------
    CreepTable

    Raises
    ------
    RailgripError
        ``exact.npz: there is no such file``; ``exact.npz: is no creep table of railgrip, or not a
        whole one``; ``exact.npz: is a creep table of another version; got 2; allowed: 1``.

    Examples
    --------
    >>> import math, tempfile
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> from railgrip.laboratory.tabulate import tabulate
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> table = tabulate("freibauer_1983", base, RailFriction(0.3, 1.0, 0.0, 1.0, 1.0), cells=64)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     found = open_table(save_table(table, Path(folder) / "freibauer.npz"))
    >>> found.law, bool((found.curves == table.curves).all())
    ('freibauer_1983', True)
    """
    file = Path(path)
    if not file.is_file():
        raise RailgripError(Problem(str(file), "there is no such file"))
    try:
        with np.load(file, allow_pickle=False) as held:
            fields = {name: held[name] for name in held.files}
        kind, version = str(fields["kind"]), int(fields["version"])
    except Exception:  # a zip file can be broken in many ways: all mean that it is no table
        raise _no_table(file) from None
    if kind != KIND:
        raise _no_table(file)
    if version != VERSION:
        what = "is a creep table of another version"
        raise RailgripError(
            Problem(str(file), what, got=str(version), allowed=str(VERSION), cure="tabulate again")
        )
    try:
        return _table(fields)
    except (KeyError, TypeError, ValueError):
        raise _no_table(file) from None


def _table(fields: dict[str, np.ndarray]) -> CreepTable:
    curves = fields["curves"]
    if curves.ndim != 2 or curves.shape[1] < 3 or not np.isfinite(curves).all():
        raise ValueError(curves.shape)
    lateral, spin = fields["crossing"].tolist()
    return CreepTable(
        str(fields["law"]),
        RollingContact(*fields["contact"].tolist()),
        RailFriction(*fields["rail"].tolist()),
        lateral,
        spin,
        GridAxis(*fields["axis"].tolist()),
        np.ascontiguousarray(curves, dtype=np.float64),
        bool(fields["reads_reduction"]),
        float(fields["error"]),
    )


def _no_table(file: Path) -> RailgripError:
    what = "is no creep table of railgrip, or not a whole one"
    return RailgripError(Problem(str(file), what, cure="tabulate the law again"))
