#!/usr/bin/env python3
"""Set railgrip up beside itself, and run what a user or a developer runs. Standard library only.

    python3 dev.py demo    set up, then `railgrip demo` (further words go to it)
    python3 dev.py test    set up for testing, then pytest (further words go to it)
    python3 dev.py lint    ruff, import-linter, mypy
    python3 dev.py docs    the documentation, warnings are errors
    python3 dev.py bench   one quick pass of every benchmark
    python3 dev.py all     lint, test, docs, bench

The environment is `.venv` beside this file, or the folder named by --venv or RAILGRIP_VENV. It is
set up once, and again only when pyproject.toml or constraints.txt has changed.
"""

from __future__ import annotations

import argparse
import hashlib
import importlib.util
import json
import os
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent
OLDEST = (3, 11)
EXTRAS = {
    "demo": [],
    "test": ["test"],
    "lint": ["lint", "test"],  # mypy reads what the tests import
    "docs": ["docs"],
    "bench": ["test"],  # campaigns, clusters and optima are measured too
    "all": ["docs", "lint", "test"],
}
STAMP = "railgrip-setup.json"


def main() -> int:
    """Set up what the command needs, run it, and return its exit code."""
    if sys.version_info < OLDEST:
        return fail("railgrip needs Python 3.11 or newer; this is " + sys.version.split()[0])
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--venv", type=Path, default=os.environ.get("RAILGRIP_VENV") or None)
    parser.add_argument("command", choices=EXTRAS)
    options, words = parser.parse_known_args()
    if words and options.command not in ("demo", "test"):
        parser.error("only demo and test take further words: " + " ".join(words))

    home = (options.venv or ROOT / ".venv").resolve()
    try:
        set_up(home, EXTRAS[options.command])
        for command in steps(options.command, home, words):
            run(command)
    except subprocess.CalledProcessError as error:
        return error.returncode if error.returncode > 0 else 1
    except KeyboardInterrupt:
        return 130
    except SetupError as error:
        return fail(str(error))
    return 0


class SetupError(Exception):
    """The environment cannot be made; the text says what to do."""


def fail(sentence: str) -> int:
    """Say what is wrong and return the exit code for it."""
    print(f"dev.py: {sentence}", file=sys.stderr)
    return 2


def run(command: list[str | Path]) -> None:
    """Run one command in the repository; a failure ends dev.py with the command's exit code."""
    print("$", " ".join(str(word) for word in command), file=sys.stderr, flush=True)
    subprocess.run(command, cwd=ROOT, check=True)


def tool(home: Path, name: str) -> Path:
    """Return the path of a program in the environment."""
    windows = os.name == "nt"
    return home / ("Scripts" if windows else "bin") / (f"{name}.exe" if windows else name)


def steps(command: str, home: Path, words: list[str]) -> list[list[str | Path]]:
    """Return the command lines that one of dev.py's commands stands for."""
    python = tool(home, "python")
    if command == "demo":
        return [[tool(home, "railgrip"), "demo", *words]]
    if command == "test":
        # a file's tests stay together: they share fixtures that take long to make
        return [[python, "-m", "pytest", "-n", "auto", "--dist", "loadfile", *words]]
    if command == "lint":
        return [
            [tool(home, "ruff"), "check", "."],
            [tool(home, "ruff"), "format", "--check", "."],
            [tool(home, "lint-imports")],
            [python, "-m", "mypy"],
        ]
    if command == "docs":
        return [[python, "-m", "sphinx", "-W", "-q", "-b", "html", "docs", "docs/_build/html"]]
    if command == "bench":
        scripts = sorted((ROOT / "benchmarks").glob("[!_]*.py"))
        return [[python, script.relative_to(ROOT), "--quick"] for script in scripts]
    return [line for part in ("lint", "test", "docs", "bench") for line in steps(part, home, [])]


def set_up(home: Path, extras: list[str]) -> None:
    """Make or renew the environment; does nothing when it is already what the command needs."""
    digest = hashlib.sha256(sys.version.encode())
    for name in ("pyproject.toml", "constraints.txt"):
        digest.update((ROOT / name).read_bytes())
    stamp = home / STAMP
    try:
        done = json.loads(stamp.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        done = {"digest": "", "extras": [], "python": sys.version}
    if done["digest"] == digest.hexdigest() and set(extras) <= set(done["extras"]):
        return

    stamp.unlink(missing_ok=True)  # an interrupted set-up is taken up again
    make_environment(home, clear=done["python"] != sys.version)
    wanted = sorted(set(extras) | set(done["extras"]))
    package = f".[{','.join(wanted)}]" if wanted else "."
    print(f"dev.py: installing railgrip and what it needs into {home} ...", file=sys.stderr)
    pip = [tool(home, "python"), "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
    run([*pip, "--constraint", "constraints.txt", "--editable", package])
    now = {"digest": digest.hexdigest(), "extras": wanted, "python": sys.version}
    stamp.write_text(json.dumps(now), encoding="utf-8")


def make_environment(home: Path, clear: bool) -> None:
    """Create the virtual environment, or repair a half-made one."""
    if importlib.util.find_spec("ensurepip") is None:
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        raise SetupError(
            "Python's venv module is incomplete here (no ensurepip); on Debian and Ubuntu install "
            f"it with: sudo apt install python3-venv (or python{version}-venv), then try again"
        )
    try:
        venv.create(home, with_pip=True, clear=clear)
    except (OSError, subprocess.CalledProcessError) as error:
        raise SetupError(f"cannot make the environment {home}: {error}") from error


if __name__ == "__main__":
    sys.exit(main())
