"""What a command shows: tables and JSON on standard output, problems and progress on the other."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from railgrip.core.errors import Problem


def print_problems(problems: Iterable[Problem], as_json: bool, exit_code: int) -> None:
    """Print one clear line a problem, or all of them as one JSON object."""
    problems = list(problems)
    if as_json:
        errors = [{**vars(problem), "message": str(problem)} for problem in problems]
        print_json({"errors": errors, "exit_code": exit_code})
        return
    for problem in problems:
        print(f"railgrip: {' '.join(str(problem).split())}", file=sys.stderr)


def print_json(content: dict[str, Any]) -> None:
    """Print one JSON object; numbers that JSON cannot say (NaN, infinity) become null."""
    print(json.dumps(as_plain(content), indent=2, ensure_ascii=False, allow_nan=False))


def as_plain(value: Any) -> Any:
    """Return the value with null for numbers that JSON cannot say."""
    if isinstance(value, dict):
        return {key: as_plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [as_plain(item) for item in value]
    if isinstance(value, float) and value - value != 0.0:
        return None
    return value


def print_table(
    title: str, columns: list[str], rows: Iterable[Iterable[str]], *, to_the_right: bool = True
) -> None:
    """Print a table; the first column is text, the others are figures and stand to the right.

    A pipe or a file gets the full width, whatever the terminal that started us.
    """
    from rich import box
    from rich.console import Console
    from rich.table import Table

    table = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD)
    for number, column in enumerate(columns):
        table.add_column(column, justify="right" if number and to_the_right else "left")
    for row in rows:
        table.add_row(*row)
    console = Console(width=None if sys.stdout.isatty() else 140, highlight=False)
    console.print(table)


@contextmanager
def working(sentence: str) -> Iterator[None]:
    """Show that something goes on, on a terminal only.

    Examples
    --------
    >>> with working("simulating"):
    ...     pass
    """
    if not sys.stderr.isatty():
        yield
        return
    from rich.console import Console

    with Console(stderr=True).status(sentence):
        yield
