"""Every shipped rail condition, pad, disc, line and scenario is accepted and means what it says."""

import pytest
from pydantic import TypeAdapter

from railgrip import data
from railgrip.core.registry import resolve
from railgrip.scenario import library
from railgrip.scenario.brakes import Disc
from railgrip.scenario.friction import Pad
from railgrip.scenario.line import Line
from railgrip.scenario.rail import RailCondition
from railgrip.scenario.scenario import Scenario


def condition(name):
    return RailCondition.model_validate(library.fetch("rail_condition", name))


def pad(name):
    return TypeAdapter(Pad).validate_python(library.fetch("pad", name))


def scenario(name):
    return Scenario.model_validate(library.fetch("scenario", name))


@pytest.mark.parametrize("name", data.names("rail_conditions"))
def test_sliding_never_makes_a_rail_worse(name):
    rail = condition(name)
    assert rail.contaminated.static_friction <= rail.clean.static_friction
    if rail.clean != rail.contaminated and name != "leaves":
        assert rail.cleaning > 0


def test_conditions_are_ordered_as_on_a_real_line():
    order = ["very_low", "leaves", "low", "ice", "oil", "wet", "dry"]
    levels = [condition(name).contaminated.static_friction for name in order]
    assert levels == sorted(levels)
    assert len(set(levels)) == len(levels)


def test_detergent_recovers_and_leaves_do_not():
    assert condition("water_detergent").cleaning == pytest.approx(1.9e-4)
    assert condition("water_detergent").clean.static_friction == 0.28
    assert condition("leaves").cleaning == 0.0


@pytest.mark.parametrize("name", data.names("discs"))
def test_discs(name):
    disc = Disc.model_validate(library.fetch("disc", name))
    assert disc.ring_mass + disc.hub_mass > 100


@pytest.mark.parametrize("name", data.names("pads"))
def test_pads(name):
    assert pad(name).title


def test_karwatzki_blocks_by_hand():
    # One block at 14 kN and 100 km/h, from the two formulas as they are printed.
    def friction(block, force, speed):
        return (
            block.base
            * (force + block.force_high) / (force + block.force_low)
            * (speed + block.speed_high) / (speed + block.speed_low)
        )  # fmt: skip

    tonnes = 14 / 9.81
    cast_iron = 0.6 * (16 * tonnes + 100) / (80 * tonnes + 100) * (100 + 100) / (5 * 100 + 100)
    composite = 0.055 * (14 + 200) / (14 + 50) * (100 + 150) / (100 + 75)
    assert friction(pad("cast_iron"), 14e3, 100 / 3.6) == pytest.approx(cast_iron, rel=1e-3)
    assert friction(pad("k_block"), 14e3, 100 / 3.6) == pytest.approx(composite, rel=1e-9)


def test_organic_pad_is_one_at_its_reference_point():
    organic = pad("organic")
    assert (15.0, 1.0) in organic.speed
    assert (25e3, 1.0) in organic.clamp_force
    assert organic.temperature[0] == (150.0, 1.0)


@pytest.mark.parametrize("name", data.names("lines"))
def test_lines_load_by_name_or_through_their_reader(name):
    path = data.path("lines", name)
    if path.suffix == ".json":
        line = resolve("railgrip.readers", "ttobench")(path)
    else:
        line = Line.model_validate(library.fetch("line", name))
    assert line.length >= 5e3


@pytest.mark.parametrize(("name", "value"), [("uphill_10", 0.01), ("downhill_20", -0.02)])
def test_gradients_have_the_sign_of_their_name(name, value):
    line = Line.model_validate(library.fetch("line", name))
    assert [point.value for point in line.gradient] == [pytest.approx(value)]


@pytest.mark.parametrize("name", data.names("scenarios"))
def test_scenarios_are_complete(name):
    found = scenario(name)
    assert found.title
    assert found.mass > 40e3
    assert found.train.max_speed is None or found.run.speed <= found.train.max_speed + 1e-9


def test_demo_runs_on_a_real_line_within_its_speed_limit():
    demo = scenario("demo")
    limits = [limit for limit in demo.line.use.speed_limit if limit.at <= demo.line.start]
    assert limits[-1].value == pytest.approx(demo.run.speed)
    patches = demo.rail.patch
    assert [patch.condition.cleaning > 0 for patch in patches] == [True, False]
    assert all(demo.line.start < patch.begin for patch in patches)
    assert demo.wsp.controller == "conventional"
    assert demo.train.dump_valve is not None


@pytest.mark.parametrize("name", data.names("scenarios"))
def test_who_has_a_protection_has_the_valves_for_it(name):
    found = scenario(name)
    if found.wsp.controller == "conventional":
        assert found.train.dump_valve is not None
