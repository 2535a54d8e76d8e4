"""What every friction law must obey, and where two of them are one."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.compiler import inlined
from railgrip.contact.constant_friction import ConstantFriction, constant_friction
from railgrip.contact.exponential_friction import exponential_friction
from railgrip.contact.half_value_friction import (
    HalfValueFriction,
    half_value_friction,
    half_value_from_polach,
    polach_from_half_value,
)
from railgrip.contact.linear_friction import LinearFriction, linear_friction
from railgrip.contact.rail_friction import DRY_POLACH_2005, RailFriction
from railgrip.contact.thermal_friction import (
    CONTACT_EXAMPLE_LOWER,
    CONTACT_EXAMPLE_OVER_400,
    CONTACT_EXAMPLE_OVER_1200,
    ThermalFriction,
    thermal_friction,
)
from railgrip.contact.three_regime_friction import (
    ILLUSTRATIVE_THREE_REGIMES,
    ThreeRegimeFriction,
    three_regime_friction,
)

Law = Callable[[Any, float, float], float]
EXACT = 1e-12

FRICTION = st.floats(0.0, 1.0)
SPEEDS = st.just(0.0) | st.floats(1e-9, 200.0)
WARMTH = st.floats(-50.0, 2000.0)
CHARACTERISTIC = st.floats(0.05, 50.0)


@st.composite
def rails(draw: st.DrawFn) -> RailFriction:
    return RailFriction(draw(FRICTION), draw(FRICTION), draw(st.floats(0.0, 5.0)), 1.0, 0.4)


@st.composite
def cases(draw: st.DrawFn) -> tuple[Law, Any, float, float, float]:
    """A law, its parameters, the bounds that it states, and how steep it may be over slip speed."""
    low, high = sorted((draw(FRICTION), draw(FRICTION)))
    speed, other, rise = draw(CHARACTERISTIC), draw(CHARACTERISTIC), draw(st.floats(0.0, 0.3))
    fall = high - low
    return draw(
        st.sampled_from(
            [
                (constant_friction, ConstantFriction(low), low, low, 0.0),
                (
                    exponential_friction,
                    RailFriction(high, low / high if high else 1.0, 1.0 / speed, 1.0, 0.4),
                    low,
                    high,
                    fall / speed,
                ),
                (
                    half_value_friction,
                    HalfValueFriction(low, fall, speed),
                    low,
                    high,
                    fall * math.log(2.0) / speed,
                ),
                (linear_friction, LinearFriction(high, low, speed), low, high, fall / speed),
                (thermal_friction, ThermalFriction(high, -fall, 20.0, 400.0), low, high, 0.0),
                (
                    three_regime_friction,
                    ThreeRegimeFriction(high, low, speed, rise, other),
                    low,
                    high + rise,
                    fall / speed + 1.1 * rise / other,
                ),
            ]
        )
    )


@given(case=cases(), w=SPEEDS, warmth=WARMTH)
def test_the_friction_stays_in_its_bounds(
    case: tuple[Law, Any, float, float, float], w: float, warmth: float
) -> None:
    law, parameters, low, high, _ = case
    assert low - EXACT <= law(parameters, w, warmth) <= high + EXACT


@given(case=cases(), w=SPEEDS, step=st.floats(1e-9, 1e-2), warmth=WARMTH)
def test_no_law_jumps(
    case: tuple[Law, Any, float, float, float], w: float, step: float, warmth: float
) -> None:
    law, parameters, _, _, steepest = case
    change = law(parameters, w + step, warmth) - law(parameters, w, warmth)
    assert abs(change) <= steepest * step * (1.0 + 1e-6) + EXACT


@given(case=cases(), w=SPEEDS, more=st.floats(0.0, 50.0), warmth=WARMTH)
def test_only_vibration_makes_friction_rise(
    case: tuple[Law, Any, float, float, float], w: float, more: float, warmth: float
) -> None:
    law, parameters, *_ = case
    if law is three_regime_friction:
        parameters = parameters._replace(vibration_rise=0.0)
    assert law(parameters, w + more, warmth) <= law(parameters, w, warmth) + EXACT


@given(rail=rails(), w=SPEEDS)
def test_polach_and_contact_write_one_curve(rail: RailFriction, w: float) -> None:
    half_value = half_value_from_polach(rail)
    here = exponential_friction(rail, w, 20.0)
    assert half_value_friction(half_value, w, 20.0) == pytest.approx(here, rel=1e-12, abs=1e-15)
    back = polach_from_half_value(half_value, rail.adhesion_reduction, rail.slip_reduction)
    assert exponential_friction(back, w, 20.0) == pytest.approx(here, rel=1e-12, abs=1e-15)


def test_half_of_the_excess_is_gone_at_the_half_value_speed() -> None:
    parameters = half_value_from_polach(DRY_POLACH_2005)
    middle = exponential_friction(DRY_POLACH_2005, parameters.half_speed, 20.0)
    assert middle == pytest.approx(0.55 * (0.4 + 0.5 * 0.6), rel=1e-13)


@given(rail=rails().filter(lambda rail: rail.friction_decay > 0.01), w=SPEEDS)
def test_three_regimes_without_the_third_are_the_exponential_fall(
    rail: RailFriction, w: float
) -> None:
    kinetic = rail.friction_ratio * rail.static_friction
    parameters = ThreeRegimeFriction(
        rail.static_friction, kinetic, 1.0 / rail.friction_decay, 0.0, math.inf
    )
    assert three_regime_friction(parameters, w, 20.0) == pytest.approx(
        exponential_friction(rail, w, 20.0), rel=1e-12, abs=1e-14
    )


@given(static=FRICTION, ratio=FRICTION, decay=st.floats(0.02, 5.0), w=SPEEDS)
def test_the_line_is_the_tangent_of_the_exponential_and_lies_below_it(
    static: float, ratio: float, decay: float, w: float
) -> None:
    rail = RailFriction(static, ratio, decay, 1.0, 0.4)
    line = LinearFriction(static, ratio * static, 1.0 / decay)
    above = exponential_friction(rail, w, 20.0) - linear_friction(line, w, 20.0)
    fall = (1.0 - ratio) * static
    assert -EXACT <= above <= 0.5 * fall * (decay * w) ** 2 + EXACT


@given(friction=FRICTION, w=SPEEDS, warmth=WARMTH)
def test_without_a_fall_all_laws_are_the_constant(friction: float, w: float, warmth: float) -> None:
    expected = constant_friction(ConstantFriction(friction), w, warmth)
    for law, parameters in (
        (exponential_friction, RailFriction(friction, 1.0, 0.7, 1.0, 0.4)),
        (half_value_friction, HalfValueFriction(friction, 0.0, 0.7)),
        (linear_friction, LinearFriction(friction, friction, 0.7)),
        (thermal_friction, ThermalFriction(friction, 0.0, 0.0, 400.0)),
        (three_regime_friction, ThreeRegimeFriction(friction, friction, 0.7, 0.0, 20.0)),
    ):
        assert law(parameters, w, warmth) == pytest.approx(expected, rel=1e-13)


def test_three_regimes_fall_and_rise_again() -> None:
    speeds = np.linspace(0.0, 60.0, 601)
    friction = [three_regime_friction(ILLUSTRATIVE_THREE_REGIMES, w, 20.0) for w in speeds.tolist()]
    lowest = int(np.argmin(friction))
    assert friction[0] == ILLUSTRATIVE_THREE_REGIMES.static_friction
    assert 0 < lowest < 600
    assert (np.diff(friction[: lowest + 1]) < 0.0).all()
    assert (np.diff(friction[lowest:]) > 0.0).all()
    assert friction[lowest] < friction[-1] < friction[0]


def test_the_idealised_step_is_static_at_rest_and_kinetic_beyond() -> None:
    step = ThreeRegimeFriction(0.4, 0.25, 0.0, 0.0, math.inf)
    assert three_regime_friction(step, 0.0, 20.0) == pytest.approx(0.4, rel=1e-14)
    assert three_regime_friction(step, 1e-6, 20.0) == pytest.approx(0.25, rel=1e-14)


@pytest.mark.parametrize(
    ("example", "cold", "hot", "end"),
    [
        (CONTACT_EXAMPLE_OVER_1200, 0.33, 0.14, 1200.0),
        (CONTACT_EXAMPLE_OVER_400, 0.33, 0.14, 400.0),
        (CONTACT_EXAMPLE_LOWER, 0.30, 0.12, 400.0),
    ],
)
def test_the_published_examples_of_hot_friction(
    example: ThermalFriction, cold: float, hot: float, end: float
) -> None:
    for warmth, expected in (
        (-20.0, cold), (0.0, cold), (0.5 * end, 0.5 * (cold + hot)), (end, hot), (2 * end, hot),
    ):  # fmt: skip
        assert thermal_friction(example, 3.0, warmth) == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize(
    ("law", "parameters"),
    [
        (constant_friction, ConstantFriction(0.3)),
        (exponential_friction, DRY_POLACH_2005),
        (half_value_friction, HalfValueFriction(0.2, 0.1, 0.5)),
        (linear_friction, LinearFriction(0.3, 0.1, 2.0)),
        (thermal_friction, CONTACT_EXAMPLE_OVER_400),
        (three_regime_friction, ILLUSTRATIVE_THREE_REGIMES),
    ],
)
def test_plain_and_compiled_give_the_same_bits(law: Law, parameters: Any) -> None:
    compiled = inlined(law)

    @numba.njit(error_model="numpy")
    def over_lanes(parameters: Any, speed: Any, warmth: Any, out: Any) -> None:
        for k in range(speed.size):
            out[k] = compiled(parameters, speed[k], warmth[k])

    generator = np.random.default_rng(2000)
    speed, warmth = generator.uniform(0.0, 50.0, 512), generator.uniform(0.0, 900.0, 512)
    out = np.empty(512)
    over_lanes(parameters, speed, warmth, out)
    points = zip(speed.tolist(), warmth.tolist(), strict=True)
    assert out.tobytes() == np.array([law(parameters, w, t) for w, t in points]).tobytes()
