"""A folder of results appears whole or not at all: written aside, then moved into place."""

from __future__ import annotations

import os
import shutil
import signal
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import NoReturn

from railgrip.core.errors import Problem, RailgripError

_asked_to_stop: list[int] = []


def stop_when_asked() -> None:
    """Take Ctrl-C down before raising it: a library's callback may swallow the exception."""
    signal.signal(signal.SIGINT, _interrupt)


def _interrupt(number: int, _frame: FrameType | None) -> NoReturn:
    _asked_to_stop.append(number)
    raise KeyboardInterrupt


@contextmanager
def folder_of_results(folder: Path) -> Iterator[Path]:
    """Give an empty folder to write into; at the end its files move to where they belong.

    If anything fails, or the user presses Ctrl-C, the target is as it was before.

    Parameters
    ----------
    folder : Path
        Where the files shall lie; made when missing, files of the same name are replaced.

    Raises
    ------
    RailgripError
        ``out/leaves: cannot write here; got Permission denied; try: another --out``

    Examples
    --------
    >>> home = Path(tempfile.mkdtemp())
    >>> with folder_of_results(home / "stop") as aside:
    ...     _ = (aside / "report.html").write_text("…", encoding="utf-8")
    >>> [path.name for path in (home / "stop").iterdir()]
    ['report.html']
    """
    made: list[Path] = []
    try:
        made = _make_missing(folder)
        aside = Path(tempfile.mkdtemp(prefix=".unfinished-", dir=folder))
    except OSError as error:
        _remove_empty(made)
        raise _refusal(folder, error) from error
    try:
        yield aside
        if _asked_to_stop:
            raise KeyboardInterrupt
        with _undisturbed():
            try:
                _move_into(aside, folder)
            except OSError as error:
                raise _refusal(folder, error) from error
    finally:
        shutil.rmtree(aside, ignore_errors=True)
        _remove_empty(made)


def _move_into(aside: Path, folder: Path) -> None:
    for path in sorted(aside.iterdir()):
        os.replace(path, folder / path.name)


def _make_missing(folder: Path) -> list[Path]:
    """Make a folder and its parents; return those that were not there, the deepest first."""
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    return missing


def _remove_empty(folders: list[Path]) -> None:
    for folder in folders:
        try:
            folder.rmdir()
        except OSError:  # it holds results now, or somebody else's files
            return


def _refusal(folder: Path, error: OSError) -> RailgripError:
    got = error.strerror or str(error)
    return RailgripError(Problem(str(folder), "cannot write here", got=got, cure="another --out"))


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Hold Ctrl-C back for the instant in which files are moved."""
    try:
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    except ValueError:  # not in the main thread, where signals never arrive anyway
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
