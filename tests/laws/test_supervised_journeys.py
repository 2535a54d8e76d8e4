"""What holds of any journey under ETCS supervision."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from railgrip.control.etcs.ceiling import ceiling_margin
from railgrip.control.etcs.limit_table import EBI, INDICATION, PERMITTED
from railgrip.control.etcs.supervised_way import excess
from railgrip.core.errors import RailgripError
from railgrip.engine.journey.coasting import coasting_of
from railgrip.engine.journey.drive import JourneyRun, drive
from railgrip.engine.journey.following import authority_of, follow
from railgrip.engine.journey.supervision import Onboard
from railgrip.engine.journey.watching import Watched, watched
from railgrip.scenario.journey import Journey

TRAIN = {
    "mass": "200 t",
    "rotating": 0.06,
    "length": "120 m",
    "max_speed": "140 km/h",
    "effort": {"force": "180 kN", "power": "3 MW"},
    "resistance": {"constant": 2.5e3, "linear": 30.0, "quadratic": 6.0},
    "max_deceleration": 3.0,
}
BRAKE = {
    "length": "120 m",
    "rotating_mass": 0.06,
    "emergency": [{"value": 1.2}, {"from": "90 km/h", "value": 1.0}],
    "service": [{"value": 0.9}],
    "emergency_time": 2.5,
    "service_time": 3.0,
    "kdry": [{"confidence_level": 9, "steps": [{"value": 0.85}]}],
}
LIMITS = [
    {"at": 0, "value": "140 km/h"},
    {"at": 4000, "value": "80 km/h"},
    {"at": 5500, "value": "120 km/h"},
]


def journey(
    mode: str = "report",
    *,
    hills: tuple[float, ...] = (0.0,),
    brake: dict[str, Any] | None = None,
    braking: float = 1.6,
    more: dict[str, Any] | None = None,
    **own: Any,
) -> Journey:
    """9 km with a restriction, and a driver who brakes at 1.6 m/s²."""
    gradient = [{"at": 1200.0 * k, "value": value} for k, value in enumerate(hills)]
    return Journey(
        train=TRAIN,
        line={"length": 12e3, "speed_limit": LIMITS, "gradient": gradient},
        stop=[{"at": 0.0}, {"at": 9000.0}],
        braking=braking,
        supervision={"mode": mode, "train": {**BRAKE, **(brake or {})}, **own},
        **(more or {}),
    )


def said(run: JourneyRun) -> Watched:
    return watched(
        run.journey, *(run.trace[name] for name in ("time", "position", "speed")), run.told
    )


def over(run: JourneyRun) -> np.ndarray:
    way = Onboard(run.journey).way(np.inf, 9000.0)
    return excess(way, run.trace["position"], run.trace["speed"])


def balance(run: JourneyRun) -> float:
    e = run.energy
    left = e["traction"] - e["motor_brake"] - e["friction"] - e["resistance"] - e["grade"]
    return abs(left) / e["traction"]


QUICK = (Phase.explicit, Phase.generate)
hills = st.lists(st.floats(-0.02, 0.02), min_size=1, max_size=8).map(tuple)


@settings(max_examples=12, deadline=None)
@given(hills, st.floats(0.3, 1.6), st.sampled_from([0.0, 15.0 / 3.6]))
def test_driven_below_the_permitted_speed_it_never_is_above_it(
    hill: tuple[float, ...], braking: float, release: float
) -> None:
    run = drive(journey("drive", hills=hill, braking=braking, release_speed=release))
    assert over(run)[PERMITTED].max() <= 1e-6
    assert run.trace["position"][-1] == pytest.approx(9000.0, abs=1e-3)
    assert balance(run) < 1e-5
    assert {one.status for one in said(run).log} <= {"normal", "indication"}


def test_driving_below_the_permitted_speed_costs_time() -> None:
    free, kept = drive(journey()), drive(journey("drive"))
    assert free.running_time + 3.0 < kept.running_time < 1.1 * free.running_time
    coasting = journey("drive", more={"coasting": {"coasting_deceleration": 0.1}})
    assert over(drive(coasting, coasting_of(coasting)))[PERMITTED].max() <= 1e-6


@settings(max_examples=15, deadline=None, phases=QUICK)
@given(
    hills, st.floats(0.7, 1.0), st.booleans(), st.floats(0.0, 5.0), st.floats(1.0, 60.0),
    st.booleans(),
)  # fmt: skip
def test_on_rail_as_assumed_no_train_passes_the_end_of_authority(
    hill: tuple[float, ...], wet: float, interface: bool, time: float, past: float, areas: bool
) -> None:
    """A driver who would brake at 1.6 m/s² where the rail gives less than 1; 5 cm of tables."""
    brake = {
        "kwet": [{"value": wet}],
        "service_brake_interface": interface,
        "emergency_time": time,
    }
    low = [{"from": 7000.0, "to": 8400.0}] if areas else []
    run = drive(
        journey("intervene", hills=hill, brake=brake, rail="assumed", past_stop=past,
                reduced_adhesion=low)
    )  # fmt: skip
    assert run.interventions
    assert run.trace["position"].max() <= 9000.0 + past + 0.05
    before = np.interp(4000.0, run.trace["position"], run.trace["speed"])
    assert before <= 80 / 3.6 + ceiling_margin(80 / 3.6) + 1e-3
    assert run.trace["speed"][-1] == pytest.approx(0.0, abs=1e-6)
    assert balance(run) < 2e-5


def test_an_emergency_brake_as_assumed_stops_at_the_supervised_location() -> None:
    """What EBI is made for: past it the train stands right there, 5 cm of tables."""
    brake = {"service_brake_interface": False}
    run = drive(journey("intervene", brake=brake, rail="assumed", past_stop=1.0, overlap=80.0))
    last = run.interventions[-1]
    assert last.brake == "emergency"
    assert last.target == 9001.0
    near = drive(
        journey("intervene", brake={**brake, "service": [{"value": 3.0}]}, rail="assumed",
                past_stop=1.0, overlap=80.0, braking=3.0)
    )  # fmt: skip
    assert near.trace["position"][-1] == pytest.approx(9081.0, abs=0.05)


def test_a_late_driver_is_braked_and_stops() -> None:
    brake = {"service_brake_interface": True}
    free, run = (drive(journey(mode, brake=brake)) for mode in ("report", "intervene"))
    assert over(free)[EBI].max() > 0.0
    assert [one.brake for one in run.interventions] == ["service", "service"]
    assert [one.target for one in run.interventions] == [4000.0, 9050.0]
    assert over(run)[EBI].max() <= 1e-6
    assert run.trace["position"][-1] == pytest.approx(9000.0, abs=1e-3)
    assert run.running_time > free.running_time
    assert balance(run) < 1e-5
    statuses = [one.status for one in said(run).log]
    assert "service brake" in statuses
    assert "emergency brake" not in statuses


@pytest.mark.parametrize("rail", ["dry", "assumed"])
def test_every_leg_has_its_own_end_of_authority(rail: str) -> None:
    one = journey("intervene", brake={"service_brake_interface": True}, rail=rail)
    stops = ({"at": 0.0}, {"at": 3000.0, "dwell": 60.0}, {"at": 9000.0})
    three = Journey.model_validate(one.model_dump(by_alias=True) | {"stop": stops})
    run = drive(three)
    assert [one.target for one in run.interventions] == [3050.0, 4000.0, 9050.0]
    assert run.running_times.size == 2
    stands = run.trace["position"][run.trace["speed"] < 1e-6]
    assert ((stands > 2900.0) & (stands <= 3050.0)).any()
    assert run.trace["position"][-1] <= 9050.0
    assert balance(run) < 2e-5
    assert {one.target for one in said(run).approaches} >= {3050.0, 9050.0}


def test_without_a_service_brake_interface_the_train_is_stopped() -> None:
    """The emergency brake to a stand, then on to the restriction and the stop."""
    run = drive(journey("intervene"))
    assert [one.brake for one in run.interventions] == ["emergency", "emergency"]
    assert all(one.end[2] == pytest.approx(0.0, abs=1e-6) for one in run.interventions)
    assert run.trace["position"][-1] == pytest.approx(9000.0, abs=0.02)


def test_a_driver_in_time_is_left_alone() -> None:
    kept, watched_only = drive(journey("intervene", braking=0.5)), drive(journey(braking=0.5))
    assert kept.interventions == []
    assert kept.running_time == pytest.approx(watched_only.running_time, rel=1e-12)
    assert kept.energy == pytest.approx(watched_only.energy, rel=1e-12)


@settings(max_examples=8, deadline=None)
@given(hills, st.floats(0.6, 0.95), st.floats(0.02, 0.3))
def test_a_stricter_wet_factor_makes_every_indication_earlier(
    hill: tuple[float, ...], wet: float, stricter: float
) -> None:
    """Where the emergency brake decides; here the service brake is strong."""
    strong = {"service": [{"value": 2.0}]}
    found = [
        said(drive(journey(hills=hill, brake={**strong, "kwet": [{"value": value}]})))
        for value in (wet, wet - stricter)
    ]
    plain, strict = ({one.target: one for one in way.approaches} for way in found)
    assert plain.keys() == strict.keys() == {4000.0, 9050.0}
    for target, one in strict.items():
        assert one.passed[INDICATION] > plain[target].passed[INDICATION] + 0.1
        assert (one.margin < plain[target].margin).all()


def test_behind_a_leader_the_front_stays_within_the_authority() -> None:
    """Renewed authorities are ends of authority, and the late driver is braked before each."""
    brake = {"service_brake_interface": True}
    leader = {"train": "freight", "headway": 120.0, "renewal": 20.0}
    for mode in ("drive", "intervene"):
        one = journey(mode, brake=brake, more={"leader": leader})
        run, authority = follow(one), authority_of(one)
        ends = np.array([authority.end(float(moment)) for moment in run.trace["time"]])
        assert np.all(run.trace["position"] <= ends + 1e-6)
        assert balance(run) < 1e-4
        kinds = {one.kind for one in said(run).approaches}
        assert "train ahead" in kinds
        if mode == "drive":
            assert {one.status for one in said(run).log} <= {"normal", "indication"}
        else:
            assert len(run.interventions) > 2


@pytest.mark.parametrize(
    ("own", "sentence"),
    [
        ({"mode": "drive", "past_stop": 0.0}, "supervision.past_stop: so near the stop"),
        ({"mode": "brake"}, "supervision.mode"),
        ({"national": {"confidence_level": 5}}, "supervision.train.kdry: has no steps"),
        ({"reduced_adhesion": [{"from": 9.0, "to": 3.0}]}, "must lie beyond 'from'"),
        ({"past_stop": -1.0}, "supervision.past_stop"),
    ],
)
def test_bad_tables_are_refused(own: dict[str, Any], sentence: str) -> None:
    from railgrip.io.checked import checked

    described = journey().model_dump(by_alias=True)
    described["supervision"] = {**described["supervision"], **own}
    with pytest.raises(RailgripError, match=sentence.replace(".", r"\.")):
        checked(Journey, described, "a.toml")  # type: ignore[arg-type]


def test_what_does_not_fit_is_refused() -> None:
    with pytest.raises(ValueError, match="less than that of the train itself"):
        journey(brake={"length": 60.0})
    with pytest.raises(ValueError, match="an ETCS authority comes in messages"):
        journey(more={"leader": {"train": "freight", "renewal": 0.0}})
    weak = journey(hills=(-0.02,), brake={"emergency": [{"value": 0.15}]})
    with pytest.raises(RailgripError, match=r"supervision.train: EBD.*does not slow the train"):
        said(drive(weak))
    with pytest.raises(RailgripError, match="supervision: is missing"):
        Onboard(Journey(train="local", line="const"))
