"""Properties of the friction estimate: bounds, weights, forms, rules."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.brake.piecewise_friction import PiecewiseFriction, piecewise_friction
from railgrip.control.friction_estimate import (
    ON_DEVIATION,
    ON_FUNCTIONS,
    ON_RESULT,
    FrictionModel,
    Influence,
    LimitSet,
    estimate_friction,
)
from railgrip.control.limit_rules import (
    EMERGENCY_BRAKE,
    N_CONDITIONS,
    N_SET,
    SERVICE,
    WORN,
    Conditions,
    LimitRule,
    limit_set,
    rule_in_force,
    rule_numbers,
)
from railgrip.control.quadratic_friction import (
    LastInputs,
    QuadraticFriction,
    lagged_quadratic_friction,
    quadratic_friction,
)
from railgrip.core.formulas.piecewise_linear import Hinges, hinges_from_points

PAD = FrictionModel(
    0.37,
    hinges_from_points([(150.0, 1.0), (350.0, 0.8)]),
    hinges_from_points([(0.0, 1.08), (10.0, 1.0), (15.0, 1.0), (55.0, 0.88)]),
    hinges_from_points([(10e3, 1.04), (25e3, 1.0), (40e3, 0.96)]),
)
OPEN = LimitSet()
PLACES = {
    "temperature": st.floats(-40, 600),
    "speed": st.floats(0, 80),
    "force": st.floats(0, 60e3),
}


@given(**PLACES)
def test_unbounded_and_fully_weighted_it_is_the_pad(
    temperature: float, speed: float, force: float
) -> None:
    pad = PiecewiseFriction(*PAD)
    expected = piecewise_friction(pad, force, speed, temperature)
    for form in (ON_FUNCTIONS, ON_RESULT, ON_DEVIATION):
        found = estimate_friction(PAD, OPEN, LimitSet(form=form), temperature, speed, force)
        assert found == pytest.approx(expected, rel=1e-12)


@given(**PLACES)
@pytest.mark.parametrize("form", [ON_FUNCTIONS, ON_DEVIATION])
def test_weight_nothing_is_exactly_not_compensated(
    form: float, temperature: float, speed: float, force: float
) -> None:
    control = LimitSet(form=form, weight=0.0)
    assert estimate_friction(PAD, OPEN, control, temperature, speed, force) == 0.37
    model = LimitSet(weight=0.0)
    assert estimate_friction(PAD, model, OPEN, temperature, speed, force) == 0.37


@given(**PLACES)
def test_weight_nothing_on_one_function_is_that_function_left_out(
    temperature: float, speed: float, force: float
) -> None:
    without = Influence(weight=Hinges(0.0))
    found = estimate_friction(PAD, OPEN, LimitSet(speed=without), temperature, speed, force)
    left_out = PAD._replace(speed=Hinges(1.0))
    assert found == estimate_friction(left_out, OPEN, OPEN, temperature, speed, force)


@given(**PLACES, g=st.floats(0, 1))
def test_weights_on_result_and_on_deviation_are_one_law(
    temperature: float, speed: float, force: float, g: float
) -> None:
    """The source's identity: g_SM = μ_ref/μ_M + g_ref (1 − μ_ref/μ_M)."""
    model = estimate_friction(PAD, OPEN, OPEN, temperature, speed, force)
    on_result = 0.37 / model + g * (1.0 - 0.37 / model)
    by_deviation = LimitSet(form=ON_DEVIATION, weight=g)
    by_result = LimitSet(form=ON_RESULT, weight=on_result)
    found = estimate_friction(PAD, OPEN, by_deviation, temperature, speed, force)
    assert found == pytest.approx(
        estimate_friction(PAD, OPEN, by_result, temperature, speed, force), rel=1e-12
    )


@given(**PLACES, least=st.floats(0.5, 1.0), greatest=st.floats(1.0, 1.5))
def test_bounds_hold_whatever_the_pad_does(
    temperature: float, speed: float, force: float, least: float, greatest: float
) -> None:
    influence = Influence(least, greatest)
    bounded = LimitSet(influence, influence, influence)
    found = estimate_friction(PAD, OPEN, bounded, temperature, speed, force) / 0.37
    assert least**3 - 1e-12 <= found <= greatest**3 + 1e-12


def test_model_bounds_come_before_control_bounds() -> None:
    """A model bound to 0.9 and weighted by half says 0.95; the control then bounds that."""
    half = LimitSet(temperature=Influence(least=0.9, weight=Hinges(0.5)))
    control = LimitSet(temperature=Influence(least=0.97))
    assert estimate_friction(PAD, half, OPEN, 350.0, 12.0, 25e3) == pytest.approx(0.37 * 0.95)
    assert estimate_friction(PAD, half, control, 350.0, 12.0, 25e3) == pytest.approx(0.37 * 0.97)


def test_a_weight_may_differ_over_the_range_of_its_argument() -> None:
    only_hot = Influence(weight=hinges_from_points([(250.0, 0.0), (300.0, 1.0)]))
    control = LimitSet(temperature=only_hot)
    assert estimate_friction(PAD, OPEN, control, 240.0, 12.0, 25e3) == 0.37
    found = estimate_friction(PAD, OPEN, control, 350.0, 12.0, 25e3)
    assert found == pytest.approx(0.8 * 0.37)


def test_the_last_rule_that_holds_decides() -> None:
    rules = np.array(
        [
            rule_numbers(LimitRule()),
            rule_numbers(LimitRule(Conditions(brake=EMERGENCY_BRAKE))),
            rule_numbers(LimitRule(Conditions(pads=WORN, least_speed=20.0))),
            rule_numbers(LimitRule(Conditions(least_temperature=300.0, least_time=5.0))),
        ]
    )

    def row(brake: float, pads: float, speed: float, time: float, hot: float) -> int:
        return rule_in_force(rules, brake, pads, speed, time, hot, 15.0, 25e3)

    assert row(SERVICE, 1.0, 30.0, 1.0, 100.0) == 0
    assert row(EMERGENCY_BRAKE, 1.0, 30.0, 1.0, 100.0) == 1
    assert row(EMERGENCY_BRAKE, WORN, 30.0, 1.0, 100.0) == 2
    assert row(SERVICE, WORN, 10.0, 1.0, 100.0) == 0
    assert row(EMERGENCY_BRAKE, WORN, 30.0, 6.0, 320.0) == 3


def test_a_rule_survives_its_way_through_numbers() -> None:
    bend = hinges_from_points([(0.0, 0.2), (10.0, 0.4), (20.0, 0.6), (30.0, 1.0)])
    model = LimitSet(speed=Influence(0.9, 1.1, bend), weight=0.7)
    control = LimitSet(clamp_force=Influence(0.8, 1.2), form=ON_DEVIATION, weight=0.3)
    rules = np.array([rule_numbers(LimitRule(model=model, control=control))])
    assert limit_set(rules, 0, N_CONDITIONS) == model
    assert limit_set(rules, 0, N_CONDITIONS + N_SET) == control


def test_quadratic_laws_are_the_polynomial_and_its_delay() -> None:
    """Against numpy's polynomials, coefficient by coefficient."""
    params = QuadraticFriction(0.4, -1e-3, 2e-6, -1e-4, 3e-8, -1e-6, 1e-12)
    temperature, speed, force = 180.0, 25.0, 30e3
    expected = (
        np.polynomial.Polynomial([0.4, -1e-3, 2e-6])(speed)
        + np.polynomial.Polynomial([0.0, -1e-4, 3e-8])(temperature)
        + np.polynomial.Polynomial([0.0, -1e-6, 1e-12])(force)
    )
    assert quadratic_friction(params, temperature, speed, force) == pytest.approx(expected)
    before = LastInputs(temperature, speed, force)
    assert lagged_quadratic_friction(params, before) == pytest.approx(expected)
