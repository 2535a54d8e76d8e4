"""Asking for help is quick, and loads nothing heavy."""

from __future__ import annotations

import subprocess
import sys

import pytest

HEAVY = {
    "numba",
    "llvmlite",
    "scipy",
    "xarray",
    "pandas",
    "matplotlib",
    "pint",
    "numpy",
    "pydantic",
}


def help_of(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-X", "importtime", "-m", "railgrip.app", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True)


def imported(stderr: str) -> set[str]:
    lines = [line for line in stderr.splitlines() if line.startswith("import time:")]
    return {line.rpartition("|")[2].strip().partition(".")[0] for line in lines}


def test_help_imports_nothing_heavy() -> None:
    done = help_of("--help")
    assert "compare" in done.stdout
    assert "cyclopts" in imported(done.stderr)
    assert not HEAVY & imported(done.stderr)


@pytest.mark.parametrize(("command", "option"), [("run", "--no-report"), ("contact", "--sweep")])
def test_help_of_a_command_imports_nothing_heavy(command: str, option: str) -> None:
    done = help_of(command, "--help")
    assert option in done.stdout
    assert not HEAVY & imported(done.stderr)
