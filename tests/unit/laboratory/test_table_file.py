"""Creep tables in files: the same bits back, and a sentence for whatever is none."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import rolling_contact
from railgrip.core.errors import RailgripError
from railgrip.laboratory.creep_table import CreepTable
from railgrip.laboratory.table_file import open_table, save_table
from railgrip.laboratory.tabulate import tabulate

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
RAIL = RailFriction(0.3, 0.4, 0.2, 0.8, 0.6)


@pytest.fixture(scope="module")
def table() -> CreepTable:
    return tabulate("polach_2005", BASE, RAIL, lateral=0.002, cells=16, curves=3)


def test_the_same_bits_back(table: CreepTable, tmp_path: Path) -> None:
    found = open_table(save_table(table, tmp_path / "polach.npz"))
    assert found._replace(curves=table.curves) == table
    assert found.curves.tobytes() == table.curves.tobytes()
    assert found.force(9e4, RAIL, 20.0, 0.01) == table.force(9e4, RAIL, 20.0, 0.01)
    assert [each.name for each in tmp_path.iterdir()] == ["polach.npz"]


def test_another_version_is_refused(table: CreepTable, tmp_path: Path) -> None:
    file = save_table(table, tmp_path / "polach.npz")
    with np.load(file) as held:
        fields = {**held, "version": 2}
    np.savez(file, **fields)
    with pytest.raises(RailgripError, match="is a creep table of another version; got 2; allowed"):
        open_table(file)


def test_what_is_no_table_is_refused(table: CreepTable, tmp_path: Path) -> None:
    good = save_table(table, tmp_path / "polach.npz").read_bytes()
    with np.load(tmp_path / "polach.npz") as held:
        fields = dict(held)
    text, cut, empty = (tmp_path / name for name in ("text.npz", "cut.npz", "empty.npz"))
    text.write_text("creepage, force")
    cut.write_bytes(good[: len(good) // 2])
    empty.write_bytes(b"")
    other, less, holed = (tmp_path / name for name in ("other.npz", "less.npz", "holed.npz"))
    np.savez(other, force=np.zeros(3))
    np.savez(less, **{name: each for name, each in fields.items() if name != "axis"})
    np.savez(holed, **{**fields, "curves": np.full((3, 18), math.nan)})
    for file in (text, cut, empty, other, less, holed):
        with pytest.raises(RailgripError, match=f"{file.name}: is no creep table of railgrip"):
            open_table(file)
    with pytest.raises(RailgripError, match="there is no such file"):
        open_table(tmp_path / "gone.npz")
    with pytest.raises(RailgripError, match="cannot be written"):
        save_table(table, tmp_path / "gone" / "polach.npz")
