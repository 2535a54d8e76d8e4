"""What a profile may say, and what is refused before the first run."""

from __future__ import annotations

import itertools
from pathlib import Path

import pytest

from railgrip.campaign.programme.metrics import METRICS
from railgrip.campaign.programme.perform import Programme
from railgrip.campaign.programme.profile import Alternating, read_profile
from railgrip.campaign.programme.situation import patches
from railgrip.core.errors import RailgripError


def profile_file(folder: Path, text: str) -> str:
    path = folder / "mine.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_every_shipped_limit_names_its_provenance() -> None:
    profile, folder = read_profile("en_15595_style")
    Programme(profile, folder, "emu_four_car", "conventional")
    windows = [w for one in profile.test.values() for w in (*one.limit.values(),
               *one.valid.values())]  # fmt: skip
    assert len(windows) > 50
    assert all(window.source for window in windows)


def test_a_profile_extends_another(tmp_path: Path) -> None:
    mine = profile_file(
        tmp_path,
        'extends = "en_15595_style"\nrepetitions = 3\n'
        '[test.W3.limit.extension]\ngreatest = "12 %"\njudged = "mean"\nsource = "ours, page 4"\n'
        "[test.T12]\nskip = true\n",
    )
    profile, _ = read_profile(mine)
    assert profile.repetitions == 3
    assert profile.test["W3"].limit["extension"].source == "ours, page 4"
    assert profile.test["W3"].limit["fast_lock"].greatest == "0.4 s"
    assert "T12" not in profile.chosen()
    assert set(profile.chosen(("W3",))) == {"D1", "W3"}


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("[test.W3.limit.fast_lock]\ngreatest = 0.4\nsource = 'x'\n", "has no unit"),
        ("[test.W3.limit.fast_lock]\ngreatest = '0.4 m'\nsource = 'x'\n", "does not fit"),
        ("[test.W3.limit.fast_lok]\ngreatest = '0.4 s'\nsource = 'x'\n",
         "metric 'fast_lok' unknown"),
        ("[test.W3]\nreport = ['fast_lok']\n", "did you mean 'fast_lock'"),
        ("[metric]\nhold = 'nowhere.py:hold'\n", "no such file"),
        ("[metric]\nhold = 'nowhere'\n", "is not of the form file.py:function"),
    ],
)  # fmt: skip
def test_limits_are_read_before_the_first_run(tmp_path: Path, text: str, sentence: str) -> None:
    profile, folder = read_profile(profile_file(tmp_path, 'extends = "en_15595_style"\n' + text))
    with pytest.raises(RailgripError, match=sentence):
        Programme(profile, folder, "emu_four_car", "conventional")


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("[test.N1]\ntitle = 'n'\n[test.N1.limit.fast_lock]\ngreatest = '1 s'\n", "source"),
        ("[test.N1]\ntitle = 'n'\n[test.N1.limit.fast_lock]\nsource = 'x'\n",
         "neither least nor greatest"),
        ("[test.N1]\ntitle = 'n'\nagainst = 'D9'\n", "is no test of this profile"),
        ("tries = 2\n", "must not be less than repetitions"),
        ("colour = 'red'\n", "colour"),
    ],
)  # fmt: skip
def test_a_profile_that_says_nonsense_is_refused(tmp_path: Path, text: str, sentence: str) -> None:
    with pytest.raises(RailgripError, match=sentence):
        read_profile(profile_file(tmp_path, text.split("[")[0] + 'extends = "en_15595_style"\n'
                                  + text[len(text.split("[")[0]):]))  # fmt: skip


def test_a_train_without_protection_is_refused() -> None:
    profile, folder = read_profile("en_15595_style")
    with pytest.raises(RailgripError, match="no dump valves"):
        Programme(profile, folder, "freight_20", "conventional")


def test_stretches_take_turns_and_leave_no_gap() -> None:
    rail = Alternating(conditions=("very_low", "wet"), shortest=50.0, longest=100.0, end=1000.0)
    found = patches(rail, 3)
    assert found == patches(rail, 3)
    assert found != patches(rail, 4)
    assert [one["condition"] for one in found[:3]] == ["very_low", "wet", "very_low"]
    for one, after in itertools.pairwise(found):
        assert one["to"] == after["from"]
        assert 50.0 <= one["to"] - one["from"] <= 100.0
    assert found[-1]["to"] == 1000.0


def test_every_metric_speaks_both_languages() -> None:
    for metric in METRICS.values():
        assert metric.label
        assert metric.label_de
        assert metric.label != metric.label_de
