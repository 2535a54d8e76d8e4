"""The programme at work: bad protections are caught, runs come again, protocols are the same."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from railgrip.campaign.programme.again import run_again
from railgrip.campaign.programme.against import compared, read_protocol
from railgrip.campaign.programme.perform import Programme
from railgrip.campaign.programme.profile import read_profile
from railgrip.campaign.programme.protocol import protocol
from railgrip.core.errors import RailgripError
from railgrip.report.protocol.page import protocol_html
from railgrip.report.protocol.pdf import protocol_pdf

BAD = Path(__file__).parent / "bad_controllers"


def programme(controller: str, repetitions: int = 2) -> Programme:
    profile, folder = read_profile("en_15595_style")
    return Programme(profile.with_repetitions(repetitions), folder, "emu_four_car", controller)


@cache
def table(controller: str, *tests: str) -> dict:
    ready = programme(controller)
    return protocol(ready, list(ready.perform(tests)), "en_15595_style")


@pytest.mark.parametrize(
    ("file", "test", "metric"),
    [
        ("inverted_valve", "W3", "released_time"),
        ("swapped_thresholds", "W3", "least_reservoir"),
        ("no_release", "X5-60", "fast_lock"),
        ("wrong_diameter", "G7-100", "reference_error"),
        ("hasty_filling", "W3", "least_reservoir"),
    ],
)
def test_a_bad_protection_is_caught(file: str, test: str, metric: str) -> None:
    """Each misses a limit that the conventional protection keeps; which one, is told."""
    sound, bad = table("conventional", test), table(str(BAD / f"{file}.py"), test)
    missed = {(one.test, one.metric) for one in compared(sound, bad) if one.is_newly_missed}
    assert (test, metric) in missed


def test_a_train_that_never_stops_misses_what_it_has_no_distance_for() -> None:
    """With its valves inverted the train does not stop in five minutes."""
    found = table(str(BAD / "inverted_valve.py"), "W3")["tests"]
    (sprayed,) = [test for test in found if test["name"] == "W3"]
    limits = {limit["metric"]: limit for limit in sprayed["limits"]}
    assert limits["ended_well"]["verdict"] == "missed"
    assert limits["extension"]["verdict"] == "missed"
    assert limits["extension"]["value"] == "infinite"
    sound = [limit["metric"] for test in table("conventional", "W3")["tests"]
             for limit in test["limits"]]  # fmt: skip
    assert "ended_well" not in sound


def test_a_sound_protection_keeps_what_the_bad_ones_miss() -> None:
    for test in ("W3", "X5-60", "G7-100"):
        limits = [limit for one in table("conventional", test)["tests"] for limit in one["limits"]]
        assert {limit["verdict"] for limit in limits} == {"kept"}


def test_a_run_comes_again_by_its_number() -> None:
    ready = programme("conventional", 3)
    record = next(one for one in ready.perform(("W3",)) if one.name == "W3")
    run = record.runs[2]
    again = run_again(ready, "W3", run.number)
    assert float(again.data["stopping_distance"][0]) == run.figures["stopping_distance"]
    with pytest.raises(RailgripError, match="no such run"):
        run_again(ready, "W3", 99)


def test_repetitions_differ_and_the_seed_decides() -> None:
    ready = programme("conventional", 3)
    distances = [run.figures["stopping_distance"] for one in ready.perform(("D1",))
                 for run in one.runs]  # fmt: skip
    again = [run.figures["stopping_distance"] for one in programme("conventional", 3).perform(
             ("D1",)) for run in one.runs]  # fmt: skip
    assert distances == again
    assert len(set(distances)) == 3


def test_the_same_inputs_give_the_same_bytes(tmp_path: Path) -> None:
    ready = programme("conventional")
    second = protocol(ready, list(ready.perform(("W3",))), "en_15595_style")
    first = table("conventional", "W3")
    assert json.dumps(first) == json.dumps(second)
    assert protocol_html(first, "de") == protocol_html(second, "de")
    assert protocol_pdf(first) == protocol_pdf(second)
    file = tmp_path / "before.json"
    file.write_text(json.dumps(first), encoding="utf-8")
    assert not any(one.is_newly_missed for one in compared(read_protocol(file), second))


def test_the_page_says_what_it_is_and_loads_nothing() -> None:
    for language, word in (("en", "simulation, not an approval"), ("de", "keine Zulassung")):
        page = protocol_html(table("conventional", "W3"), language)
        assert word in page
        assert "http" not in page.replace("http://www.w3.org/2000/svg", "").replace(
            "http-equiv", ""
        )
        assert "<script" not in page
        assert page.count("<polyline") > 50
        assert f'lang="{language}"' in page
    with pytest.raises(RailgripError, match="language 'fr' unknown"):
        protocol_html(table("conventional", "W3"), "fr")


def test_a_test_that_cannot_become_valid_says_what_to_change(tmp_path: Path) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text(
        'extends = "en_15595_style"\nrepetitions = 2\ntries = 4\n'
        '[test.W3.valid.initial_adhesion]\nleast = 0.3\nsource = "nonsense"\n'
        "[test.W3.scenario.rail.random]\nmean = 0.045\nspread = 0.005\n"
        'correlation_length = "50 m"\n',
        encoding="utf-8",
    )
    profile, folder = read_profile(str(mine))
    ready = Programme(profile, folder, "emu_four_car", "conventional")
    records = {one.name: one for one in ready.perform(("W3", "X5-60"))}
    assert "only 0 of 2 runs were valid after 4 tries" in records["W3"].problem
    assert "test.W3.scenario.rail" in records["W3"].problem
    assert len(records["X5-60"].valid) == 2  # the others are kept
    assert protocol(ready, list(records.values()), "mine")["summary"]["incomplete"] == 1


def test_an_own_metric_and_an_own_test_need_no_more_than_this(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(
        "def mean_pressure(run):\n"
        '    """Mean cylinder pressure."""\n'
        '    return float(run["brake_cylinder_pressure"].mean())\n\n\n'
        'mean_pressure.unit = "Pa"\n',
        encoding="utf-8",
    )
    (tmp_path / "mine.toml").write_text(
        'title = "Mine"\nrepetitions = 2\n[metric]\nmean_pressure = "mine.py:mean_pressure"\n'
        '[test.N1]\ntitle = "Own"\nneeds = []\n'
        '[test.N1.scenario]\nrun = { speed = "60 km/h" }\nrail = { condition = "dry" }\n'
        '[test.N1.limit.mean_pressure]\nleast = "1 bar"\nsource = "ours"\n',
        encoding="utf-8",
    )
    profile, folder = read_profile(str(tmp_path / "mine.toml"))
    ready = Programme(profile, folder, "emu_four_car", "conventional")
    (record,) = ready.perform()
    assert record.limits[0].held.verdict == "kept"
    assert 1e5 < float(np.mean(record.figures("mean_pressure"))) < 3.5e5
