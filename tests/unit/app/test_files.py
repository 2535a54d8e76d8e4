"""A folder of results appears whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from railgrip.app.files import folder_of_results
from railgrip.core.errors import RailgripError


def fail_while_writing(target: Path, error: type[BaseException]) -> None:
    with folder_of_results(target) as aside:
        (aside / "one").write_text("new", encoding="utf-8")
        raise error


def test_files_appear_at_the_end_only(tmp_path: Path) -> None:
    target = tmp_path / "a" / "b"
    with folder_of_results(target) as aside:
        (aside / "one").write_text("1", encoding="utf-8")
        assert not (target / "one").exists()
    assert [path.name for path in target.iterdir()] == ["one"]


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt, SystemExit])
def test_a_failure_leaves_the_world_as_it_was(tmp_path: Path, error: type[BaseException]) -> None:
    with pytest.raises(error):
        fail_while_writing(tmp_path / "a" / "b", error)
    assert list(tmp_path.iterdir()) == []


def test_a_failure_leaves_older_results_alone(tmp_path: Path) -> None:
    (tmp_path / "one").write_text("old", encoding="utf-8")
    with pytest.raises(KeyError):
        fail_while_writing(tmp_path, KeyError)
    assert (tmp_path / "one").read_text(encoding="utf-8") == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["one"]


def test_new_results_replace_older_ones_and_spare_other_files(tmp_path: Path) -> None:
    for name in ("one", "other"):
        (tmp_path / name).write_text("old", encoding="utf-8")
    with folder_of_results(tmp_path) as aside:
        (aside / "one").write_text("new", encoding="utf-8")
    assert (tmp_path / "one").read_text(encoding="utf-8") == "new"
    assert (tmp_path / "other").read_text(encoding="utf-8") == "old"


def test_a_file_in_the_way_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    for target in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(RailgripError, match="cannot write here"), folder_of_results(target):
            pass
