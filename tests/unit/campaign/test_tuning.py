"""The tuner: what it is asked, what it finds, and what it does when it is interrupted."""

from __future__ import annotations

from pathlib import Path

import pytest

from railgrip.campaign.tuning import Tuning, _best, tune
from railgrip.campaign.tuning_judge import FAILED
from railgrip.campaign.tuning_plan import TuningPlan, read_tuning_plan
from railgrip.core.errors import RailgripError

PLAN = {
    "controller": "conventional",
    "parameters": {"slip_upper": {"low": 0.02, "high": 0.30, "log": True}},
    "scenario": [{"use": "leaves_160", "set": {"run.speed": "60 km/h"}}],
    "objective": {"stopping_distance": 1.0},
    "fixed": {"slip_lower": 0.01},
    "trials": 6,
}


def plan(**changes: object) -> TuningPlan:
    return TuningPlan.model_validate({**PLAN, **changes})


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> tuple[Tuning, Path]:
    folder = tmp_path_factory.mktemp("search")
    return tune(plan(), folder), folder


def test_the_best_is_the_least_of_all_that_were_tried(found: tuple[Tuning, Path]) -> None:
    tuning, _ = found
    assert len(tuning.trials) == 6
    assert tuning.untuned.score == (1.0,)
    assert tuning.best[0].score[0] == min(1.0, *(trial.score[0] for trial in tuning.trials))
    assert all(0.02 <= t.parameters["slip_upper"] <= 0.30 for t in tuning.trials)


def test_a_score_is_the_metric_over_the_untuned_one(found: tuple[Tuning, Path]) -> None:
    tuning, _ = found
    before = tuning.untuned.figures[0]["stopping_distance"]
    for trial in tuning.trials:
        assert trial.score[0] == pytest.approx(trial.figures[0]["stopping_distance"] / before)


def test_the_same_plan_finds_the_same(found: tuple[Tuning, Path], tmp_path: Path) -> None:
    again = tune(plan(), tmp_path / "again", threads=2)
    assert again.trials == found[0].trials


def test_an_interrupted_search_goes_on(tmp_path: Path) -> None:
    def stop_after_two(done: int, of: int, best: float) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        tune(plan(), tmp_path / "search", progress=stop_after_two)
    whole = tune(plan(), tmp_path / "search")
    assert len(whole.trials) == 6
    assert len({trial.parameters["slip_upper"] for trial in whole.trials}) == 6
    more = tune(plan(trials=8), tmp_path / "search")
    assert more.trials[:6] == whole.trials
    assert len(more.trials) == 8


def test_the_folder_of_another_search_is_left_alone(found: tuple[Tuning, Path]) -> None:
    _, folder = found
    before = sorted(path.read_bytes() for path in folder.iterdir())
    with pytest.raises(RailgripError, match="holds the search of another plan"):
        tune(plan(seed=2), folder)
    assert sorted(path.read_bytes() for path in folder.iterdir()) == before


def test_somebody_elses_folder_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "letter.txt").write_text("dear")
    with pytest.raises(RailgripError, match="is not empty and holds no search"):
        tune(plan(), tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["letter.txt"]


def test_what_the_controller_refuses_and_what_breaks_a_limit_is_never_the_best(
    tmp_path: Path,
) -> None:
    # slip_lower is fixed within the range: the controller refuses what lies below it
    refused = tune(plan(fixed={"slip_lower": 0.12}, trials=4), tmp_path / "refused")
    assert any(trial.score == (FAILED,) for trial in refused.trials)
    assert refused.best[0].keeps_limits
    limited = tune(plan(limit={"stopping_distance": "1 m"}, trials=2), tmp_path / "limited")
    assert not any(trial.keeps_limits for trial in limited.trials)
    assert min(trial.score[0] for trial in limited.trials) > 100.0


def test_a_front_holds_no_set_that_another_one_beats(tmp_path: Path) -> None:
    asked = plan(objective={}, front=["stopping_distance", "slid_energy"], trials=8)
    tuning = tune(asked, tmp_path / "front")
    scores = [trial.score for trial in tuning.best]
    assert scores == sorted(scores)
    assert [a[1] for a in scores] == sorted((a[1] for a in scores), reverse=True)
    assert _best(asked, tuning.untuned, tuning.trials) == tuning.best


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"objective": {"stoping_distance": 1.0}}, "did you mean 'stopping_distance'"),
        ({"objective": {"adhesion_utilisation": 1.0}}, "objective: metric 'adhesion_util"),
        ({"objective": {}}, "objective: give either objective or front"),
        ({"objective": {}, "front": ["air_used"]}, "front: needs two or three metrics"),
        ({"parameters": {"slip_upper": {"low": 0.3, "high": 0.1}}}, "high: must be above low"),
        ({"parameters": {"slip_upper": {"low": 0, "high": 0.1, "log": True}}}, "above 0 with log"),
        ({"scenario": []}, "scenario: "),
        ({"trials": 0}, "trials: "),
        ({"trails": 3}, "unknown key; did you mean 'trials'"),
    ],
)
def test_a_bad_plan_gets_a_sentence(tmp_path: Path, changes: dict[str, object], says: str) -> None:
    import tomli_w

    file = tmp_path / "plan.toml"
    file.write_text(tomli_w.dumps({**PLAN, **changes}))
    with pytest.raises(RailgripError) as caught:
        read_tuning_plan(file)
    assert says in str(caught.value)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"parameters": {"slip_uper": {"low": 0.1, "high": 0.3}}}, "did you mean 'slip_upper'"),
        ({"controller": "conventionl"}, "did you mean 'conventional'"),
        ({"scenario": [{"use": "leafs_160"}]}, "did you mean 'leaves_160'"),
        ({"fixed": {"slip_upper": 0.1}}, "is fixed and to be tuned"),
    ],
)
def test_what_does_not_exist_is_told_before_anything_runs(
    tmp_path: Path, changes: dict[str, object], says: str
) -> None:
    with pytest.raises(RailgripError) as caught:
        tune(plan(**changes), tmp_path / "search")
    assert says in str(caught.value)
