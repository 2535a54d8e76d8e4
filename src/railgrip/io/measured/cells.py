"""The cells of a CSV file as numbers, each bad one with its line."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from railgrip.core.errors import Problem, RailgripError, nearest
from railgrip.io.measured.channel_map import ChannelMap
from railgrip.scenario.files import printable

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

MOST_PROBLEMS = 10


def read_cells(
    file: Iterable[str], where: str, wanted: ChannelMap, columns: list[str]
) -> tuple[list[int], Array]:
    """Return line numbers and readings (row, column) of the wanted columns."""
    after = islice(iter(file), wanted.skip_lines, None)
    rows = csv.reader(after, delimiter=wanted.delimiter)
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
        cells = [row[place].strip() if place < len(row) else "" for place in places]
        numbers = [_number(cell, wanted.decimal) for cell in cells]
        values.append(numbers)
        for column, cell, number in zip(columns, cells, numbers, strict=True):
            if not math.isfinite(number):
                problems.append(_bad_cell(f"{where} line {line}", printable(column), cell))
        if len(problems) >= MOST_PROBLEMS:
            problems = [*problems[:MOST_PROBLEMS], Problem(where, "there may be more")]
            break
    if problems:
        raise RailgripError(problems)
    if len(values) < 2:
        raise RailgripError(Problem(where, "has too few rows", f"{len(values)}", "2 or more"))
    return lines, np.array(values)


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


def _number(text: str, decimal: str) -> float:
    try:
        return float(text.replace(decimal, ".") if decimal != "." else text)
    except ValueError:
        return math.nan


def _bad_cell(where: str, column: str, text: str) -> Problem:
    if not text or text.lower() in ("nan", "-nan", "null", "none"):
        cure = "cut the file to the stop, or fill the gap"
        return Problem(where, f"column '{column}' has a gap", f"'{printable(text)}'", cure=cure)
    cure = 'decimal = "," in the channel map' if "," in text else ""
    what = f"column '{column}' is no finite number"
    return Problem(where, what, f"'{printable(text)}'", cure=cure)
