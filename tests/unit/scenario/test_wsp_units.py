"""Every axle belongs to exactly one computer of the protection."""

import pytest

import railgrip as rg
from railgrip.core.errors import RailgripError
from railgrip.engine.mixture import Mixture, mixture, protection
from railgrip.engine.simulate import prepare
from railgrip.scenario import Scenario

FRONT = {"controller": "adaptive", "vehicles": [1, 2]}
REAR = {"vehicles": [3, 4]}


def scenario(*units, **more):
    return rg.load("leaves_160").with_({"wsp": {"unit": list(units), **more}})


@pytest.mark.parametrize(
    ("units", "message"),
    [
        ([FRONT, {"vehicles": [2, 3, 4]}], "an axle belongs to two units; got C1-V2-B1-A1"),
        ([FRONT], "wsp.unit: axles without a unit; got C1-V3-B1-A1, .* and 4 more; try: a unit"),
        ([FRONT, {"vehicles": [3, 5]}], r"unit\[1\].vehicles: there is no such vehicle; got 5; "),
        ([FRONT, {"vehicles": [0, 3, 4]}], r"unit\[1\].vehicles: there is no such vehicle; got 0"),
        ([FRONT, {"axles": ["C1-V3-B1-A3"]}], r"wsp.unit\[1\].axles: axle 'C1-V3-B1-A3' unknown"),
        ([FRONT, {"controller": "none"}], r"wsp.unit\[1\]: serves no axle; try: vehicles = \[1\]"),
        ([{**FRONT, "controller": "adaptiv"}, REAR], r"wsp.unit\[0\].controller: .* did you mean"),
    ],
)  # fmt: skip
def test_units_that_cannot_be(units, message):
    with pytest.raises(RailgripError, match=message):
        scenario(*units)


def test_one_controller_or_units():
    with pytest.raises(RailgripError, match=r"wsp.controller: stands beside \[\[wsp.unit\]\]"):
        scenario(FRONT, REAR, controller="none")
    with pytest.raises(RailgripError, match=r"wsp.parameters: stands beside"):
        scenario(FRONT, REAR, parameters={"slip_upper": 0.2})


def test_a_parameter_that_a_unit_does_not_have():
    wrong = {**REAR, "parameters": {"slip_uper": 0.2}}
    with pytest.raises(RailgripError, match=r"wsp.unit\[1\].parameters.slip_uper: .* did you mean"):
        protection(scenario(FRONT, wrong))


def test_a_controller_for_all_takes_the_place_of_units_and_the_other_way_round():
    mixed = scenario(FRONT, REAR)
    assert str(mixed.wsp) == "adaptive on V1, V2; conventional on V3, V4"
    for name in ("conventional", "adaptive"):
        alone = mixed.with_({"wsp.controller": name})
        assert str(alone.wsp) == name
        assert not isinstance(protection(alone), Mixture)
        assert str(alone.with_({"wsp.unit": [FRONT, REAR]}).wsp) == str(mixed.wsp)


def test_units_survive_the_way_through_a_file():
    mixed = scenario(FRONT, {**REAR, "parameters": {"slip_upper": "20 %"}})
    again = Scenario.model_validate_json(mixed.model_dump_json(by_alias=True))
    assert again.wsp == mixed.wsp
    assert again.wsp.unit[1].parameters == {"slip_upper": 0.2}


def test_single_axles():
    own = [f"C1-V4-B2-A{i}" for i in (1, 2)]
    mixed = scenario(FRONT, {"vehicles": [3], "axles": ["C1-V4-B1-A1", "C1-V4-B1-A2"]},
                     {"controller": "none", "axles": own})  # fmt: skip
    assert mixed.wsp.unit[2].places(mixed.train) == (14, 15)
    assert mixed.wsp.unit[1].places(mixed.train) == (8, 9, 10, 11, 12, 13)


def test_a_unit_of_a_python_file_beside_its_scenario(tmp_path):
    source = (
        "import numpy as np\nfrom railgrip.control.contract import Command\n"
        "class Idle:\n    period = 0.01\n"
        "    def reset(self, setup):\n        return setup.n_axles\n"
        "    def step(self, state, measured, dt):\n"
        "        n = state\n"
        "        return Command(np.zeros(n), np.ones(n), np.zeros(n), 0.0)\n"
    )
    (tmp_path / "idle.py").write_text(source, encoding="utf-8")
    (tmp_path / "mixed.toml").write_text(
        'extends = "leaves_160"\nrun.speed = "20 km/h"\n'
        '[[wsp.unit]]\ncontroller = "idle.py"\nvehicles = [1]\n'
        "[[wsp.unit]]\nvehicles = [2, 3, 4]\n",
        encoding="utf-8",
    )
    prepared = prepare(rg.load(str(tmp_path / "mixed.toml")))
    assert prepared.is_plain
    assert [len(unit.axles) for unit in prepared.controller.units] == [4, 12]


class Clock:
    def __init__(self, period):
        self.period = period


def test_periods_that_do_not_go_into_each_other():
    whole = mixture([Clock(0.02), Clock(0.01), Clock(0.03)], [(0,), (1,), (2,)])
    assert [unit.every for unit in whole.units] == [2, 1, 3]
    with pytest.raises(RailgripError, match=r"wsp.unit\[1\].controller: its period is no multiple"):
        mixture([Clock(0.02), Clock(0.03)], [(0,), (1,)])
