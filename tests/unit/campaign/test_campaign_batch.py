"""Batches of a campaign: arrays give what single scenarios give, in any chunking."""

from pathlib import Path

import numpy as np
import pytest

import railgrip as rg
from railgrip.campaign.batch import Batches
from railgrip.campaign.campaign_file import campaign_from
from railgrip.core.errors import RailgripError
from railgrip.core.status import RunStatus

AXLES = "train.vehicle[*].bogie[*].axle[*]"


def bell(spread: float) -> dict:
    return {"kind": "normal", "mean": 1, "deviation": spread}


def campaign(*variables: dict, folder: Path = Path(), **more):
    table = {"scenario": "wagon_100", "runs": 64, "variable": list(variables), **more}
    return campaign_from(table, folder)


FRICTION = {
    "quantity": f"{AXLES}.friction_factor", "name": "friction", "scope": "axle",
    "distribution": bell(0.05),
}  # fmt: skip
SPEED = {
    "quantity": "run.speed", "name": "speed",
    "distribution": {"kind": "uniform", "low": "98 km/h", "high": "102 km/h"},
}  # fmt: skip
MASS = {
    "quantity": "train.vehicle[*].tare", "name": "mass", "apply": "factor",
    "distribution": bell(0.02),
}  # fmt: skip
ISOLATED = {
    "quantity": f"{AXLES}.isolated", "name": "isolated", "scope": "bogie",
    "distribution": {"kind": "event", "probability": 0.3},
}  # fmt: skip
RAIL = {
    "quantity": "rail.condition", "name": "rail",
    "distribution": {"kind": "discrete", "values": ["dry", "low"]},
}  # fmt: skip


@pytest.fixture(scope="module")
def batches() -> Batches:
    return Batches(campaign(FRICTION, SPEED, MASS, ISOLATED, RAIL))


def test_a_run_is_the_same_in_any_chunk(batches) -> None:
    whole = batches.table(0, 48)
    for first, last in ((0, 7), (7, 48), (20, 21)):
        part = batches.table(first, last)
        for name, values in part.items():
            np.testing.assert_array_equal(values, whole[name][first:last], err_msg=name)
    assert batches.apart == ["rail"]


def test_a_run_is_what_its_scenario_written_out_gives(batches) -> None:
    """To 1e-5 of the distance: the contact's slope comes from a spline, knots of 1e-5."""
    table = batches.table(0, 24)
    base = batches.campaign.base()
    for run in (0, 11, 23):
        train = base.train.model_dump(by_alias=True, exclude_unset=True)
        for vehicle in train["vehicle"]:
            vehicle["tare"] *= float(table["mass"][run])
            bogies = [b for b in vehicle["bogie"] for _ in range(b.get("count", 1))]
            vehicle["bogie"] = []
            for j, bogie in enumerate(bogies):
                axles = [a for a in bogie["axle"] for _ in range(a.get("count", 1))]
                own = []
                for k, axle in enumerate(axles):
                    factor = float(table[f"friction_V1_B{j + 1}_A{k + 1}"][run])
                    out = bool(table[f"isolated_V1_B{j + 1}"][run])
                    own.append({**axle, "count": 1, "friction_factor": factor, "isolated": out})
                vehicle["bogie"].append({**bogie, "count": 1, "axle": own})
        single = base.with_(
            {
                "train": train,
                "run.speed": float(table["speed"][run]),
                "rail.condition": str(table["rail"][run]),
            }
        )
        distance = float(rg.simulate(single).data["stopping_distance"].values[0])
        assert table["stopping_distance"][run] == pytest.approx(distance, rel=1e-5)


def test_a_random_rail_belongs_to_the_run() -> None:
    field = {"mean": 0.1, "spread": 0.03, "correlation_length": "100 m"}
    on_rail = Batches(campaign(set={"rail.random": field, "run.speed": "60 km/h"}))
    whole = on_rail.table(0, 20)["stopping_distance"]
    assert len(set(whole.tolist())) > 15
    np.testing.assert_array_equal(on_rail.table(13, 20)["stopping_distance"], whole[13:])


def test_an_impossible_draw_is_kept_as_such() -> None:
    wild = {**FRICTION, "scope": "train", "distribution": bell(1.0)}
    table = Batches(campaign(wild)).table(0, 60)
    impossible = (table["friction"] < 0) | (table["friction"] > 3)
    assert 3 < impossible.sum() < 20
    np.testing.assert_array_equal(table["status"] == RunStatus.IMPOSSIBLE, impossible)
    assert np.isnan(table["stopping_distance"][impossible]).all()
    braked = ~impossible & (table["friction"] > 0.5)
    assert np.isfinite(table["stopping_distance"][braked]).all()


def test_texts_mean_what_they_mean_in_the_scenario() -> None:
    """A temperature in kelvin, a deviation of some degrees, a percentage that is held as one."""
    kelvin = {"kind": "normal", "mean": "293.15 K", "deviation": "5 K"}
    ambient = {"quantity": "run.ambient", "name": "ambient", "distribution": kelvin}
    inner = {"kind": "uniform", "low": "60 km/h", "high": "20 m/s"}
    cut = {**SPEED, "distribution": {"kind": "truncated", "of": inner, "low": "65 km/h"}}
    normal, truncated = (one.distribution for one in campaign(ambient, cut).variable)
    assert (normal.mean, normal.deviation) == pytest.approx((20.0, 5.0))
    assert truncated.ppf(np.array([1e-12, 1.0])) == pytest.approx([65 / 3.6, 20.0])


def test_a_sample_may_stand_in_a_mixture(tmp_path) -> None:
    (tmp_path / "speeds.csv").write_text("day,speed\n1,20\n2,21\n3,22\n", encoding="utf-8")
    sample = {"kind": "empirical", "file": "speeds.csv", "column": "speed"}
    parts = [{"weight": 1, "of": sample}, {"weight": 1, "of": bell(0.1)}]
    mixed = {**SPEED, "distribution": {"kind": "mixture", "parts": parts}}
    found = campaign(mixed, folder=tmp_path).variable[0].distribution
    assert found.parts[0].of.values == (20.0, 21.0, 22.0)
    assert 20 < found.ppf(np.array([0.8]))[0] < 22


def test_correlated_draws_are_correlated() -> None:
    other = {**SPEED, "distribution": {"kind": "lognormal", "mean": 27.0, "deviation": 0.5}}
    together = {"variables": ["mass", "speed"], "matrix": [[1, 0.8], [0.8, 1]]}
    drawn = Batches(campaign(MASS, other, correlation=[together])).drawing.draw(0, 4000)
    assert np.corrcoef(drawn["mass"], drawn["speed"])[0, 1] == pytest.approx(0.8, abs=0.03)


def test_own_figures(tmp_path) -> None:
    (tmp_path / "mine.py").write_text(
        "def spread(figures):\n    return {'spread': figures['axle_slid_energy'].max(axis=1)}\n"
        "def wrong(figures):\n    return {'spread': figures['axle_slid_energy']}\n",
        encoding="utf-8",
    )
    good = campaign(FRICTION, collector="mine.py:spread", folder=tmp_path)
    assert Batches(good).table(0, 17)["spread"].shape == (17,)
    with pytest.raises(RailgripError, match="one value for each run as 'spread'"):
        Batches(campaign(collector="mine.py:wrong", folder=tmp_path)).table(0, 17)
    with pytest.raises(RailgripError, match="holds no function 'gone'"):
        Batches(campaign(collector="mine.py:gone", folder=tmp_path))


@pytest.mark.parametrize(
    ("variable", "sentence"),
    [
        ({**FRICTION, "quantity": "train.vehicle[*].tara"}, "key 'tara' unknown.*'tare'"),
        ({**FRICTION, "quantity": "train.vehicle[9].tare"}, "no entry"),
        ({**SPEED, "scope": "axle"}, "does not belong to single axles"),
        ({**SPEED, "distribution": {"kind": "event", "probability": 0.5}}, "is a number"),
        ({**ISOLATED, "distribution": bell(1)}, "true or false"),
        ({**RAIL, "apply": "factor"}, "no number"),
        ({**SPEED, "quantity": "rail.random.mean"}, "does not have"),
        (
            {
                **RAIL,
                "distribution": {
                    "kind": "discrete",
                    "values": ["dry", "low", "lowe"],
                    "weights": [45, 45, 10],
                },
            },
            "as drawn, .*'lowe' unknown.*did you mean 'low'",
        ),
        (
            {**SPEED, "distribution": {"kind": "uniform", "low": "-72 km/h", "high": "-36 km/h"}},
            r"variable\[0\].distribution: nothing that it draws is possible for speed; "
            r"got -71.* km/h to -36.* km/h; allowed: at least 0 km/h and at most 600 km/h",
        ),
        ({**SPEED, "distribution": {"kind": "normal", "mean": 1e9, "deviation": 1}}, "possible"),
    ],
)
def test_quantities_that_are_none_are_refused(variable, sentence) -> None:
    with pytest.raises(RailgripError, match=sentence):
        Batches(campaign(variable))


@pytest.mark.parametrize(
    ("more", "sentence"),
    [
        ({"variable": [SPEED, SPEED]}, "name of another column"),
        ({"variable": [SPEED, {**MASS, "name": "Speed"}]}, "name of another column"),
        ({"variable": [{**SPEED, "distribution": {"mean": 20}}]}, r"distribution: has no 'kind'"),
        (
            {"variable": [{**SPEED, "distribution": {"kind": "gauss"}}]},
            r"distribution\.kind: kind 'gauss' unknown; known: discrete",
        ),
        (
            {"variable": [{**SPEED, "distribution": {**bell(-2)}}]},
            r"variable\[0\]\.distribution\.deviation: must be more than 0; got -2",
        ),
        (
            {"variable": [{**SPEED, "distribution": {**bell(1), "mean": "80 kg"}}]},
            r"distribution\.mean: has a unit that does not fit; got '80 kg'.*in m/s",
        ),
        (
            {"until": {"width": "2 s"}},
            r"until\.width: has a unit that does not fit; got '2 s'; allowed: a number in m",
        ),
        (
            {"until": {"statistic": "exceedance", "threshold": "5 s", "width": "2 %"}},
            r"until\.threshold: has a unit that does not fit; got '5 s'",
        ),
        (
            {"variable": [{**SPEED, "distribution": {"kind": "mixture", "parts": []}}]},
            r"parts: must have at least 2 entries; got a list of 0",
        ),
        ({"keep": ["stoping_distance"]}, "did you mean 'stopping_distance'"),
        (
            {"correlation": [{"variables": ["speed", "mass"], "matrix": [[1, 1.2], [1.2, 1]]}]},
            "not positive definite",
        ),
        ({"correlation": [{"variables": ["speed", "mas"], "matrix": [[1, 0], [0, 1]]}]}, "mass"),
    ],
)
def test_files_that_contradict_themselves_are_refused(more, sentence) -> None:
    table = {"scenario": "wagon_100", "variable": [SPEED, MASS], **more}
    with pytest.raises(RailgripError, match=sentence):
        campaign_from(table, Path())
