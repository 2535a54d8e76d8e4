"""The safety case: distributions, formula, plant, factors, and what a bad file is told."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import stats

from railgrip.campaign.rare.estimate import rare_quantiles
from railgrip.campaign.safety import marginals
from railgrip.campaign.safety.case import SafetyCase, find_case, read_safety_case
from railgrip.campaign.safety.draws import trains
from railgrip.campaign.safety.factors import dry_factor, safety_factors
from railgrip.campaign.safety.formula import Formula
from railgrip.campaign.safety.page import page
from railgrip.campaign.safety.plant import Plant
from railgrip.campaign.safety.safe_braking import as_table, safe_deceleration, safe_distance
from railgrip.campaign.safety.train_layout import layout_of
from railgrip.core.errors import RailgripError
from railgrip.train.en14531 import mean_resistance, stopping_distance

SHIPPED = find_case("emu_en14531")


@pytest.fixture(scope="module")
def case() -> SafetyCase:
    return read_safety_case(SHIPPED)


@pytest.mark.parametrize(
    ("kind", "numbers", "exact"),
    [
        ("normal", {"mean": 2.0, "deviation": 0.5}, stats.norm(2.0, 0.5)),
        ("normal", {"mean": 0.0, "deviation": 1.0, "low": -1.0, "high": 2.0},
         stats.truncnorm(-1.0, 2.0)),
        ("lognormal", {"mean": 2.0, "deviation": 0.4},
         stats.lognorm(np.sqrt(np.log(1.04)), scale=2.0 / np.sqrt(1.04))),
        ("uniform", {"low": -1.0, "high": 3.0}, stats.uniform(-1.0, 4.0)),
        ("triangular", {"low": 0.0, "mode": 1.0, "high": 4.0}, stats.triang(0.25, 0.0, 4.0)),
    ],
)  # fmt: skip
def test_distributions_are_those_of_scipy(kind: str, numbers: dict[str, float], exact: Any) -> None:
    u = np.linspace(-5.5, 5.5, 45)
    assert marginals.value(kind, numbers, u) == pytest.approx(
        exact.ppf(stats.norm.cdf(u)), rel=1e-7
    )


def test_nominal_train_is_that_of_the_standard_example(case: SafetyCase) -> None:
    """EN 14531-1, simplified example: 497.8 m and 1.682 s from 100 km/h."""
    distance, response = Formula(case, layout_of(case), 100 / 3.6).nominal()
    assert distance == pytest.approx(497.8, abs=0.05)
    assert response == pytest.approx(1.682, abs=5e-4)


def test_many_trains_are_stopped_like_one(case: SafetyCase) -> None:
    """The vectorised formula against `railgrip.train.en14531`, one train with a failed brake."""
    layout = layout_of(case)
    normals = np.zeros((1, layout.n_variables))
    failed = np.zeros((1, 8), dtype=bool)
    failed[0, 0] = True
    found = Formula(case, layout, 100 / 3.6).distance(trains(layout, normals, failed))[0][0]
    resistance = mean_resistance(100 / 3.6, constant=3000.0, linear=110.0, quadratic=7.0)
    stop = stopping_distance(
        100 / 3.6, [16073.5] * 3 + [9104.2] * 4, [2.1] * 3 + [1.3] * 4, dynamic_mass=126.8e3,
        external_force=resistance,
    )  # fmt: skip
    assert found == pytest.approx(stop.distance, rel=1e-5)


def test_formula_and_plant_brake_alike(case: SafetyCase) -> None:
    """Run by run, scattered and with failed brakes: 0.3 % of the deceleration distance."""
    layout = layout_of(case)
    normals = np.random.default_rng(1).standard_normal((48, layout.n_variables))
    failed = np.zeros((48, 8), dtype=bool)
    failed[::3, 0] = failed[::4, 5] = True
    quotients = []
    for stop in (Formula(case, layout, 100 / 3.6), Plant(case, layout, 100 / 3.6)):
        distance, response = stop.nominal()
        braking = distance - stop.speed * response
        quotients.append(dry_factor(stop, layout, braking, response)(normals, failed))
    assert quotients[0] == pytest.approx(quotients[1], rel=3e-3)


def test_factors_fall_with_the_level_and_make_the_nominal_stop(case: SafetyCase) -> None:
    found = safety_factors(case.model_copy(update={"wet": None, "runs": 2000}))
    for step in found.steps:
        values = [one.value for one in step.dry.quantile]
        assert values == sorted(values, reverse=True)
        assert values[0] == pytest.approx(1.0, abs=0.01)
    first, second, third = found.steps
    braking = sum(
        (b**2 - a**2) / (2 * step.emergency_deceleration)
        for a, b, step in zip((0, first.speed, second.speed), case.speed_steps, found.steps,
                              strict=True)
    )  # fmt: skip
    assert third.speed * third.build_up_time + braking == pytest.approx(third.distance, rel=1e-9)
    assert all(a > b for a, b in zip(safe_distance(found, 9), safe_distance(found, 1), strict=True))
    assert safe_deceleration(found, 9)[0] == pytest.approx(
        first.dry.quantile[9].value * first.emergency_deceleration
    )
    assert len(as_table(found)) == 30
    text = page(found)
    assert "not an approval" in text
    assert "published practice" in text
    assert not re.search(r"(src|href)=\"(?!data:)", text)
    assert "<script" not in text


WRONG = {
    'distribution = "normal"\nmean = "0 bar"': (
        'distribution = "nromal"\nmean = "0 bar"', "did you mean 'normal'?"),
    'deviation = "0.05 bar"': ('deviation = "-0.05 bar"', "deviation: must be above 0"),
    'mean = "0 bar"': ('mean = "0 furlong"', "has a unit that is not known"),
    'deviation = 0.025': ('deviation = "0.025 s"', "variables[2].deviation"),
    '"100 km/h", "140 km/h"': ('"40 km/h", "140 km/h"', "must be above 0 and rise"),
    'latent = 1e-3': ('latent = 1.5', "failures[0].latent"),
    'on_demand = 1e-4': ('on_demand = -0.1', "failures[0].on_demand"),
    'train = "emu_en14531"': ('train = "emu_en14351"', "did you mean 'emu_en14531'?"),
    'quantity = "mass"': ('quantity = "mas"', "did you mean 'mass'?"),
    'low = 0.3': ('low = 9', "cuts off nearly everything"),
    'runs = 20000': ('runs = 3', "runs"),
    'source = "published practice: N(1, 0.025) for each unit"': ('', "source: is missing"),
    '[wet]': ('colour = "red"\n[wet]', "colour"),
}  # fmt: skip


@pytest.mark.parametrize("right", WRONG)
def test_a_bad_file_is_told_what_is_wrong(right: str, tmp_path: Path) -> None:
    wrong, sentence = WRONG[right]
    text = SHIPPED.read_text(encoding="utf-8")
    assert right in text
    file = tmp_path / "case.toml"
    file.write_text(text.replace(right, wrong, 1), encoding="utf-8")
    with pytest.raises(RailgripError) as error:
        read_safety_case(file)
    assert sentence in str(error.value)


def test_the_formula_refuses_motors() -> None:
    text = SHIPPED.read_text(encoding="utf-8").replace('"emu_en14531"', '"emu_four_car"')
    import tomllib

    case = SafetyCase.model_validate(tomllib.loads(text))
    with pytest.raises(RailgripError, match="friction brakes only"):
        Formula(case, layout_of(case), 30.0)


CONTROLLED = find_case("emu_brake_control")


@pytest.fixture(scope="module")
def controlled() -> SafetyCase:
    return read_safety_case(CONTROLLED).model_copy(update={"speed_steps": (80 / 3.6,)})


def factors_of(case: SafetyCase, normals: Any, failed: Any) -> np.ndarray:
    layout = layout_of(case)
    stop = Plant(case, layout, case.speed_steps[0], threads=2)
    distance, response = stop.nominal()
    model = dry_factor(stop, layout, distance - stop.speed * response, response)
    found: np.ndarray = model(normals, failed[:, : len(layout.fails)])
    return found


def test_brake_control_narrows_the_scatter_until_it_fails(controlled: SafetyCase) -> None:
    """On the same trains it scatters a third; where it fails, the train brakes as without it."""
    layout = layout_of(controlled)
    normals = np.random.default_rng(5).standard_normal((64, layout.n_variables))
    failed = np.zeros((64, len(layout.fails)), dtype=bool)
    kept = factors_of(controlled, normals, failed)
    bare = factors_of(controlled.without_control(), normals, failed)
    assert np.std(kept) < 0.34 * np.std(bare)
    failed[:, layout.control] = True
    lost = factors_of(controlled, normals, failed)
    # the factors refer to two nominal stops, whose build-up times differ by 10 ms
    assert lost / bare == pytest.approx(np.full(64, lost[0] / bare[0]), rel=2e-4)


def test_states_of_a_failed_control_are_sought_apart(controlled: SafetyCase) -> None:
    states, control = layout_of(controlled).states, layout_of(controlled).control
    lost = states.failed[:, control]
    assert not set(states.n_failed[lost]) & set(states.n_failed[~lost])
    assert states.weight[lost].sum() == pytest.approx(1 - (1 - 1e-4) * (1 - 1e-5), rel=1e-9)


@pytest.mark.parametrize(
    ("right", "wrong", "sentence"),
    [
        ('method = "plant"', 'method = "formula"', "brake_control: is unknown to the formula"),
        ('method = "plant"', 'method = "formula"', "variables[4].quantity: is unknown"),
        ('mean = "120 degC"', 'mean = "120 bar"', "variables[4].mean"),
        ('means = "value"', 'means = "factor"', "must be 'value' for disc_temperature"),
        ("pressure_reserve = 1.3", "pressure_reserve = 0.3", "brake_control.pressure_reserve"),
    ],
)
def test_a_case_that_only_the_plant_knows(
    right: str, wrong: str, sentence: str, tmp_path: Path
) -> None:
    text = CONTROLLED.read_text(encoding="utf-8")
    assert right in text
    file = tmp_path / "case.toml"
    file.write_text(text.replace(right, wrong, 1), encoding="utf-8")
    with pytest.raises(RailgripError) as error:
        read_safety_case(file)
    assert sentence in str(error.value)


def test_a_control_that_is_not_there_cannot_fail(tmp_path: Path) -> None:
    text = SHIPPED.read_text(encoding="utf-8").replace(
        'per = "axle"\nlatent', 'per = "control"\nlatent'
    )
    file = tmp_path / "case.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(RailgripError, match="fails a brake control that is not there"):
        read_safety_case(file)


TIED = """
[[variables]]
quantity = "rigging_efficiency"
per = "train"
distribution = "lognormal"
mean = 1
deviation = 0.05
source = "test"

[[variables]]
quantity = "pad_friction"
per = "train"
distribution = "lognormal"
mean = 1
deviation = 0.08
source = "test"

[[correlation]]
variables = ["rigging_efficiency", "pad_friction"]
matrix = [[1, 0.7], [0.7, 1]]
"""


def tied(tmp_path: Path, text: str = TIED) -> SafetyCase:
    head = 'train = "emu_en14531"\nspeed_steps = ["100 km/h"]\n'
    file = tmp_path / "case.toml"
    file.write_text(head + text, encoding="utf-8")
    return read_safety_case(file)


def test_correlated_factors_make_the_product_of_two_lognormals(tmp_path: Path) -> None:
    """Its logarithm is normal with s₁² + s₂² + 2 ρ s₁ s₂, out to a thousand-millionth."""
    layout = layout_of(tied(tmp_path))
    found = rare_quantiles(
        lambda normals, failed: (
            (made := trains(layout, normals, failed)).efficiency[:, 0] * made.friction[:, 0]
        ),
        layout.n_variables,
        layout.states,
        owner=layout.owner,
        runs=5000,
    )
    a, b = np.log1p(0.05**2), np.log1p(0.08**2)
    spread = np.sqrt(a + b + 2 * 0.7 * np.sqrt(a * b))
    for level, p in ((1, 1e-1), (5, 1e-5), (9, 1e-9)):
        exact = np.exp(spread * stats.norm.ppf(p) - 0.5 * (a + b))
        assert found.quantile[level].low_all <= exact <= found.quantile[level].high_all
        assert found.quantile[level].value == pytest.approx(exact, rel=2e-3)


def test_correlation_leaves_each_distribution_as_it_is(tmp_path: Path) -> None:
    text = TIED.replace('per = "train"', 'per = "axle"') + (
        '[[failures]]\nper = "axle"\nlatent = 1e-3\nsource = "test"\n'
    )
    layout = layout_of(tied(tmp_path, text))
    assert set(layout.owner) == set(range(8))
    normals = np.random.default_rng(5).standard_normal((20_000, layout.n_variables))
    made = trains(layout, normals, np.zeros((len(normals), 8), dtype=bool))
    for axle in (0, 7):
        a, b = np.log(made.efficiency[:, axle]), np.log(made.friction[:, axle])
        assert np.corrcoef(a, b)[0, 1] == pytest.approx(0.7, abs=0.02)
        assert made.friction[:, axle].std() == pytest.approx(0.08, rel=0.03)
    others = np.corrcoef(made.efficiency[:, 0], made.friction[:, 1])[0, 1]
    assert abs(others) < 0.03


def test_a_measured_sample_gives_its_own_quantiles(tmp_path: Path) -> None:
    """Hazen's rule, as numpy has it; nothing beyond the least and the greatest."""
    sample = [0.91, 1.08, 0.99, 1.02, 0.97, 1.0]
    (tmp_path / "pads.csv").write_text(
        "pad,factor\n" + "".join(f"{i},{x}\n" for i, x in enumerate(sample)), encoding="utf-8"
    )
    text = """
[[variables]]
quantity = "pad_friction"
distribution = "empirical"
file = "pads.csv"
column = "factor"
source = "test"

[[variables]]
quantity = "cylinder_pressure"
means = "difference"
distribution = "empirical"
values = ["-0.1 bar", "0.2 bar"]
source = "test"
"""
    case = tied(tmp_path, text)
    layout = layout_of(case)
    u = np.linspace(-7.0, 7.0, 31)
    made = trains(layout, np.repeat(u[:, None], 16, axis=1), np.zeros((31, 0), dtype=bool))
    exact = np.quantile(sample, stats.norm.cdf(u), method="hazen")
    assert made.friction[:, 3] == pytest.approx(exact, rel=1e-12)
    pressure = layout.brakes.pressure[3]
    assert made.pressure[0, 3] == pytest.approx(pressure - 1e4)
    assert made.pressure[-1, 3] == pytest.approx(pressure + 2e4)


WRONG_TIES = {
    "[[1, 0.7], [0.7, 1]]": ("[[1, 1.7], [1.7, 1]]", "is not positive definite"),
    "0.7], [0.7": ("0.7], [0.6", "must be symmetric"),
    '["rigging_efficiency", "pad_friction"]': (
        '["rigging_efficiency", "pad_frictoin"]', "did you mean 'pad_friction'?"),
    '"pad_friction"\nper = "train"': ('"pad_friction"\nper = "axle"', "the same 'per'"),
    'distribution = "lognormal"\nmean = 1\ndeviation = 0.08': (
        'distribution = "empirical"\nvalues = [1.0]', "at least two different values"),
    "deviation = 0.08": ("deviation = 0.08\nvalues = [1, 2]", "values: does not belong"),
    'distribution = "lognormal"\nmean = 1\ndeviation = 0.05': (
        'distribution = "empirical"\nfile = "no.csv"', "no.csv"),
}  # fmt: skip


@pytest.mark.parametrize("right", WRONG_TIES)
def test_what_cannot_go_together_is_refused(right: str, tmp_path: Path) -> None:
    wrong, sentence = WRONG_TIES[right]
    assert right in TIED
    with pytest.raises(RailgripError) as error:
        tied(tmp_path, TIED.replace(right, wrong, 1))
    assert sentence in str(error.value)
