"""Columns of a measurement from CSV, Parquet, MDF4 or TDMS; only the wanted ones, read once."""

from __future__ import annotations

import os
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from railgrip.core.errors import Problem, RailgripError, nearest
from railgrip.io.measured.pad_channels import PadChannel, PadChannelMap
from railgrip.laboratory.inputs import FloatArray
from railgrip.scenario.files import printable

CHUNK = 200_000
"""Rows of a CSV file that are parsed at a time."""


class Column(NamedTuple):
    """One channel as it lies in the file.

    Attributes
    ----------
    time, values : ndarray (sample,)
        In the file's units; NaN where a cell is empty.
    unit : str
        As the file tells it; empty where it does not.
    """

    time: FloatArray
    values: FloatArray
    unit: str = ""


def read_columns(
    path: str | os.PathLike[str],
    channels: PadChannelMap,
    progress: Callable[[int], None] | None = None,
) -> dict[str, Column]:
    """Return the wanted channels of a file by the name of their signal.

    Parameters
    ----------
    path : path
        ``.csv``, ``.txt``, ``.parquet``, ``.mf4`` or ``.tdms``.
    channels : PadChannelMap
        Which ones.
    progress : callable, optional
        Told the number of rows read so far.

    Raises
    ------
    RailgripError
        ``stops.csv: has no column 'mu'; known: t, v``, with the nearest name; ``stops.mf4: asammdf
        is not installed; try: pip install 'railgrip[measured]'``

    Notes
    -----
    A CSV file is parsed in chunks of rows and never read again; of the others, only the wanted
    channels are read.
    """
    where = printable(str(path), 300)
    file = Path(path)
    readers = {".csv": _csv, ".txt": _csv, ".parquet": _parquet, ".mf4": _mdf, ".tdms": _tdms}
    reader = readers.get(file.suffix.lower())
    if reader is None:
        what = f"'{file.suffix}' is no format of measurements"
        raise RailgripError(Problem(where, what, allowed=", ".join(readers)))
    if not file.is_file():
        raise RailgripError(Problem(where, "there is no such file"))
    try:
        return reader(file, where, channels, progress or (lambda rows: None))
    except RailgripError:
        raise
    except (OSError, ValueError, KeyError) as error:
        raise RailgripError(Problem(where, "cannot be read", got=_short(error))) from None
    except Exception as error:  # the readers of measuring formats raise errors of their own
        raise RailgripError(Problem(where, "cannot be read", got=_short(error))) from None


def _short(error: Exception) -> str:
    return printable((" ".join(str(error).split()) or type(error).__name__)[:200])


def _library(name: str, where: str) -> Any:
    try:
        return import_module(name)
    except ImportError:
        cure = "pip install 'railgrip[measured]'"
        what = f"{name.partition('.')[0]} is not installed"
        raise RailgripError(Problem(where, what, cure=cure)) from None


def _refuse_missing(where: str, wanted: list[str], known: list[str]) -> None:
    problems = []
    for name in dict.fromkeys(wanted):
        if name not in known:
            told = ", ".join(printable(one) for one in known[:30])
            guess = nearest(name, known)
            hint = f"; did you mean '{printable(guess)}'?" if guess else ""
            what = f"has no channel '{printable(name)}'; known: {told}{hint}"
            problems.append(Problem(where, what))
    if problems:
        raise RailgripError(problems)


def _csv(file: Path, where: str, wanted: PadChannelMap, progress: Any) -> dict[str, Column]:
    import pandas as pd

    names = [wanted.time.column, *(channel.column for channel in wanted.channel)]
    parts: list[Any] = []
    with file.open("rb") as raw:
        for _ in range(wanted.skip_lines):
            raw.readline()
        header = raw.readline().decode("utf-8-sig", "replace").rstrip("\r\n")
        known = [cell.strip().strip('"') for cell in header.split(wanted.delimiter)]
        _refuse_missing(where, names, known)
        chunks = pd.read_csv(
            raw, sep=wanted.delimiter, decimal=wanted.decimal, chunksize=CHUNK, header=None,
            names=known, usecols=list(dict.fromkeys(names)), index_col=False, encoding="utf-8",
        )  # fmt: skip
        for chunk in chunks:
            parts.append(_numbers(chunk, names, where, sum(map(len, parts)) + wanted.skip_lines))
            progress(sum(map(len, parts)))
    if not parts:
        raise RailgripError(Problem(where, "has no rows under its header"))
    table = np.concatenate(parts)
    return {
        channel.signal: Column(table[:, 0], table[:, k + 1])
        for k, channel in enumerate(wanted.channel)
    }


def _numbers(chunk: Any, names: list[str], where: str, before: int) -> FloatArray:
    import pandas as pd

    columns = []
    for name in names:
        values = pd.to_numeric(chunk[name], errors="coerce")
        bad = (values.isna() & chunk[name].notna()).to_numpy()
        if bad.any():
            row = int(np.flatnonzero(bad)[0])
            got = f"'{printable(str(chunk[name].iloc[row])[:60])}'"
            place = f"{where} line {before + row + 2}"
            cure = 'decimal = "," in the channel map' if "," in got else ""
            what = f"column '{printable(name)}' is no number"
            raise RailgripError(Problem(place, what, got, cure=cure))
        columns.append(values.to_numpy(dtype=float))
    return np.column_stack(columns)


def _parquet(file: Path, where: str, wanted: PadChannelMap, progress: Any) -> dict[str, Column]:
    parquet = _library("pyarrow.parquet", where)
    table = parquet.ParquetFile(file)
    names = [wanted.time.column, *(channel.column for channel in wanted.channel)]
    _refuse_missing(where, names, list(table.schema_arrow.names))
    read = table.read(columns=list(dict.fromkeys(names)))
    progress(read.num_rows)

    def values(name: str) -> FloatArray:
        return np.asarray(read[name].to_numpy(zero_copy_only=False), dtype=float)

    time = values(names[0])
    return {one.signal: Column(time, values(one.column)) for one in wanted.channel}


def _mdf(file: Path, where: str, wanted: PadChannelMap, progress: Any) -> dict[str, Column]:
    with _library("asammdf", where).MDF(file) as measured:
        names = [channel.column for channel in wanted.channel]
        _refuse_missing(where, names, list(measured.channels_db))
        found = {}
        signals = measured.select(names)
        for channel, signal in zip(wanted.channel, signals, strict=True):
            values = np.asarray(signal.samples, dtype=float)
            found[channel.signal] = Column(np.asarray(signal.timestamps), values, signal.unit or "")
        progress(max(len(one.time) for one in found.values()))
    return found


def _tdms(file: Path, where: str, wanted: PadChannelMap, progress: Any) -> dict[str, Column]:
    with _library("nptdms", where).TdmsFile.open(file) as measured:
        channels = {
            key: one
            for group in measured.groups()
            for one in group.channels()
            for key in (one.name, f"{group.name}/{one.name}")
        }
        _refuse_missing(where, [_in_group(one) for one in wanted.channel], list(channels))
        found = {}
        for one in wanted.channel:
            channel = channels[_in_group(one)]
            values = np.asarray(channel[:], dtype=float)
            time = _tdms_time(channel, channels, wanted, len(values))
            unit = str(channel.properties.get("unit_string", ""))
            found[one.signal] = Column(time, values, unit)
        progress(max(len(one.time) for one in found.values()))
    return found


def _in_group(channel: PadChannel) -> str:
    return f"{channel.group}/{channel.column}" if channel.group else channel.column


def _tdms_time(
    channel: Any, channels: dict[str, Any], wanted: PadChannelMap, count: int
) -> FloatArray:
    """Return the clock of a channel: its own waveform, or the time channel."""
    if "wf_increment" in channel.properties:
        begin = float(channel.properties.get("wf_start_offset", 0.0))
        ticks = begin + float(channel.properties["wf_increment"]) * np.arange(count)
        return np.asarray(ticks / wanted.time.si()[0])
    _refuse_missing("time", [wanted.time.column], list(channels))
    return np.asarray(channels[wanted.time.column][:count], dtype=float)
