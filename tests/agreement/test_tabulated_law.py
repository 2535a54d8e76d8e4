"""A law computed at every step and its table must agree; so must a run alone and among others."""

from __future__ import annotations

import math
from importlib.metadata import EntryPoint
from typing import Any

import numpy as np
import pytest
from tests.agreement.test_second_order import REFERENCE, STEPS, Replay
from tests.conftest import Coach

import railgrip as rg
from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import (
    Creepage,
    CreepForce,
    RollingContact,
    rolling_contact,
)
from railgrip.core import registry
from railgrip.core.errors import RailgripError
from railgrip.engine import kept_tables
from railgrip.laboratory.tabulate import tabulate

SHEN = "railgrip.contact.shen_hedrick_elkins_1983"
WET = {
    "static_friction": 0.11, "friction_ratio": 0.4, "friction_decay": 0.2,
    "adhesion_reduction": 0.3, "slip_reduction": 0.1,
}  # fmt: skip
"""Polach's wet rail, but so slippery that every wheel slides."""
ROLLING = "railgrip.rolling_laws"


def local_law(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Half the patch has the friction of the centre's slip, the other half that of half as much."""
    size = abs(creepage.longitudinal)
    linear = contact.shear_modulus * contact.a * contact.b * contact.c11 * size / contact.load
    force = 0.0
    for share in (1.0, 0.5):
        friction = falling_friction(rail, share * speed * size)
        force += 0.5 * contact.load * friction * linear / (friction + linear)
    return CreepForce(math.copysign(force, creepage.longitudinal), 0.0, 0.0)


def rough_law(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """A law that follows no similarity: it thinks in metres per second."""
    share = math.tanh(1e3 * abs(creepage.longitudinal))
    return CreepForce(contact.load * rail.static_friction * share / (1.0 + 0.1 * speed), 0.0, 0.0)


@pytest.fixture(autouse=True)
def further_laws(monkeypatch: pytest.MonkeyPatch) -> None:
    laws = registry._entries(ROLLING)
    for name, value in {
        "tabulated_polach": "railgrip.contact.polach_2005:polach_rolling",
        "tabulated_shen_hedrick_elkins_1983": f"{SHEN}:shen_hedrick_elkins_rolling",
        "tabulated_freibauer_1983": "railgrip.contact.freibauer_1983:freibauer_rolling",
        "local_law": f"{__name__}:local_law",
        "rough_law": f"{__name__}:rough_law",
    }.items():
        monkeypatch.setitem(laws, name, EntryPoint(name, value, ROLLING))


def four_cars(law: str, **further: Any) -> rg.Scenario:
    return rg.load("dry_emergency").with_(
        {
            "rail": {"condition": "wet"},
            "wsp.controller": "none",
            "run.creep_law": law,
            **further,
        }
    )


@pytest.mark.parametrize("slides", [False, True])
def test_a_stop_on_wet_rail_by_polach_and_by_its_table(slides: bool) -> None:
    """Four cars, rolling or sliding on the falling branch; demanded is 1e-4 of the distance."""
    rail = {"rail": {"condition": {"contaminated": WET, "clean": WET}}} if slides else {}
    built_in, table = (
        rg.simulate(four_cars(law, **rail)) for law in ("polach_2005", "tabulated_polach")
    )
    assert (float(built_in["axle_slide_time"].values.max()) > 5.0) == slides
    distance = built_in["stopping_distance"].values
    assert built_in.data.attrs["creep_law_error"] == 0.0
    assert 0.0 < table.data.attrs["creep_law_error"] < 1e-6
    np.testing.assert_allclose(table["stopping_distance"].values, distance, rtol=1e-6)
    np.testing.assert_allclose(
        table["train_speed"].values, built_in["train_speed"].values, atol=1e-3
    )
    np.testing.assert_allclose(
        table["adhesion_available"].values, built_in["adhesion_available"].values, atol=1e-6
    )


@pytest.mark.parametrize("law", ["fastsim_1982", "fastsim_elliptic_1982", "modified_fastsim_2013"])
def test_a_stop_by_a_slow_law(law: str) -> None:
    """With protection, cleaning and sand: load, speed and rail vary, the table holds for all."""
    result = rg.simulate(rg.load("detergent_160").with_({"run.creep_law": law}))
    assert result.status.name == "STOPPED"
    assert 0.0 < result.data.attrs["creep_law_error"] < 5e-5
    assert abs(float(result["energy_balance"].values[0])) < 1e-9
    assert 700.0 < float(result["stopping_distance"].values[0]) < 1100.0


@pytest.mark.parametrize(
    "further", [{}, {"run.angle_of_attack": "3 mrad"}], ids=["one curve", "several curves"]
)
def test_alone_and_among_others_the_same_bits(further: dict[str, Any]) -> None:
    scenario = rg.load("detergent_160").with_({"run.creep_law": "fastsim_1982", **further})
    speeds = np.linspace(20.0, 45.0, 20)
    batch = rg.simulate(scenario, runs=20, variations={"INITIAL_SPEED": speeds})
    for run in (0, 7, 19):
        alone = rg.simulate(scenario, variations={"INITIAL_SPEED": speeds[[run]]}, traces=False)
        for name in ("stopping_distance", "energy_contact", "axle_slide_time"):
            assert alone[name].values.tobytes() == batch[name].values[[run]].tobytes(), name


def errors(coach: Coach, law: str, angle: float = 0.0) -> np.ndarray:
    """Errors of a stop with slides, as in test_second_order, over the halvings of the step."""

    def distance(step: float) -> float:
        scenario = coach(
            0.12, friction_ratio=0.7, friction_decay=0.1, step=step, trace=0.02,
            brake={"fill_time": 2.0},
            train={
                "dump_valve": {"vent_delay": 0.0, "fill_delay": 0.0},
                "sensor": {"delay": 0.0},
                "resistance": {"constant": 2000.0, "quadratic": 4.0},
            },
            creep_law=law, angle_of_attack=angle,
        )  # fmt: skip
        result = rg.simulate(scenario, controller=Replay(works=True), traces=False)
        assert float(result["axle_slide_time"].values.max()) > 1.0
        return float(result["stopping_distance"].values[0])

    exact = distance(REFERENCE)
    return np.array([abs(distance(step) - exact) for step in STEPS])


@pytest.mark.parametrize(
    ("law", "angle"),
    [("tabulated_polach", 0.0), ("modified_fastsim_2013", 0.0), ("fastsim_1982", 0.003)],
)
def test_order_two(coach: Coach, law: str, angle: float) -> None:
    found = errors(coach, law, angle)
    assert np.log2(found[0] / found[-1]) / (len(STEPS) - 1) > 1.7, found


@pytest.mark.parametrize("law", ["shen_hedrick_elkins_1983", "freibauer_1983"])
def test_a_table_has_the_errors_of_its_law(coach: Coach, law: str) -> None:
    """Of these steeper curves 20 ms is a coarse step, by formula and by table: mean order 1.6."""
    table = errors(coach, f"tabulated_{law}")
    np.testing.assert_allclose(table, errors(coach, law), rtol=1e-4)
    assert np.log2(table[-2] / table[-1]) > 1.8


def test_an_angle_of_attack_flattens_the_curve(coach: Coach) -> None:
    """The same brake force needs more creepage; sliding, less force is left along the track."""
    rolling, sliding = [], []
    for angle in (0.0, 0.004, -0.004, 0.008):
        scenario = coach(0.3, creep_law="fastsim_1982", angle_of_attack=angle, trace=0.02)
        result = rg.simulate(scenario)
        middle = result["time"].values.size // 2
        speeds = result["wheel_speed"].values[0, 0, middle], result["train_speed"].values[0, middle]
        rolling.append(1.0 - float(speeds[0] / speeds[1]))
        scenario = coach(0.05, creep_law="fastsim_1982", angle_of_attack=angle)
        sliding.append(float(rg.simulate(scenario)["stopping_distance"].values[0]))
    assert rolling[1] == rolling[2]
    assert sliding[1] == sliding[2]
    assert rolling[0] < rolling[1] < rolling[3]
    assert sliding[0] < sliding[1] < sliding[3]


def test_a_friction_that_falls_in_each_point(coach: Coach) -> None:
    """Such a law gets an axis of its own, and grips better than with the slip of the centre."""
    rail = {"friction_ratio": 0.4, "friction_decay": 0.3}
    local = rg.simulate(coach(0.06, creep_law="local_law", **rail))
    whole = rg.simulate(coach(0.06, creep_law="shen_hedrick_elkins_1983", **rail))
    assert 1e-4 < local.data.attrs["creep_law_error"] < 0.01
    assert local["stopping_distance"].values[0] < 0.99 * whole["stopping_distance"].values[0]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            {"run.creep_law": "kalker_linear"},
            "run.creep_law: the law 'kalker_linear' cannot be tab",
        ),
        (
            {"run.creep_law": "rough_law"},
            "run.creep_law: a table of the law 'rough_law' is too far",
        ),
        (
            {"run.creep_law": "tabulated_polach", "rail": {"condition": "leaves"}},
            "'tabulated_polach' needs a rail with one adhesion_reduction; got 0.3, 1",
        ),
    ],
)
def test_what_cannot_be_a_table(change: dict[str, Any], sentence: str) -> None:
    with pytest.raises(RailgripError) as caught:
        rg.simulate(four_cars("fastsim_1982", **change))
    assert sentence in str(caught.value)


def test_a_law_without_lateral_creepage_has_no_angle(monkeypatch: pytest.MonkeyPatch) -> None:
    laws = registry._entries("railgrip.laws")
    entry = EntryPoint("plain", "railgrip.contact.polach_2005:polach_2005", "railgrip.laws")
    monkeypatch.setitem(laws, "plain", entry)
    scenario = four_cars("plain", **{"run.angle_of_attack": 0.003})
    with pytest.raises(
        RailgripError, match=r"run\.angle_of_attack: the creep law 'plain' knows no"
    ):
        rg.simulate(scenario)


def test_a_slow_law_of_ours_is_tabulated_once_for_all(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Any
) -> None:
    monkeypatch.setattr(kept_tables.numba.config, "CACHE_DIR", str(tmp_path))
    base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    made = []

    def make() -> Any:
        made.append(1)
        return tabulate("freibauer_1983", base, RailFriction(0.3, 1.0, 0.0, 1.0, 1.0), cells=16)

    first, again = (kept_tables.kept(("freibauer", 0.46), make) for _ in range(2))
    assert len(made) == 1
    assert first.curves.tobytes() == again.curves.tobytes()
    kept_tables.kept(("freibauer", 0.45), make)
    next(iter((tmp_path / "tables").iterdir())).write_text("spoilt")
    kept_tables.kept(("freibauer", 0.46), make)
    kept_tables.kept(("freibauer", 0.45), make)
    assert len(made) == 3


def test_the_exact_theory_stops_a_train() -> None:
    """Its table is within 1 % of the friction force; a dry stop hardly feels the creep law."""
    scenario = rg.load("coach_120").with_({"rail": {"condition": "wet"}})
    stops = {}
    for name in ("exact", "fastsim_1982"):
        changed = scenario.with_({"run.creep_law": name, "wsp.controller": "none"})
        stops[name] = float(rg.simulate(changed)["stopping_distance"].values[0])
    assert stops["exact"] == pytest.approx(stops["fastsim_1982"], rel=1e-4)
    assert stops["exact"] != stops["fastsim_1982"]
