"""Tables of runs in Parquet files, each with the check sums of its columns in its footer."""

from __future__ import annotations

import json
import os
import re
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from railgrip.core.errors import Problem, RailgripError

Columns = dict[str, Any]


def connect(path: Path | None = None) -> Any:
    """Return a DuckDB connection; refuse kindly where DuckDB is not installed."""
    try:
        import duckdb
    except ImportError:
        cure = "pip install 'railgrip[campaign]'"
        raise RailgripError(Problem("", "duckdb is not installed", cure=cure)) from None
    # one thread: the same rows give the same bytes
    return duckdb.connect(":memory:" if path is None else str(path), config={"threads": 1})


def quoted(path: Path) -> str:
    """Return a path as it can stand between SQL's quotes."""
    return str(path).replace("'", "''")


def listed(paths: Sequence[Path]) -> str:
    """Return files as SQL names a list of them."""
    files = (f"'{quoted(path)}'" for path in paths)
    return f"[{', '.join(files)}]"


def reason(error: Exception) -> str:
    """Return why DuckDB failed, in a few words.

    Examples
    --------
    >>> reason(OSError('IO Error: {"message":"x: No space left on device","errno":"28"}'))
    'No space left on device'
    >>> reason(OSError('IO Error: Could not write file "x.duckdb": Read-only file system'))
    'Read-only file system'
    """
    text = " ".join(str(error).split())
    number = re.search(r'"errno":\s*"(\d+)"', text)
    if number:
        return os.strerror(int(number[1]))
    told = re.search(r'Could not write file "[^"]*": ([^"]+)$', text)
    return told[1] if told else text[:200]


def write_table(table: Columns, path: Path) -> None:
    """Write columns of equal length and flush them to the disk; the same table, the same bytes.

    Raises
    ------
    Exception
        Whatever DuckDB or the disk says; see `reason`.
    """
    columns = {name: _storable(values) for name, values in table.items()}
    sums = json.dumps(check_sums(columns)).replace("'", "''")
    with connect() as connection:
        connection.register("columns", columns)
        connection.execute(
            f"COPY (SELECT * FROM columns) TO '{quoted(path)}' "
            f"(FORMAT parquet, USE_TMP_FILE false, KV_METADATA {{check_sums: '{sums}'}})"
        )
    with path.open("rb+") as file:
        os.fsync(file.fileno())


def read_table(paths: Sequence[Path], names: Sequence[str] | None = None) -> Columns:
    """Return columns over all files, ordered by run.

    Raises
    ------
    Exception
        Whatever DuckDB says of files that are no tables; see `reason`.
    """
    chosen = "*" if names is None else ", ".join(f'"{name}"' for name in names)
    with connect() as connection:
        query = f"SELECT {chosen} FROM read_parquet({listed(paths)}) ORDER BY run"
        found = connection.execute(query).fetchnumpy()
    return {
        name: np.ma.filled(values, np.nan) if np.ma.isMaskedArray(values) else values
        for name, values in found.items()
    }


def is_sound(path: Path) -> bool:
    """Whether a file holds what was once written into it, to the last bit."""
    try:
        with connect() as connection:
            query = f"SELECT value FROM parquet_kv_metadata('{quoted(path)}')"
            noted = json.loads(connection.execute(query).fetchone()[0])
        return bool(noted == check_sums(read_table([path])))
    except Exception:  # whatever a damaged file makes DuckDB raise
        return False


def check_sums(columns: Columns) -> dict[str, int]:
    """Return a CRC-32 of each column.

    Examples
    --------
    >>> check_sums({"run": np.arange(3)}) == check_sums({"run": np.array([0, 1, 3])})
    False
    """
    return {name: zlib.crc32(_bytes_of(values)) for name, values in columns.items()}


def _storable(values: Any) -> Any:
    values = np.ascontiguousarray(values)
    if values.dtype.kind == "f":  # one kind of NaN: a missing figure reads back as this one
        values = np.where(np.isnan(values), np.nan, values)
    return values


def _bytes_of(values: Any) -> bytes:
    if values.dtype.kind == "O":
        return "\n".join(map(str, values)).encode()
    return bytes(np.ascontiguousarray(values).tobytes())
