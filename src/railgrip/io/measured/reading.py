"""CSV file and channel map → a measured stop in SI, or every reason why not."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from railgrip.core.errors import Problem, RailgripError, nearest
from railgrip.io.measured.channel_map import Channel, ChannelMap, read_channel_map
from railgrip.scenario.files import printable

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

MOST_BYTES = 100_000_000
MOST_PROBLEMS = 10
STEPPED = frozenset({"dump_valve", "is_sliding", "alarm"})


@dataclass(frozen=True)
class MeasuredStop:
    """A measured stop in SI.

    Parameters
    ----------
    title : str
        Name in legends and tables.
    time : array
        Ascending, s.
    train : dict
        Signal name → values (time); holds at least ``train_speed``.
    axles : dict
        Signal name → axle label → values (time).
    brake_command, speed_crossing : float, optional
        Where it is laid over a simulated stop: time, s, or speed, m/s.
    """

    title: str
    time: Array
    train: dict[str, Array]
    axles: dict[str, dict[str, Array]] = field(default_factory=dict)
    brake_command: float | None = None
    speed_crossing: float | None = None

    @property
    def distance(self) -> Array:
        """Distance from the first sample: measured position, else the integral of the speed."""
        if "train_position" in self.train:
            position = self.train["train_position"]
            return np.asarray(position - position[0])
        speed = self.train["train_speed"]
        pieces = np.diff(self.time) * (speed[1:] + speed[:-1]) / 2
        return np.concatenate([[0.0], np.cumsum(pieces)])

    def resampled(self, time: Array) -> MeasuredStop:
        """Return the stop at other times, NaN where nothing was measured.

        Examples
        --------
        >>> stop = MeasuredStop("a", np.array([0.0, 2.0]), {"train_speed": np.array([10.0, 8.0])})
        >>> stop.resampled(np.array([1.0, 3.0])).train["train_speed"].tolist()
        [9.0, nan]
        """

        def at(name: str, values: Array) -> Array:
            if name in STEPPED:
                before = np.searchsorted(self.time, time, side="right") - 1
                inside = (time >= self.time[0]) & (time <= self.time[-1])
                return np.where(inside, values[np.maximum(before, 0)], np.nan)
            return np.interp(time, self.time, values, left=np.nan, right=np.nan)

        return replace(
            self,
            time=time,
            train={name: at(name, values) for name, values in self.train.items()},
            axles={
                name: {label: at(name, values) for label, values in rows.items()}
                for name, rows in self.axles.items()
            },
        )


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
            lines, values = _values(file, where, wanted, columns)
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
    return MeasuredStop(
        wanted.title, time, train, axles, align.brake_command, align.speed_crossing
    )


def _values(
    file: Iterable[str], where: str, wanted: ChannelMap, columns: list[str]
) -> tuple[list[int], Array]:
    """Return line numbers and readings (row, column) of the wanted columns."""
    rows = csv.reader(_counted(file, wanted.skip_lines), delimiter=wanted.delimiter)
    header = [name.strip() for name in next(rows, [])]
    places = _places(header, columns, where)
    if wanted.units_line:
        next(rows, None)
    lines: list[int] = []
    values: list[list[float]] = []
    problems: list[Problem] = []
    for row in rows:
        if not any(cell.strip() for cell in row):
            continue
        line = rows.line_num + wanted.skip_lines
        lines.append(line)
        values.append(_numbers(row, places, columns, wanted.decimal, f"{where} line {line}", problems))
        if len(problems) >= MOST_PROBLEMS:
            problems = [*problems[:MOST_PROBLEMS], Problem(where, "there may be more")]
            break
    if problems:
        raise RailgripError(problems)
    if len(values) < 2:
        raise RailgripError(Problem(where, "has too few rows", f"{len(values)}", "2 or more"))
    return lines, np.array(values)


def _counted(file: Iterable[str], skip: int) -> Iterator[str]:
    return islice(iter(file), skip, None)


def _places(header: list[str], columns: list[str], where: str) -> list[int]:
    problems = []
    for column in columns:
        if header.count(column) == 1:
            continue
        if column in header:
            problems.append(Problem(where, f"has more than one column '{printable(column)}'"))
            continue
        known = ", ".join(printable(name) for name in header[:30]) or "no column at all"
        more = f" … ({len(header)} in all)" if len(header) > 30 else ""
        guess = nearest(column, header[:2000])
        hint = f"; did you mean '{printable(guess)}'?" if guess else ""
        what = f"has no column '{printable(column)}'; known: {known}{more}{hint}"
        cure = "another delimiter in the channel map" if len(header) == 1 else ""
        problems.append(Problem(where, what, cure=cure))
    if problems:
        raise RailgripError(problems)
    return [header.index(column) for column in columns]


def _numbers(
    row: list[str],
    places: list[int],
    columns: list[str],
    decimal: str,
    where: str,
    problems: list[Problem],
) -> list[float]:
    found = []
    for place, column in zip(places, columns, strict=True):
        text = row[place].strip() if place < len(row) else ""
        try:
            number = float(text.replace(decimal, ".") if decimal != "." else text)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            problems.append(_bad_cell(where, printable(column), text))
        found.append(number)
    return found


def _bad_cell(where: str, column: str, text: str) -> Problem:
    if not text or text.lower() in ("nan", "-nan", "null", "none"):
        cure = "cut the file to the stop, or fill the gap"
        return Problem(where, f"column '{column}' has a gap", f"'{printable(text)}'", cure=cure)
    cure = 'decimal = "," in the channel map' if "," in text else ""
    return Problem(where, f"column '{column}' is no finite number", f"'{printable(text)}'", cure=cure)


def _check_ascending(time: Array, lines: list[int], where: str) -> None:
    bad = np.flatnonzero(np.diff(time) <= 0)
    if len(bad):
        k = int(bad[0]) + 1
        what = "the time does not ascend"
        got = f"{time[k]:.9g} s after {time[k - 1]:.9g} s"
        raise RailgripError(Problem(f"{where} line {lines[k]}", what, got))


__all__ = ["Channel", "MeasuredStop", "read_measured"]
