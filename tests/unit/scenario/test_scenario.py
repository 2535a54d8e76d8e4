import pytest
from pydantic import ValidationError

from railgrip.core.errors import RailgripError
from railgrip.scenario import Scenario


def problems(table):
    with pytest.raises(RailgripError) as caught:
        Scenario(**table)
    return str(caught.value).splitlines()


def test_everything_is_held_in_si(table):
    scenario = Scenario(**table)
    assert scenario.run.speed == pytest.approx(160 / 3.6)
    assert scenario.train.brakes["disc"].cylinder_pressure == 300000.0
    assert scenario.line.use.length == 5000.0


def test_frozen(table):
    with pytest.raises(ValidationError, match="frozen"):
        Scenario(**table).run.speed = 1.0


def test_all_problems_at_once(table):
    table["train"]["vehicle"][0]["tare"] = "-44 t"
    table["train"]["vehicle"][1]["bogie"][0]["axle"][0]["wheel_radus"] = "0.4 m"
    table["run"]["speed"] = "700 km/h"
    table["rail"]["condition"] = "wett"
    table["wsp"] = {"controller": "conventionl"}
    lines = problems(table)
    assert len(lines) == 5
    assert (
        "train.vehicle[0].tare: is out of range; got -44000 kg; "
        "allowed: more than 0 kg and at most 500000 kg" in lines
    )
    assert any(
        line.startswith("train.vehicle[1].bogie[0].axle[0].wheel_radus: unknown key; did you")
        for line in lines
    )
    assert (
        "run.speed: is out of range; got 700 km/h; allowed: at least 0 km/h and at most 600 km/h"
    ) in lines
    assert any("did you mean 'wet'?" in line for line in lines)
    assert any("did you mean 'conventional'?" in line for line in lines)


@pytest.mark.parametrize(
    ("given", "held"),
    [
        ("emergency", [(0.0, 1.0, True)]),
        ("service", [(0.0, 1.0, False)]),
        ("none", [(0.0, 0.0, False)]),
        (0.5, [(0.0, 0.5, False)]),
        ("50 %", [(0.0, 0.5, False)]),
        (
            [{"at": "2 s", "level": "service"}, {"at": 3, "level": "emergency"}],
            [(2.0, 1.0, False), (3.0, 1.0, True)],
        ),
    ],
)
def test_demand(table, given, held):
    table["run"]["demand"] = given
    points = Scenario(**table).run.demand
    assert [(point.at, point.level, point.emergency) for point in points] == held


@pytest.mark.parametrize(
    ("part", "change", "message"),
    [
        ("run", {"demand": []}, "run.demand: must not be empty"),
        ("run", {"demand": "half"}, "run.demand[0]: is no brake demand; got 'half'"),
        ("run", {"demand": 1.5}, "run.demand[0].level: is out of range; got 1.5"),
        (
            "run",
            {"demand": [{"at": 2, "level": 1}, {"at": 1, "level": 0}]},
            "run.demand[1].at: must be later than the entry before it",
        ),
        ("run", {"step": "30 ms"}, "run.step: is out of range; got 0.03 s"),
        ("run", {"step": "0.5 ms"}, "run.step: is out of range"),
        ("run", {"step": "10 ms", "trace": "15 ms"}, "run.trace: must be a multiple"),
        ("run", {"speed": float("nan")}, "run.speed: must be a finite number"),
        ("run", {"creep_law": "polach"}, "did you mean 'polach_2005'?"),
        ("run", {"creep_law": "fastsim"}, "did you mean 'fastsim_1982'?"),
        ("run", {"angle_of_attack": "6 deg"}, "run.angle_of_attack: is out of range"),
        ("run", {"seed": -1}, "run.seed: is out of range"),
        ("run", {"seed": 1.5}, "run.seed: must be a whole number"),
        ("line", {"start": "5 km"}, "line.start: lies beyond the end of the line; got 5000 m"),
        ("line", {"use": "nowhere"}, "line.use: line 'nowhere' unknown; known: "),
        ("line", {"use": {"length": 0}}, "line.use.length: is out of range; got 0 m"),
        (
            "line",
            {"use": {"length": 100, "speed_limit": [{"at": 5, "value": 9}, {"at": 5, "value": 8}]}},
            "line.use.speed_limit[1].at: must lie beyond",
        ),
        (
            "line",
            {"use": {"length": 100, "gradient": [{"at": 500, "value": "3 ‰"}]}},
            "line.use.gradient[0].at: lies beyond the end of the line",
        ),
        ("rail", {"patch": 3}, "rail.patch: must be a list"),
        ("wsp", {"parameters": {"slip": "5 foo"}}, "wsp.parameters.slip: is no number"),
        (
            "limits",
            {"stopping_distance": 800, "stopping_distance_least": 900},
            "limits.stopping_distance_least: contradicts stopping_distance",
        ),
        (
            "limits",
            {"stopping_distance": "500 m", "mean_deceleration_greatest": 1.0},
            "limits.stopping_distance: contradicts mean_deceleration_greatest at this speed",
        ),
        ("load", {"state": "laden", "share": 0.5}, "load.share: contradicts the state"),
        ("load", "fulll", "load.state: state 'fulll' unknown"),
    ],
)
def test_scenario_that_cannot_be(table, part, change, message):
    here = table.get(part)
    table[part] = {**here, **change} if isinstance(here, dict) else change
    assert any(message in line for line in problems(table)), problems(table)


def patch(begin, end):
    return {"from": begin, "to": end, "condition": {"contaminated": {"static_friction": 0.02}}}


@pytest.mark.parametrize(
    ("patches", "message"),
    [
        ([patch(9, 9)], "rail.patch[0].to: must lie beyond 'from'"),
        ([patch(100, 200), patch(50, 101)], "rail.patch[0]: overlaps patch[1]"),
        ([patch(6000, 7000)], "rail.patch[0].from: lies beyond the end of the line; got 6000 m"),
    ],
)
def test_patches_that_cannot_be(table, patches, message):
    table["rail"]["patch"] = patches
    assert any(message in line for line in problems(table)), problems(table)


def test_patches_may_touch(table):
    table["rail"]["patch"] = [patch(100, 200), patch("0 m", "100 m")]
    assert [stretch.begin for stretch in Scenario(**table).rail.patch] == [100.0, 0.0]


def test_no_adhesion_at_all_is_legal(table):
    table["rail"]["condition"]["contaminated"]["static_friction"] = 0
    assert Scenario(**table).rail.condition.clean.static_friction == 0.0


def test_slip_part_is_not_above_adhesion_part(table):
    table["rail"]["condition"]["contaminated"].update(adhesion_reduction=0.3, slip_reduction=0.5)
    assert "rail.condition.contaminated.slip_reduction" in problems(table)[0]


def test_names_resolve_to_whole_models():
    scenario = Scenario(train="emu_four_car", rail={"condition": "leaves"})
    assert scenario.train.n_axles == 16
    assert 0 < scenario.rail.condition.contaminated.static_friction < 0.15
    assert scenario.train.brakes["trailer"].pad.law == "piecewise"


def test_line_of_another_format_by_name(table):
    table["line"] = {"use": "st_gallen_wil"}
    assert Scenario(**table).line.use.length > 10e3


def test_with_lays_over_and_checks(table):
    scenario = Scenario(**table)
    changed = scenario.with_(
        {"run.speed": "36 km/h", "train.vehicle[0].tare": "50 t"}, rail={"condition": "wet"}
    )
    assert changed.run.speed == 10.0
    assert [vehicle.tare for vehicle in changed.train.vehicle] == [50e3, 44e3, 44e3]
    assert scenario.run.speed != 10.0
    with pytest.raises(RailgripError, match=r"run\.speed: is out of range"):
        scenario.with_(run={"speed": "700 km/h"})
    with pytest.raises(RailgripError, match="no entry"):
        scenario.with_({"train.vehicle[7].tare": 1})
    with pytest.raises(RailgripError, match="is no key path"):
        scenario.with_({"run..speed": 1})
    assert scenario.with_() == scenario


def test_with_a_new_radius_is_believed_too(table):
    changed = Scenario(**table).with_({"train.vehicle[0].bogie[0].axle[0].wheel_radius": "0.46 m"})
    assert changed.train.axles()[0].axle.believed_radius == 0.46


def test_another_pad_law_or_controller_starts_afresh(table):
    scenario = Scenario(**table).with_(wsp={"parameters": {"a": 1}})
    changed = scenario.with_(
        {"train.brakes.disc.pad": {"law": "karwatzki_1950"}}, wsp={"controller": "none"}
    )
    assert changed.train.brakes["disc"].pad.law == "karwatzki_1950"
    assert changed.wsp.parameters == {}
    assert scenario.with_(wsp={"controller": "conventional"}).wsp.parameters == {"a": 1.0}


def test_prints_in_a_few_lines(table):
    text = str(Scenario(**table))
    assert "3 vehicles, 12 axles" in text
    assert "from 160 km/h, emergency at 0 s" in text
    assert len(text.splitlines()) <= 6
