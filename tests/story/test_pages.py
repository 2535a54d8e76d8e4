"""Every command and every piece of Python that the documentation shows is run, as it stands."""

from __future__ import annotations

import doctest
import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.story.blocks import Block, blocks

ROOT = Path(__file__).resolve().parents[2]
GENERATED = {"_build", "_generated", "_static", "gallery", "gallery_src"}
PAGES = [
    page
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    if not GENERATED & set(page.relative_to(ROOT).parts) and blocks(page)
]
SAME = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_reader_can_do_what_the_page_shows(page: Path, tmp_path: Path) -> None:
    for block in blocks(page):
        if block.file:
            (tmp_path / block.file).write_text(block.code, encoding="utf-8")
            continue
        done = run(block, tmp_path)
        place = f"{page.name}, line {block.line}"
        told = f"{place}:\n{block.code}\nprinted\n{done.stdout}\nand said\n{done.stderr}"
        assert done.returncode == block.exit_code, told
        assert "Traceback" not in done.stderr, told
        if block.printed is not None:
            assert doctest.OutputChecker().check_output(block.printed, done.stdout, SAME), told


def run(block: Block, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a block as a reader would, with the environment's programs first on the path."""
    programs = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    command = ["bash", "-euo", "pipefail", "-c"] if block.language == "bash" else ["python", "-c"]
    return subprocess.run(
        [*command, block.code],
        cwd=folder,
        env={**os.environ, "PATH": programs, "COLUMNS": "100"},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


def test_the_pages_show_something() -> None:
    names = {page.name for page in PAGES}
    assert {"README.md", "tutorial.md", "run.md", "compare.md", "check.md", "contact.md"} <= names


def test_reads_blocks_as_described(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        "Text.\n\n```bash\ngit clone somewhere\necho one\n```\n\n```text\none\n```\n\n"
        "<!-- not run: takes an hour -->\n```bash\nsleep 3600\n```\n\n"
        '<!-- file: a.toml -->\n```toml\nspeed = "1 m/s"\n```\n\n'
        "<!-- exit code: 2 -->\n```bash\nexit 2\n```\n\nProse.\n\n```text\nnot its output\n```\n",
        encoding="utf-8",
    )
    assert blocks(page) == [
        Block(3, "bash", "echo one\n", printed="one\n"),
        Block(18, "toml", 'speed = "1 m/s"\n', file="a.toml"),
        Block(23, "bash", "exit 2\n", exit_code=2),
    ]
