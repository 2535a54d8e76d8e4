import pytest

from railgrip.core.atomic import write_aside
from railgrip.core.errors import RailgripError


def test_takes_its_name_when_all_went_well(tmp_path):
    target = tmp_path / "run.csv"
    with write_aside(target) as aside:
        assert aside.suffix == ".csv"
        aside.write_text("1")
        assert not target.exists()
    assert target.read_text() == "1"
    assert [file.name for file in tmp_path.iterdir()] == ["run.csv"]


def fail_halfway(target, failure):
    with write_aside(target) as aside:
        aside.write_text("half")
        raise failure


@pytest.mark.parametrize("failure", [ValueError, KeyboardInterrupt, SystemExit])
def test_nothing_half_written_stays(tmp_path, failure):
    target = tmp_path / "run.csv"
    target.write_text("old")
    with pytest.raises(failure):
        fail_halfway(target, failure)
    assert target.read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 1


def test_rights_are_those_of_any_file(tmp_path):
    plain = tmp_path / "plain"
    plain.write_text("")
    with write_aside(tmp_path / "aside") as aside:
        aside.write_text("")
    assert (tmp_path / "aside").stat().st_mode == plain.stat().st_mode


def test_folder_that_is_missing_is_one_sentence(tmp_path):
    target = tmp_path / "no" / "run.csv"
    with pytest.raises(RailgripError, match="cannot be written; got No such"), write_aside(target):
        pass


def test_target_that_is_a_folder_is_one_sentence(tmp_path):
    with pytest.raises(RailgripError, match="cannot be written"), write_aside(tmp_path) as aside:
        aside.write_text("1")
    assert list(tmp_path.iterdir()) == []
