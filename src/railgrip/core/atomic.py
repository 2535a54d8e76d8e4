"""Write aside, then rename: what is found under a name is whole."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from railgrip.core.errors import Problem, RailgripError

_NO_ROOM = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS}
"""Failures that only the writing itself can have, whoever writes within the block."""


@contextmanager
def write_aside(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give a temporary path beside ``path`` that takes its name when all went well.

    Parameters
    ----------
    path : str or path
        Where the file shall be; what is there already is replaced as the last act.

    Yields
    ------
    aside : Path
        An empty file in the same folder, with the same suffix, to write to.

    Raises
    ------
    RailgripError
        ``out/stop.csv: cannot be written; got: No such file or directory``, ``… No space left on
        device``

    Notes
    -----
    Whatever ends the block early, Ctrl-C included, removes the temporary file and leaves
    ``path`` as it was.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with write_aside(Path(folder) / "note.txt") as aside:
    ...         _ = aside.write_text("stopped")
    ...     [file.name for file in Path(folder).iterdir()]
    ['note.txt']
    """
    target = Path(path)
    aside = _beside(target)
    try:
        try:
            yield aside
        except OSError as error:
            if error.errno in _NO_ROOM:
                raise _unwritable(target, OSError(error.errno, os.strerror(error.errno))) from None
            raise
        try:
            aside.replace(target)
        except OSError as error:
            raise _unwritable(target, error) from None
    except BaseException:
        aside.unlink(missing_ok=True)
        raise


def _beside(target: Path) -> Path:
    try:
        handle, name = tempfile.mkstemp(
            prefix=f".{target.stem[:40]}-", suffix=target.suffix, dir=target.parent
        )
        os.close(handle)
        aside = Path(name)
        aside.chmod(_mode(target))
    except (OSError, ValueError) as error:
        raise _unwritable(target, error) from None
    return aside


def _mode(target: Path) -> int:
    # mkstemp keeps its files private; the finished one has the rights of any other file.
    if target.exists():
        return target.stat().st_mode & 0o777
    umask = os.umask(0)
    os.umask(umask)
    return 0o666 & ~umask


def _unwritable(target: Path, error: Exception) -> RailgripError:
    reason = getattr(error, "strerror", None) or str(error)
    return RailgripError(Problem(str(target), "cannot be written", got=reason))
