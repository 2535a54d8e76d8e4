"""What every creep law must obey, whatever its curve."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.contact.carter_1926 import carter_1926
from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.freibauer_1983 import freibauer_1983
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_1983

Law = Callable[[RailFriction, float, float, float, float], float]
LAWS = [polach_2005, freibauer_1983, shen_hedrick_elkins_1983, carter_1926]
every_law = pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)


@st.composite
def rails(draw: st.DrawFn) -> RailFriction:
    adhesion = draw(st.floats(0.05, 1.0))
    return RailFriction(
        draw(st.floats(1e-3, 1.0)),
        draw(st.floats(0.0, 1.0)),
        draw(st.floats(0.0, 2.0)),
        adhesion,
        adhesion * draw(st.floats(0.05, 1.0)),
    )


LOADS = st.floats(1e3, 2e5)
SLOPES = st.floats(1e5, 5e7)
SLIP_SPEEDS = st.floats(0.0, 100.0)
CREEPAGES = st.just(0.0) | st.floats(1e-12, 10.0)


@every_law
@given(rail=rails(), load=LOADS, slope=SLOPES, slip_speed=SLIP_SPEEDS, creepage=CREEPAGES)
def test_the_force_never_exceeds_friction(
    law: Law, rail: RailFriction, load: float, slope: float, slip_speed: float, creepage: float
) -> None:
    force = law(rail, load, slope, slip_speed, creepage)
    assert 0.0 <= force <= falling_friction(rail, slip_speed) * load * (1.0 + 1e-14)


@every_law
@given(rail=rails(), load=LOADS, slope=SLOPES)
def test_the_initial_slope_is_the_share_of_kalkers(
    law: Law, rail: RailFriction, load: float, slope: float
) -> None:
    share = 0.5 * (rail.adhesion_reduction + rail.slip_reduction) if law is polach_2005 else 1.0
    creepage = 1e-8 * rail.static_friction * load / slope
    force = law(rail, load, slope, 0.0, creepage)
    assert force == pytest.approx(share * slope * creepage, rel=1e-6)


@every_law
@given(rail=rails(), load=LOADS, slope=SLOPES, slip_speed=SLIP_SPEEDS, creepage=CREEPAGES)
def test_more_load_means_no_less_force(
    law: Law, rail: RailFriction, load: float, slope: float, slip_speed: float, creepage: float
) -> None:
    light = law(rail, load, slope, slip_speed, creepage)
    heavy = law(rail, 1.1 * load, slope, slip_speed, creepage)
    assert heavy >= light * (1.0 - 1e-12)


@every_law
@given(rail=rails(), load=LOADS, slope=SLOPES, creepage=CREEPAGES, factor=st.floats(0.1, 10.0))
def test_load_and_slope_together_scale_the_force(
    law: Law, rail: RailFriction, load: float, slope: float, creepage: float, factor: float
) -> None:
    once = law(rail, load, slope, 0.1, creepage)
    scaled = law(rail, factor * load, factor * slope, 0.1, creepage)
    assert scaled == pytest.approx(factor * once, rel=1e-10)


@every_law
@given(rail=rails(), load=LOADS, slope=SLOPES, creepage=CREEPAGES)
def test_without_falling_friction_and_reduction_the_curve_only_rises(
    law: Law, rail: RailFriction, load: float, slope: float, creepage: float
) -> None:
    even = rail._replace(friction_ratio=1.0, adhesion_reduction=1.0, slip_reduction=1.0)
    before = law(even, load, slope, 1.0, creepage)
    after = law(even, load, slope, 1.0, 1.01 * creepage)
    assert after >= before - 1e-12 * even.static_friction * load


@every_law
@given(rail=rails(), load=LOADS, slope=SLOPES)
def test_great_creepage_uses_all_friction(
    law: Law, rail: RailFriction, load: float, slope: float
) -> None:
    limit = falling_friction(rail, 5.0) * load
    assert law(rail, load, slope, 5.0, 1e7 * limit / slope) == pytest.approx(limit, rel=1e-3)


@every_law
@pytest.mark.parametrize(
    ("load", "friction", "slope", "creepage"),
    [
        (0.0, 0.3, 0.0, 0.01),
        (0.0, 0.3, 1e7, 0.01),
        (1e5, 0.0, 1e7, 0.01),
        (1e5, 0.0, 1e7, 0.0),
        (1e5, 0.3, 1e7, 0.0),
        (1e-9, 0.3, 1e-3, 1e3),
        (0.0, 0.0, 0.0, 0.0),
    ],
)
def test_nothing_divides_by_zero(
    law: Law, load: float, friction: float, slope: float, creepage: float
) -> None:
    force = law(RailFriction(friction, 0.4, 0.6, 1.0, 0.4), load, slope, 1.0, creepage)
    assert math.isfinite(force)
    assert 0.0 <= force <= friction * load


@given(rail=rails(), load=LOADS, slope=SLOPES, slip_speed=SLIP_SPEEDS, creepage=CREEPAGES)
def test_polach_without_reduction_is_freibauer_to_the_last_bit(
    rail: RailFriction, load: float, slope: float, slip_speed: float, creepage: float
) -> None:
    full = rail._replace(adhesion_reduction=1.0, slip_reduction=1.0)
    assert polach_2005(full, load, slope, slip_speed, creepage) == freibauer_1983(
        full, load, slope, slip_speed, creepage
    )


@given(rail=rails(), slip_speed=SLIP_SPEEDS)
def test_friction_falls_between_its_limits(rail: RailFriction, slip_speed: float) -> None:
    here = falling_friction(rail, slip_speed)
    least = rail.friction_ratio * rail.static_friction
    assert least * (1.0 - 1e-14) <= here <= rail.static_friction * (1.0 + 1e-14)
    assert falling_friction(rail, slip_speed + 0.1) <= here * (1.0 + 1e-13)


@given(rail=rails(), slip_speed=SLIP_SPEEDS)
def test_friction_in_the_half_value_form(rail: RailFriction, slip_speed: float) -> None:
    decay = max(rail.friction_decay, 1e-3)
    kinetic = rail.friction_ratio * rail.static_friction
    halves = 2.0 ** (-slip_speed / (math.log(2.0) / decay))
    other = kinetic + (rail.static_friction - kinetic) * halves
    assert falling_friction(rail._replace(friction_decay=decay), slip_speed) == pytest.approx(
        other, rel=1e-12
    )


def test_carter_in_his_own_words() -> None:
    load, friction, radius, half_length = 1e5, 0.3, 0.46, 0.006
    rail = RailFriction(friction, 1.0, 0.0, 1.0, 1.0)
    for creepage in (1e-4, 1e-3, 3e-3, 1e-2):
        stick = max(0.0, 1.0 - creepage * radius / (friction * half_length))
        force = carter_1926(rail, load, 2.0 * load * radius / half_length, 0.0, creepage)
        assert force == pytest.approx(friction * load * (1.0 - stick * stick), rel=1e-12)
