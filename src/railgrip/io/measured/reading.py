"""CSV file and channel map → a measured stop in SI, or every reason why not."""

from __future__ import annotations

import csv
import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from railgrip.core.errors import Problem, RailgripError
from railgrip.io.measured.cells import read_cells
from railgrip.io.measured.channel_map import ChannelMap, read_channel_map
from railgrip.io.measured.stop import MeasuredStop
from railgrip.scenario.files import printable

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

MOST_BYTES = 100_000_000


def read_measured(
    path: str | os.PathLike[str], channels: ChannelMap | str | os.PathLike[str]
) -> MeasuredStop:
    """Return the measured stop of a CSV file.

    Parameters
    ----------
    path : path
        The CSV file.
    channels : ChannelMap or path
        Which column is which signal.

    Returns
    -------
    MeasuredStop
        In SI.

    Raises
    ------
    RailgripError
        ``stop.csv: has no column 'v'; known: t, speed``,
        ``stop.csv line 7: column 'v' is no number; got 'abc'``,
        ``stop.csv line 9: the time does not ascend; got 0.2 after 0.3``, …
    """
    where = printable(str(path), 300)
    wanted = channels if isinstance(channels, ChannelMap) else read_channel_map(channels)
    columns = [wanted.time.column, *(channel.column for channel in wanted.channel)]
    try:
        size = os.stat(path).st_size
        if size > MOST_BYTES:
            got, allowed = f"{size / 1e6:.0f} MB", f"up to {MOST_BYTES / 1e6:g} MB"
            cure = "cut it to the stop, or to fewer samples per second"
            raise RailgripError(Problem(where, "is too large", got, allowed, cure))
        with Path(path).open(newline="", encoding=_encoding(wanted)) as file:
            lines, values = read_cells(file, where, wanted, columns)
    except FileNotFoundError:
        raise RailgripError(Problem(where, "there is no such file")) from None
    except UnicodeError:
        what = f"is no {wanted.encoding} text"
        cure = 'save it as UTF-8, or give e.g. encoding = "latin-1" in the channel map'
        raise RailgripError(Problem(where, what, cure=cure)) from None
    except (OSError, ValueError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise RailgripError(Problem(where, "cannot be read", got=reason)) from None
    factor, offset = wanted.time.si()
    time = values[:, 0] * factor + offset
    _check_ascending(time, lines, where)
    return _stop(wanted, time, values[:, 1:])


def _encoding(wanted: ChannelMap) -> str:
    return "utf-8-sig" if wanted.encoding == "utf-8" else wanted.encoding


def _stop(wanted: ChannelMap, time: Array, values: Array) -> MeasuredStop:
    train: dict[str, Array] = {}
    axles: dict[str, dict[str, Array]] = {}
    for k, channel in enumerate(wanted.channel):
        factor, offset = channel.si()
        column = values[:, k] * factor + offset
        if channel.axle:
            axles.setdefault(channel.signal, {})[channel.axle] = column
        else:
            train[channel.signal] = column
    align = wanted.align
    return MeasuredStop(wanted.title, time, train, axles, align.brake_command, align.speed_crossing)


def _check_ascending(time: Array, lines: list[int], where: str) -> None:
    bad = np.flatnonzero(np.diff(time) <= 0)
    if len(bad):
        k = int(bad[0]) + 1
        what = "the time does not ascend"
        got = f"{time[k]:.9g} s after {time[k - 1]:.9g} s"
        raise RailgripError(Problem(f"{where} line {lines[k]}", what, got))
