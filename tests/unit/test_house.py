"""What holds the house together: versions, constraints, and the set-up by dev.py."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from packaging.requirements import Requirement

import railgrip

ROOT = Path(__file__).resolve().parents[2]
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))[
    "project"
]
PINNED = [
    Requirement(line)
    for line in (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
]


def declared() -> list[Requirement]:
    extras = PROJECT["optional-dependencies"].values()
    texts = PROJECT["dependencies"] + [text for extra in extras for text in extra]
    return [req for req in map(Requirement, texts) if req.name != "railgrip"]


def test_one_version_everywhere() -> None:
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    found = re.search(r"^version: (.+)$", citation, re.MULTILINE)
    assert found
    assert found[1] == PROJECT["version"] == railgrip.__version__


def test_constraints_are_exact_versions_only() -> None:
    for pin in PINNED:
        assert pin.url is None
        assert [spec.operator for spec in pin.specifier] == ["=="], str(pin)
    assert len({pin.name.lower() for pin in PINNED if pin.marker is None}) == len(PINNED)


@pytest.mark.parametrize("wanted", declared(), ids=lambda req: req.name)
def test_every_dependency_is_constrained_to_a_version_it_allows(wanted: Requirement) -> None:
    def plain(name: str) -> str:
        return re.sub(r"[-_.]+", "-", name).lower()

    versions = [
        spec.version
        for pin in PINNED
        if plain(pin.name) == plain(wanted.name)
        for spec in pin.specifier
    ]
    assert versions
    assert all(wanted.specifier.contains(version) for version in versions)


def test_lower_bounds_only() -> None:
    operators = {spec.operator for req in declared() for spec in req.specifier}
    assert operators == {">="}


@pytest.fixture
def dev(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """dev.py as a module, working on a copy of the files that it watches."""
    spec = importlib.util.spec_from_file_location("dev", ROOT / "dev.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    for name in ("pyproject.toml", "constraints.txt"):
        (tmp_path / name).write_bytes((ROOT / name).read_bytes())
    monkeypatch.setattr(module, "ROOT", tmp_path)
    return module


@pytest.fixture
def installed(dev: ModuleType, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What dev.py asked pip to install; neither pip nor venv runs."""
    packages: list[str] = []
    monkeypatch.setattr(dev, "run", lambda command: packages.append(str(command[-1])))
    monkeypatch.setattr(
        dev.venv, "create", lambda home, **_: Path(home).mkdir(parents=True, exist_ok=True)
    )
    return packages


def test_sets_up_once(dev: ModuleType, installed: list[str], tmp_path: Path) -> None:
    dev.set_up(tmp_path / "venv", ["test"])
    dev.set_up(tmp_path / "venv", ["test"])
    dev.set_up(tmp_path / "venv", [])
    assert installed == [".[test]"]


def test_adds_what_another_command_needs(
    dev: ModuleType, installed: list[str], tmp_path: Path
) -> None:
    dev.set_up(tmp_path / "venv", [])
    dev.set_up(tmp_path / "venv", ["docs"])
    dev.set_up(tmp_path / "venv", ["test"])
    assert installed == [".", ".[docs]", ".[docs,test]"]


@pytest.mark.parametrize("name", ["pyproject.toml", "constraints.txt"])
def test_sets_up_again_when_a_watched_file_changes(
    dev: ModuleType, installed: list[str], tmp_path: Path, name: str
) -> None:
    dev.set_up(tmp_path / "venv", ["test"])
    with (tmp_path / name).open("a") as file:
        file.write("# changed\n")
    dev.set_up(tmp_path / "venv", [])
    assert installed == [".[test]", ".[test]"]


def test_an_interrupted_set_up_is_taken_up_again(
    dev: ModuleType, installed: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(command: list[str]) -> None:
        raise subprocess.CalledProcessError(1, command)

    with monkeypatch.context() as patched:
        patched.setattr(dev, "run", fail)
        with pytest.raises(subprocess.CalledProcessError):
            dev.set_up(tmp_path / "venv", [])
    dev.set_up(tmp_path / "venv", [])
    assert installed == ["."]


def test_names_the_debian_package_when_venv_is_incomplete(
    dev: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dev.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(dev.SetupError, match="sudo apt install python3-venv"):
        dev.set_up(tmp_path / "venv", [])
    assert not (tmp_path / "venv").exists()


def test_dev_py_needs_the_standard_library_only() -> None:
    command = [sys.executable, "-I", "-S", str(ROOT / "dev.py"), "--help"]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "dev.py demo" in result.stdout
