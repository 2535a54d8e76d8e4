"""Code blocks of a Markdown page, in the order in which a reader would try them.

- ``bash`` and ``python`` blocks are run; one after ``<!-- not run: why -->`` is not.
- A block after ``<!-- file: NAME -->`` is saved under that name instead; a ``literalinclude``
  stands for the file that it includes.
- A command after ``<!-- exit code: N -->`` must end with N.
- A ``text`` block that follows a run block directly is what that block prints; ``...`` stands for
  anything.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

_PART = re.compile(
    r"^```(?P<language>[^\n`]*)\n(?P<code>.*?)^```$|^<!-- (?P<note>.*?) -->$|^(?P<prose>\S[^\n]*)$",
    re.MULTILINE | re.DOTALL,
)
# What sets the environment up that the tests already run in; CI runs these themselves.
_SET_UP = ("git clone", "cd ", "python3 dev.py", "source .venv", ".ci/run")


class Block(NamedTuple):
    """One block: what to do with it, and where it stands."""

    line: int
    language: str
    code: str
    file: str = ""
    exit_code: int = 0
    printed: str | None = None


def blocks(page: Path) -> list[Block]:
    """Return the blocks of a page that are to be run or saved."""
    text = page.read_text(encoding="utf-8")
    found: list[Block] = []
    note, follows_block = "", False
    for match in _PART.finditer(text):
        if match["prose"] is not None:
            note, follows_block = "", False
        elif match["note"] is not None:
            note, follows_block = match["note"], False
        else:
            number = text.count("\n", 0, match.start()) + 1
            language, code = match["language"], match["code"]
            if language.startswith("{literalinclude} "):
                code = (page.parent / language.split()[1]).read_text(encoding="utf-8")
            block = _block(number, language, code, note)
            if block is not None:
                found.append(block)
            elif match["language"] == "text" and follows_block and not note:
                found[-1] = found[-1]._replace(printed=match["code"])
            follows_block = block is not None and not block.file
            note = ""
    return found


def _block(line: int, language: str, code: str, note: str) -> Block | None:
    kind, _, detail = note.partition(":")
    if kind == "file":
        return Block(line, language, code, file=detail.strip())
    if kind == "not run":
        assert detail.strip(), f"line {line}: say why the block is not run"
        return None
    if language == "bash":
        code = "".join(row for row in code.splitlines(True) if not row.startswith(_SET_UP))
    if language not in ("bash", "python") or not code.strip():
        return None
    return Block(line, language, code, exit_code=int(detail) if kind == "exit code" else 0)
